// SPDX-License-Identifier: MIT
// Seeking, fed with ticks by hand: what counts as found, what is timed, and what is told.
#include "activities/seek/seek.hpp"

#include <gtest/gtest.h>

#include <set>

#include "scene/object_property.hpp"
#include "session/input/input_words.hpp"
#include "session/objects/world_objects.hpp"
#include "tests/activities/one_hand.hpp"

namespace burin::activities {
namespace {

constexpr Nanoseconds kTick_ns = 1'000'000;

// A right-angled tetrahedron with edges of 0.1 m.
std::shared_ptr<const geometry::TriangleMesh> corner() {
    geometry::TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return std::make_shared<const geometry::TriangleMesh>(std::move(mesh));
}

// Objects named a, b, c, ... along x, half a metre apart; the last one is not felt.
session::WorldObjects row_of(std::size_t count) {
    session::WorldObjects world;
    const auto mesh = corner();
    for (std::size_t i = 0; i < count; ++i) {
        scene::SceneObject object;
        object.id = i + 1;
        object.name = std::string(1, static_cast<char>('a' + i));
        object.mesh = mesh;
        object.pose.position_m = {0.5 * static_cast<double>(i), 0.0, 0.0};
        object.felt = i + 1 < count;
        world.objects.push_back(std::make_shared<const scene::SceneObject>(object));
    }
    return world;
}

class Seeker {
public:
    explicit Seeker(const SeekOptions& options) : seek(options) {}

    void act(const std::string& line) {
        session::ActivityOrders orders;
        const std::vector<std::string> words = session::words_of(line, "act").value();
        outcome = session::check_act(&seek, words);
        if (outcome) outcome = seek.act(words, orders);
        keep(orders);
    }
    // Ticks at a place, so many, in contact or not.
    void stay(const Vec3& place_scene, int ticks, bool in_contact) {
        std::vector<haptics::TickRecord> samples;
        for (int i = 0; i < ticks; ++i) {
            haptics::TickRecord sample;
            sample.tick = ++tick_;
            sample.time_ns = static_cast<Nanoseconds>(tick_) * kTick_ns;
            sample.contact.points[0].proxy_object_m = place_scene;
            sample.contact.point_count = 1;
            sample.flags = in_contact ? haptics::kTickInContact : 0u;
            sample.contact.points[0].object = in_contact ? object_at(place_scene) : 0u;
            samples.push_back(sample);
        }
        session::ActivityOrders orders;
        hand_.step(seek, samples, orders, &world, {}, static_cast<Nanoseconds>(tick_) * kTick_ns);
        keep(orders);
    }
    // The number of the felt object that the place is on, as a tick's own contact has it.
    [[nodiscard]] std::uint32_t object_at(const Vec3& place_scene) const {
        for (const auto& object : world.objects)
            if (object->felt && glm::distance(place_scene, on(object->name)) < 0.2)
                return static_cast<std::uint32_t>(object->id);
        return 0;
    }
    // A place on the object's slanted face.
    [[nodiscard]] Vec3 on(const std::string& object) const {
        return world.find(*object_named(world, object))->pose.position_m + Vec3(0.0334);
    }
    [[nodiscard]] std::string target() const { return seek.panel().page.substr(std::string("Touch: ").size()); }

    session::WorldObjects world = row_of(4);
    Seek seek;
    Result<void> outcome;
    std::vector<session::EditObject> edits;
    std::vector<std::string> messages;

private:
    void keep(const session::ActivityOrders& orders) {
        edits.insert(edits.end(), orders.edits.begin(), orders.edits.end());
        messages.insert(messages.end(), orders.messages.begin(), orders.messages.end());
    }
    std::uint64_t tick_ = 0;
    OneHand hand_;
};

}  // namespace

TEST(Seeking, EachFeltObjectIsSoughtOnceAndTimedByTheTicks) {
    Seeker person({.targets = 0, .seed = 3});
    person.stay(Vec3(0.0, 0.0, 0.3), 50, false);
    EXPECT_FALSE(person.seek.is_running());
    person.act("start");
    std::set<std::string> sought;
    person.stay(Vec3(0.0, 0.0, 0.3), 100, false);
    while (person.seek.is_running()) {
        const std::string target = person.target();
        ASSERT_TRUE(sought.insert(target).second) << target << " again";
        person.stay(person.on(target), 200, true);
        person.stay(Vec3(0.0, 0.0, 0.3), 100, false);
    }
    EXPECT_EQ(sought, (std::set<std::string>{"a", "b", "c"})) << "d cannot be felt";
    ASSERT_EQ(person.seek.found().size(), 3u);
    // The first is found by the 101st tick after the last one before the start.
    EXPECT_NEAR(person.seek.found()[0].time_s, 0.101, 1e-9);
    EXPECT_NEAR(person.seek.found()[1].time_s, 0.3, 1e-9);
    EXPECT_NEAR(person.seek.found()[0].path_m,
                glm::length(person.on(person.seek.found()[0].object) - Vec3(0.0, 0.0, 0.3)), 1e-9);
    EXPECT_EQ(person.seek.report()["sought"].size(), 3u);
}

TEST(Seeking, OtherObjectsOnTheWayAreCountedAndDoNotEndIt) {
    Seeker person({.targets = 1, .seed = 1});
    person.act("start");
    person.stay(Vec3(0.0, 0.0, 0.3), 1, false);
    const std::string target = person.target(), other = target == "a" ? "b" : "a";
    person.stay(person.on(other), 500, true);
    EXPECT_TRUE(person.seek.is_running());
    person.stay(person.on(target), 11, true);  // slides over without leaving contact
    ASSERT_FALSE(person.seek.is_running());
    EXPECT_EQ(person.seek.found()[0].others, 1u) << "one touch, however long";
}

TEST(Seeking, TheTargetGlowsOnlyWhileItIsSought) {
    Seeker person({.targets = 1, .seed = 1});
    person.act("start");
    person.stay(Vec3(0.0, 0.0, 0.3), 1, false);
    ASSERT_EQ(person.edits.size(), 1u);
    person.act("skip");
    ASSERT_EQ(person.edits.size(), 2u);
    EXPECT_EQ(person.edits[0].object, person.edits[1].object);
    EXPECT_NE(person.edits[0].value, person.edits[1].value);
    EXPECT_EQ(person.edits[1].value, scene::value_of(*person.world.objects[0], scene::ObjectProperty::colour));
    EXPECT_TRUE(person.seek.found()[0].skipped);
    EXPECT_FALSE(person.seek.report()["sought"][0]["found"]);
}

TEST(Seeking, ActsOutOfPlaceAreRefusedByName) {
    Seeker person({});
    person.act("skip");
    ASSERT_FALSE(person.outcome);
    EXPECT_TRUE(person.outcome.error().line().contains("do start first")) << person.outcome.error().line();
    person.act("strat");
    ASSERT_FALSE(person.outcome);
    EXPECT_TRUE(person.outcome.error().line().contains("did you mean start")) << person.outcome.error().line();
}

// A second start dropped what the first search had measured.
TEST(Seeking, ASecondSearchKeepsWhatTheFirstFound) {
    Seeker person({.targets = 2, .seed = 3});
    person.act("start");
    person.stay(Vec3(0.0, 0.0, 0.3), 100, false);
    person.stay(person.on(person.target()), 200, true);
    person.stay(Vec3(0.0, 0.0, 0.3), 50, false);
    ASSERT_EQ(person.seek.found().size(), 1u);
    const Sought first = person.seek.found()[0];
    person.act("start");  // in the middle of the first
    EXPECT_TRUE(person.messages.back().contains("search 1 broken off at object 2 of 2")) << person.messages.back();
    person.stay(Vec3(0.0, 0.0, 0.3), 10, false);
    EXPECT_EQ(person.seek.panel().aside, "0 of 2");
    EXPECT_EQ(person.target(), first.object) << "the same order";
    person.stay(person.on(person.target()), 20, true);
    person.act("skip");
    ASSERT_FALSE(person.seek.is_running());
    EXPECT_TRUE(person.messages.back().contains("2 objects sought")) << person.messages.back();
    ASSERT_EQ(person.seek.found().size(), 4u);
    EXPECT_EQ(person.seek.found()[0].time_s, first.time_s);
    EXPECT_TRUE(person.seek.found()[1].skipped);
    const Json report = person.seek.report();
    ASSERT_EQ(report["searches"].size(), 2u);
    EXPECT_FALSE(report["searches"][0]["complete"]);
    EXPECT_TRUE(report["searches"][1]["complete"]);
    std::vector<std::size_t> searches;
    for (const Json& one : report["sought"]) searches.push_back(one["search"]);
    EXPECT_EQ(searches, (std::vector<std::size_t>{1, 1, 2, 2}));
}

TEST(Seeking, TellsWhereThereIsLessToSeekThanWasAskedFor) {
    Seeker person({.targets = 5, .seed = 1});
    person.act("start");
    person.stay(Vec3(0.0, 0.0, 0.3), 1, false);
    ASSERT_EQ(person.messages.size(), 1u);
    EXPECT_TRUE(person.messages[0].contains("3 objects can be sought, not 5")) << person.messages[0];
    Seeker alone({});
    alone.world = row_of(1);  // which is not felt
    alone.act("start");
    alone.stay(Vec3(0.0, 0.0, 0.3), 1, false);
    ASSERT_FALSE(alone.messages.empty());
    EXPECT_TRUE(alone.messages[0].contains("no object is both seen and felt")) << alone.messages[0];
}

// They were ignored: what else was meant by "start 2" was not done, and nobody was told.
TEST(Seeking, WordsBehindAnActAreRefused) {
    Seeker person({});
    person.act("start nonsense");
    ASSERT_FALSE(person.outcome);
    EXPECT_TRUE(person.outcome.error().line().contains("command do start: takes no argument, and is given nonsense"))
        << person.outcome.error().line();
    person.stay(Vec3(0.0), 1, false);
    EXPECT_FALSE(person.seek.is_running());
}

TEST(Seeking, TheSameSeedDrawsTheSameOrder) {
    std::vector<std::string> first;
    for (int run = 0; run < 2; ++run) {
        Seeker person({.targets = 0, .seed = 11});
        person.act("start");
        std::vector<std::string> order;
        person.stay(Vec3(0.0), 1, false);
        while (person.seek.is_running()) {
            order.push_back(person.target());
            person.act("skip");
        }
        if (run == 0) first = order;
        EXPECT_EQ(order, first);
    }
    EXPECT_EQ(first.size(), 3u);
}

}  // namespace burin::activities

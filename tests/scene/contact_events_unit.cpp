// SPDX-License-Identifier: MIT
// What hands begin and end to touch: of the ticks of one part, and of all hands in an update of the scene.
#include "scene/contact_events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

#include "haptics/channels.hpp"
#include "scene/scene_service.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

using What = ContactEvent::What;

constexpr Nanoseconds kTick_ns = 1'000'000;

// A tick whose points touch these objects; 0: nothing.
haptics::TickRecord touching_tick(std::uint64_t number, const std::vector<std::uint32_t>& objects) {
    haptics::TickRecord tick;
    tick.tick = number;
    tick.time_ns = static_cast<Nanoseconds>(number) * kTick_ns;
    tick.contact.point_count = static_cast<std::uint32_t>(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        tick.contact.points[i].object = objects[i];
        if (objects[i] == 0) continue;
        tick.contact.points[i].normal_object = Vec3(0.0, 1.0, 0.0);
        tick.flags |= haptics::kTickInContact;
    }
    return tick;
}

// A tick in which some points are held on their last planes, without any triangle found.
haptics::TickRecord held_over_tick(std::uint64_t number, const std::vector<bool>& bearing) {
    haptics::TickRecord tick = touching_tick(number, std::vector<std::uint32_t>(bearing.size(), 0));
    tick.flags |= haptics::kTickHeldOver;
    for (std::size_t i = 0; i < bearing.size(); ++i) {
        if (!bearing[i]) continue;
        tick.contact.points[i].normal_object = Vec3(0.0, 1.0, 0.0);
        tick.flags |= haptics::kTickInContact;
    }
    return tick;
}

}  // namespace

TEST(ContactEvents, BeginAndEndOnceWhateverNumberOfPointsTouches) {
    const PartOfHand of{1, 2};
    ContactFollower follower(of);
    std::vector<ContactEvent> events;
    follower.follow(touching_tick(1, {0, 0}), events);
    EXPECT_TRUE(events.empty());
    follower.follow(touching_tick(2, {7, 7}), events);
    follower.follow(touching_tick(3, {0, 7}), events);
    follower.follow(touching_tick(4, {9, 7}), events);
    follower.follow(touching_tick(5, {9, 8}), events);
    follower.follow(touching_tick(6, {0, 0}), events);
    const std::vector<ContactEvent> expected{{of, 7, What::begin, 2 * kTick_ns}, {of, 9, What::begin, 4 * kTick_ns},
                                             {of, 7, What::end, 5 * kTick_ns},   {of, 8, What::begin, 5 * kTick_ns},
                                             {of, 9, What::end, 6 * kTick_ns},   {of, 8, What::end, 6 * kTick_ns}};
    EXPECT_EQ(events, expected);
}

TEST(ContactEvents, APointThatIsHeldOverGoesOnTouchingWhatItDid) {
    ContactFollower follower;
    std::vector<ContactEvent> events;
    follower.follow(touching_tick(1, {5, 6}), events);
    events.clear();
    follower.follow(held_over_tick(2, {true, true}), events);
    EXPECT_TRUE(events.empty());
    follower.follow(held_over_tick(3, {true, false}), events);
    EXPECT_EQ(events, (std::vector<ContactEvent>{{{}, 6, What::end, 3 * kTick_ns}}));
    events.clear();
    follower.follow(touching_tick(4, {5, 0}), events);
    EXPECT_TRUE(events.empty());
}

// Against a list made in another way: for each object the ticks in which any point bears on it.
TEST(ContactEvents, SayOfEachTickWhatItsPointsTouch) {
    std::mt19937 random(5);
    std::uniform_int_distribution<std::uint32_t> object(0, 4);
    ContactFollower follower;
    std::set<ObjectId> told;
    for (std::uint64_t number = 1; number <= 2000; ++number) {
        const haptics::TickRecord tick = touching_tick(number, {object(random), object(random), object(random)});
        std::vector<ContactEvent> events;
        follower.follow(tick, events);
        for (const ContactEvent& event : events) {
            EXPECT_EQ(event.time_ns, tick.time_ns);
            if (event.what == What::begin)
                EXPECT_TRUE(told.insert(event.object).second) << "tick " << number;
            else
                EXPECT_EQ(told.erase(event.object), 1u) << "tick " << number;
        }
        std::set<ObjectId> touched;
        for (std::size_t i = 0; i < 3; ++i)
            if (tick.contact.points[i].object != 0) touched.insert(tick.contact.points[i].object);
        ASSERT_EQ(told, touched) << "tick " << number;
    }
}

// A real tick's contact: a ball set down on a cube, lifted, and set down on its neighbour.
TEST(ContactEvents, FollowAHandFromOneObjectToTheNext) {
    std::vector<SceneObject> objects;
    const auto mesh = test::shared_mesh(geometry::test::cube(0.02));
    objects.push_back(test::object_at(3, mesh, {0.0, 0.0, 0.0}));
    objects.push_back(test::object_at(4, mesh, {0.1, 0.0, 0.0}));
    test::TouchedScene scene(objects);
    ContactFollower follower;
    std::vector<ContactEvent> events;
    const double above_m = 0.02 + 2.0 * test::TouchedScene::kRadius_m, pressed_m = 0.02 + 0.003;
    const auto go = [&](const Vec3& from, const Vec3& to) {
        for (int i = 0; i <= 100; ++i) follower.follow(scene.tick(from + (i / 100.0) * (to - from)), events);
    };
    go({0.0, above_m, 0.0}, {0.0, pressed_m, 0.0});
    go({0.0, pressed_m, 0.0}, {0.0, above_m, 0.0});
    go({0.0, above_m, 0.0}, {0.1, above_m, 0.0});
    go({0.1, above_m, 0.0}, {0.1, pressed_m, 0.0});
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(events[0].object, 3u);
    EXPECT_EQ(events[0].what, What::begin);
    EXPECT_EQ(events[1].object, 3u);
    EXPECT_EQ(events[1].what, What::end);
    EXPECT_EQ(events[2].object, 4u);
    EXPECT_EQ(events[2].what, What::begin);
}

namespace {

class ContactsSeen final : public ScenePart {
public:
    void take_contacts(std::span<const ContactEvent> events) override {
        updates.emplace_back(events.begin(), events.end());
    }
    Result<void> update(Nanoseconds, const PartSeen*) override { return {}; }
    const PartSeen& seen() const override { return seen_; }
    Result<void> add_near(const ProbeBall&, geometry::LocalSurface&) override { return {}; }
    Nanoseconds period_ns() const override { return 10'000'000; }

    std::vector<std::vector<ContactEvent>> updates;

private:
    PartSeen seen_;
};

}  // namespace

TEST(ContactEvents, OfAllHandsComeInTheOrderOfTimeWithTheUpdateThatReadsTheirTicks) {
    haptics::HapticChannels left(64, 64), right(64, 64);
    ContactsSeen part;
    SceneService service({&part}, {{&left, {}, 0.01, 0.02, {0, 0}}, {&right, {}, 0.01, 0.02, {1, 3}}});
    const auto push = [](haptics::HapticChannels& to, const haptics::TickRecord& tick) { to.ticks.push(tick); };
    push(left, touching_tick(1, {0}));
    push(left, touching_tick(2, {5}));
    push(left, touching_tick(3, {0}));
    push(right, touching_tick(1, {5}));
    push(right, touching_tick(2, {5}));
    push(right, touching_tick(3, {6}));
    ASSERT_TRUE(service.repeat({.time_ns = 10, .last_ticks = {3, 2}, .parts = {{}}}));
    ASSERT_TRUE(service.update(20));
    ASSERT_TRUE(service.update(30));
    ASSERT_EQ(part.updates.size(), 3u);
    EXPECT_EQ(part.updates[0], (std::vector<ContactEvent>{{{1, 3}, 5, What::begin, kTick_ns},
                                                          {{0, 0}, 5, What::begin, 2 * kTick_ns},
                                                          {{0, 0}, 5, What::end, 3 * kTick_ns}}));
    EXPECT_EQ(part.updates[1], (std::vector<ContactEvent>{{{1, 3}, 5, What::end, 3 * kTick_ns},
                                                          {{1, 3}, 6, What::begin, 3 * kTick_ns}}));
    EXPECT_TRUE(part.updates[2].empty());
}

}  // namespace burin::scene

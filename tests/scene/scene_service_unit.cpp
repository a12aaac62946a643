// SPDX-License-Identifier: MIT
// A scene of parts with hands: what an update reads, passes on and publishes, also on a thread and again.
#include <gtest/gtest.h>

#include <atomic>
#include <numbers>
#include <thread>

#include "haptics/channels.hpp"
#include "scene/scene_thread.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

// Writes down what it is given.
class NotedPart final : public ScenePart {
public:
    void take_ticks(std::size_t part, std::span<const haptics::TickRecord> samples) override {
        for (const haptics::TickRecord& sample : samples) ticks.emplace_back(part, sample.tick);
    }
    Result<void> update(Nanoseconds now_ns, const PartSeen* recorded) override {
        ++updates;
        if (fails) return fail("part", "cannot go on");
        // Its background work is done whenever it looks at 20 ms; when it is replayed it looks elsewhere.
        seen_ = recorded != nullptr ? *recorded : PartSeen{.background_ended = now_ns == 20};
        return {};
    }
    const PartSeen& seen() const override { return seen_; }
    Result<void> add_near(const ProbeBall& ball, geometry::LocalSurface&) override {
        balls.push_back(ball);
        return {};
    }
    Nanoseconds period_ns() const override { return period; }
    void finish() override { finished = true; }

    std::vector<std::pair<std::size_t, std::uint64_t>> ticks;
    std::vector<ProbeBall> balls;
    Nanoseconds period = 40'000'000;
    std::atomic<int> updates{0};
    bool fails = false, finished = false;

private:
    PartSeen seen_;
};

haptics::TickRecord sample_at(std::uint64_t tick, const Vec3& at_m) {
    haptics::TickRecord sample;
    sample.tick = tick;
    sample.time_ns = static_cast<Nanoseconds>(1'000'000 * tick);
    sample.contact.points[0].hip_object_m = sample.contact.points[0].proxy_object_m = at_m;
    return sample;
}

struct TwoHands {
    haptics::HapticChannels left{64, 64}, right{64, 64};
    NotedPart first, second;
    SceneService service{{&first, &second},
                         {{&left, {1.0, 0.0, 0.0}, 0.01, 0.02}, {&right, {2.0, 0.0, 0.0}, 0.03, 0.04}}};
};

using Ticks = std::vector<std::pair<std::size_t, std::uint64_t>>;

TEST(SceneService, EveryPartGetsEverySampleAndEachHandItsSurface) {
    TwoHands scene;
    for (const std::uint64_t tick : {1u, 2u}) (void)scene.left.ticks.push(sample_at(tick, {0.0, 0.5, 0.0}));
    ASSERT_TRUE(scene.service.update(50));
    EXPECT_EQ(scene.first.ticks, (Ticks{{0, 1}, {0, 2}}));
    EXPECT_EQ(scene.second.ticks, scene.first.ticks);
    ASSERT_EQ(scene.first.balls.size(), 2u);
    EXPECT_EQ(scene.first.balls[0].center_scene, Vec3(0.0, 0.5, 0.0));
    EXPECT_NEAR(scene.first.balls[0].radius_m, 0.03, 1e-12);
    EXPECT_EQ(scene.first.balls[1].center_scene, Vec3(2.0, 0.0, 0.0)) << "before its first sample";
    EXPECT_EQ(scene.right.surface.newest().sequence, 1u);
    EXPECT_EQ(scene.right.surface.newest().made_ns, 50);
    EXPECT_EQ(scene.service.seen().last_ticks, (std::vector<std::uint64_t>{2, 0}));
}

TEST(SceneService, AnUpdateIsRepeatedWithTheSamplesThatItHad) {
    TwoHands live, again;
    std::vector<SceneUpdate> recorded;
    std::uint64_t tick = 0;
    for (const Nanoseconds now_ns : {10, 20, 30}) {
        for (int i = 0; i < 3; ++i) {
            ++tick;
            (void)live.left.ticks.push(sample_at(tick, Vec3(0.0)));
            (void)live.right.ticks.push(sample_at(tick + 7, Vec3(0.0)));
        }
        ASSERT_TRUE(live.service.update(now_ns));
        recorded.push_back(live.service.seen());
    }
    EXPECT_TRUE(recorded[1].parts[0].background_ended);
    for (std::uint64_t t = 1; t <= tick; ++t) {  // all are there from the first replayed update on
        (void)again.left.ticks.push(sample_at(t, Vec3(0.0)));
        (void)again.right.ticks.push(sample_at(t + 7, Vec3(0.0)));
    }
    for (const SceneUpdate& update : recorded) {
        ASSERT_TRUE(again.service.repeat(update));
        EXPECT_EQ(again.service.seen(), update);
    }
    EXPECT_EQ(again.first.ticks, live.first.ticks);
    SceneUpdate more = recorded.back();
    more.last_ticks.push_back(1);
    EXPECT_FALSE(again.service.repeat(more).has_value()) << "of a scene with more hands";
}

TEST(SceneService, TheShortestPeriodOfItsPartsCountsAndThatOfAMovingHand) {
    TwoHands scene;
    scene.second.period = 25'000'000;
    ASSERT_TRUE(scene.service.update(1'000'000'000));
    EXPECT_EQ(scene.service.period_ns(), 25'000'000);
    for (std::uint64_t tick = 1; tick <= 25; ++tick) (void)scene.right.ticks.push(sample_at(tick, Vec3(0.0)));
    ASSERT_TRUE(scene.service.update(1'025'000'000));
    EXPECT_EQ(scene.service.period_ns(), SceneService::kHandsMove_ns);
    (void)scene.right.ticks.push(sample_at(26, Vec3(0.0)));
    ASSERT_TRUE(scene.service.update(1'035'000'000));
    EXPECT_EQ(scene.service.period_ns(), 25'000'000) << "its loop rests";
}

TEST(SceneService, TheSurfaceIsKnownAroundAHandThatHasSunkDeep) {
    TwoHands scene;
    haptics::TickRecord sample = sample_at(1, {1.0, 0.0, 0.0});
    (void)scene.left.ticks.push(sample);
    ASSERT_TRUE(scene.service.update(1));
    EXPECT_NEAR(scene.first.balls.front().radius_m, 0.03, 1e-12) << "of the probe and its reach";
    scene.first.balls.clear();
    sample = sample_at(2, {1.0, 0.0, 0.0});
    sample.contact.points[0].hip_object_m.y = -0.2;
    (void)scene.left.ticks.push(sample);
    ASSERT_TRUE(scene.service.update(2));
    const ProbeBall& ball = scene.first.balls.front();
    EXPECT_EQ(ball.center_scene, Vec3(1.0, 0.0, 0.0)) << "where the tool rests";
    EXPECT_GE(ball.radius_m, 0.2 + 0.01);
}

TEST(SceneService, PublishesNothingWhereAPartFails) {
    TwoHands scene;
    scene.second.fails = true;
    EXPECT_FALSE(scene.service.update(1).has_value());
    EXPECT_EQ(scene.service.published(0), 0u);
    scene.service.finish();
    EXPECT_TRUE(scene.first.finished && scene.second.finished);
}

TEST(SceneService, AHandTakesAnObjectAlongAndPutsItDown) {
    MaterialTable materials;
    std::vector<SceneObject> objects{test::object_at(1, test::shared_mesh(geometry::test::cube(0.01)), {0.1, 0, 0})};
    auto part = MeshPart::create(objects, materials);
    haptics::HapticChannels channels(64, 64);
    SceneService service({part->get()}, {{&channels, Vec3(0.0), 0.01, 0.5}});
    EXPECT_FALSE((*part)->take_hold(1, 0).has_value()) << "nobody knows where the hand is";
    (void)channels.ticks.push(sample_at(1, {0.0, 0.0, 0.0}));
    ASSERT_TRUE(service.update(1'000'000));
    ASSERT_TRUE((*part)->take_hold(1, 0));
    haptics::TickRecord turned = sample_at(101, {0.0, 0.2, 0.0});
    turned.motion.orientation_object = glm::angleAxis(0.5 * std::numbers::pi, Vec3(0.0, 1.0, 0.0));
    (void)channels.ticks.push(turned);
    ASSERT_TRUE(service.update(101'000'000));
    EXPECT_LT(glm::length((*part)->pose(1).position_m - Vec3(0.0, 0.2, -0.1)), 1e-12) << "as a stick in the hand";
    geometry::LocalSurface others;
    ASSERT_TRUE((*part)->add_near({1, Vec3(0.0), 1.0}, others));
    // 2 m/s upwards, and a quarter turn a tenth of a second, which takes it forwards at the end of a stick of 0.1 m.
    const Vec3 velocity = others.meshes.at(0).motion.velocity_object_m_per_s;
    EXPECT_NEAR(velocity.y, 2.0, 1e-9);
    EXPECT_NEAR(velocity.x, -0.5 * std::numbers::pi, 1e-9);
    ASSERT_TRUE((*part)->let_go(1));
    (void)channels.ticks.push(sample_at(102, {0.0, 0.9, 0.0}));
    ASSERT_TRUE(service.update(102'000'000));
    EXPECT_LT(glm::length((*part)->pose(1).position_m - Vec3(0.0, 0.2, -0.1)), 1e-12);
}

TEST(SceneThread, CarriesOutOrdersBeforeUpdatesAndEndsWithTheLast) {
    TwoHands scene;
    scene.first.period = 1'000'000;
    MonotonicClock clock;
    std::atomic<int> calls{0};
    SceneThread thread(scene.service, clock, [&](const SceneThread::Ended&) { ++calls; });
    thread.start();
    int at_update = -1;
    thread.order([&] { at_update = scene.first.updates; });
    while (scene.first.updates < 5) std::this_thread::yield();
    bool last_was_carried_out = false;
    thread.order([&] { last_was_carried_out = true; });
    bool aside_was_carried_out = false;
    thread.order(SceneThread::Order::aside([&] { aside_was_carried_out = true; }));
    thread.stop();
    EXPECT_GE(at_update, 0);
    EXPECT_TRUE(last_was_carried_out);
    EXPECT_TRUE(aside_was_carried_out);
    EXPECT_EQ(calls, scene.first.updates);
    const std::vector<SceneUpdate> updates = thread.take_updates();
    EXPECT_EQ(updates.size(), static_cast<std::size_t>(scene.first.updates));
    std::size_t orders = 0;
    for (const SceneUpdate& update : updates) orders += update.orders;
    EXPECT_EQ(orders, 2u) << "a replay does not give the one aside";
    EXPECT_FALSE(thread.failure().has_value());
}

TEST(SceneThread, EndsWhenAPartFails) {
    TwoHands scene;
    scene.first.fails = true;
    MonotonicClock clock;
    bool told = false;
    SceneThread thread(scene.service, clock, [&](const SceneThread::Ended& ended) { told = ended.failed; });
    thread.start();
    while (!thread.failure()) std::this_thread::yield();
    thread.stop();
    EXPECT_EQ(scene.first.updates, 1);
    EXPECT_TRUE(thread.take_updates().empty());
}

}  // namespace
}  // namespace burin::scene

// SPDX-License-Identifier: MIT
#include "haptics/haptic_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "haptics/realtime.hpp"
#include "tests/haptics/rig.hpp"

namespace burin {
namespace {

using test::Rig;

constexpr Nanoseconds kMs = 1'000'000;

// Down from 10 mm above to 6 mm below the ball's rest on the plane y = 0, hold, drag, up again. Tool radius 5 mm.
std::vector<HandPose> press_and_drag() {
    return {{0.0, Vec3(0.0, 0.015, 0.0)},    {0.3, Vec3(0.0, 0.015, 0.0)},
            {0.8, Vec3(0.0, -0.001, 0.0)},   {1.2, Vec3(0.0, -0.001, 0.0), {0.9, 0.1, 0.1, 0.0}, 1},
            {1.8, Vec3(0.02, -0.001, 0.01)}, {2.2, Vec3(0.02, 0.02, 0.01)}};
}

TickParameters tool(double radius = 0.005) {
    TickParameters p;
    p.probe.points[0].radius_m = radius;
    p.clearance_ratio = 0.0;
    p.limit_stiffness = false;
    p.max_surface_age_s = 0.0;
    return p;
}

}  // namespace

TEST(HapticLoop, AHandPressingOnAWallFindsTheBalanceOfTheTwoSprings) {
    Rig rig(press_and_drag());
    rig.publish(*test::plane(0.1, 20), 1);
    rig.publish(tool(), 1);
    const auto before = rig.ticks(600);
    EXPECT_EQ(before.front().given.force_device_N, Vec3(0.0));
    const auto pressed = rig.ticks(550);
    // 600 (d) = 200 (6 mm - d) give or take friction 0.26 N: d = 1.5 mm +- 0.33 mm.
    EXPECT_NEAR(pressed.back().penetration_m, 1.5e-3, 0.26 / 800.0 + 0.1e-3);
    EXPECT_NEAR(pressed.back().given.force_device_N.y, 600.0 * pressed.back().penetration_m, 1e-9);
    EXPECT_EQ(pressed.back().surface_sequence, 1u);
    EXPECT_EQ(pressed.back().parameter_sequence, 1u);
    EXPECT_EQ(pressed.back().cause, GateCause::none);
    const auto rest = rig.ticks(1400);
    EXPECT_EQ(rest.back().given.force_device_N, Vec3(0.0));
    for (const TickRecord& r : rest) EXPECT_EQ(r.flags & kTickWorkLimited, 0u);
}

TEST(HapticLoop, PublishesEveryTickInOrderWithItsNumbers) {
    Rig rig(press_and_drag());
    rig.publish(*test::plane(), 7);
    rig.publish(tool(), 3);
    const auto told = rig.ticks(1000);
    TickRecord record;
    StrokeSample stroke;
    for (std::uint64_t i = 1; i <= 1000; ++i) {
        ASSERT_TRUE(rig.channels.records.pop(record));
        ASSERT_TRUE(rig.channels.stroke.pop(stroke));
        EXPECT_EQ(record.tick, i);
        EXPECT_EQ(stroke.tick, i);
        EXPECT_EQ(stroke.position_object_m, record.hip_object_m);
        EXPECT_EQ(stroke.proxy_object_m, record.proxy_object_m);
        EXPECT_EQ(stroke.buttons, record.sample.buttons);
        EXPECT_EQ(record.surface_sequence, 7u);
        EXPECT_EQ(stroke.parameter_sequence, 3u);
        EXPECT_EQ(record.time_ns, static_cast<Nanoseconds>(i) * kMs);
        EXPECT_EQ(record.given.force_device_N, told[i - 1].given.force_device_N);
    }
    EXPECT_FALSE(rig.channels.records.pop(record));
    const ToolState& tool_state = rig.channels.tool.newest();
    EXPECT_EQ(tool_state.tick, 1000u);
    EXPECT_EQ(tool_state.given.force_device_N, record.given.force_device_N);
}

TEST(HapticLoop, AFullRingIsFlaggedAndCounted) {
    SimulatedClock clock;
    SimulatedOmni omni(*SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
    HapticChannels channels(4, 4);
    HapticLoop loop(omni, clock, channels);
    loop.run_ticks(6);
    EXPECT_EQ(channels.stroke.refused(), 2u);
    EXPECT_EQ(channels.tool.newest().dropped_samples, 2u);
    EXPECT_NE(channels.tool.newest().flags & kTickSampleDropped, 0u);
}

TEST(HapticLoop, TheSameScriptGivesTheSameBitsTwice) {
    const auto session = [] {
        Rig rig(press_and_drag());
        rig.publish(*test::groove(0.005, 0.08, 20, 100, 1e-5), 1);
        TickParameters p = tool();
        p.clearance_ratio = 0.02;
        rig.publish(p, 1);
        return rig.ticks(2300);
    };
    const auto a = session(), b = session();
    bool touched = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        touched = touched || a[i].penetration_m > 0.0;
        EXPECT_EQ(std::memcmp(&a[i].proxy_object_m, &b[i].proxy_object_m, sizeof(Vec3)), 0) << i;
        EXPECT_EQ(std::memcmp(&a[i].given.force_device_N, &b[i].given.force_device_N, sizeof(Vec3)), 0) << i;
        EXPECT_EQ(std::memcmp(&a[i].sample.position_device_m, &b[i].sample.position_device_m, sizeof(Vec3)), 0) << i;
        EXPECT_EQ(a[i].flags, b[i].flags);
    }
    EXPECT_TRUE(touched);
}

TEST(HapticLoop, ARehearsalChangesNothing) {
    Rig plain(press_and_drag()), rehearsed(press_and_drag());
    TickParameters p = tool();
    p.clearance_ratio = 0.02;
    for (Rig* rig : {&plain, &rehearsed}) {
        rig->publish(*test::groove(0.005, 0.08, 20, 100, 1e-5), 1);
        rig->publish(p, 1);
    }
    bool touched = false;
    for (int i = 0; i < 2300; ++i) {
        rehearsed.loop.rehearse();
        const TickRecord a = plain.tick(), b = rehearsed.tick();
        touched = touched || a.penetration_m > 0.0;
        ASSERT_EQ(std::memcmp(&a.proxy_object_m, &b.proxy_object_m, sizeof(Vec3)), 0) << i;
        ASSERT_EQ(std::memcmp(&a.given.force_device_N, &b.given.force_device_N, sizeof(Vec3)), 0) << i;
        ASSERT_EQ(a.flags, b.flags) << i;
        ASSERT_EQ(a.tick, b.tick);
    }
    EXPECT_TRUE(touched);
}

TEST(HapticLoop, RunInSimulatedTimeEqualsStepping) {
    Rig stepped(press_and_drag()), run(press_and_drag());
    for (Rig* rig : {&stepped, &run}) {
        rig->publish(*test::plane(), 1);
        rig->publish(tool(), 1);
    }
    const auto told = stepped.ticks(1000);
    run.loop.run_ticks(1000);
    EXPECT_EQ(run.loop.ticks(), 1000u);
    EXPECT_EQ(run.loop.late_ticks(), 0u);
    TickRecord record;
    for (const TickRecord& expected : told) {
        ASSERT_TRUE(run.channels.records.pop(record));
        EXPECT_EQ(record.given.force_device_N, expected.given.force_device_N);
        EXPECT_EQ(record.time_ns, expected.time_ns);
    }
}

TEST(HapticLoop, DeviceFaultsTurnTheForceOffAndItComesBackGently) {
    struct Case {
        InjectedFault fault;
        GateCause cause;
    };
    for (const Case& c : {Case{InjectedFault::disconnected, GateCause::device_fault},
                          {InjectedFault::nan_position, GateCause::not_finite},
                          {InjectedFault::overspeed, GateCause::overspeed},
                          {InjectedFault::frozen, GateCause::stale_sample}}) {
        Rig rig(press_and_drag());
        rig.publish(*test::plane(0.1, 20), 1);
        rig.publish(tool(), 1);
        ASSERT_GT(rig.ticks(1100).back().given.force_device_N.y, 0.5);
        rig.omni.inject(c.fault);
        const auto faulty = rig.ticks(25);
        EXPECT_EQ(faulty.back().cause, c.cause) << text(c.cause);
        EXPECT_EQ(faulty.back().given.force_device_N, Vec3(0.0)) << text(c.cause);
        EXPECT_NE(faulty.back().flags & kTickFault, 0u);
        for (const TickRecord& r : faulty) EXPECT_TRUE(std::isfinite(glm::length(r.given.force_device_N)));
        rig.omni.inject(InjectedFault::none);
        Vec3 last(0.0);
        for (const TickRecord& r : rig.ticks(60)) {
            EXPECT_LE(glm::length(r.given.force_device_N - last), 0.05) << text(c.cause);  // no kick
            last = r.given.force_device_N;
        }
    }
}

TEST(HapticLoop, ASurfaceNobodyVouchesForAnyMoreGivesNoForce) {
    Rig rig(press_and_drag());
    const test::Surface plane = test::plane(0.1, 20);
    TickParameters p = tool();
    p.max_surface_age_s = 0.2;
    rig.publish(p, 1);
    for (int i = 0; i < 1100; ++i) {
        if (i % 100 == 0) rig.publish(*plane, static_cast<std::uint64_t>(i) + 1);  // sign of life
        rig.tick();
    }
    EXPECT_GT(rig.tick().given.force_device_N.y, 0.5);
    EXPECT_EQ(rig.ticks(150).back().cause, GateCause::stale_surface);
    EXPECT_EQ(rig.tick().given.force_device_N, Vec3(0.0));
    rig.publish(*plane, 2000);
    EXPECT_GT(rig.ticks(190).back().given.force_device_N.y, 0.5);
}

namespace {
// A clock whose sleeper wakes late at chosen times.
class SlowClock final : public Clock {
public:
    Nanoseconds now = 0, extra = 0;
    Nanoseconds now_ns() noexcept override { return now; }
    void sleep_until(Nanoseconds deadline_ns) noexcept override {
        now = std::max(now, deadline_ns) + extra;
        extra = 0;
    }
};
}  // namespace

TEST(HapticLoop, LateTicksAreFlaggedAndMissedDeadlinesSkippedNotCaughtUp) {
    SlowClock clock;
    SimulatedOmni omni(*SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
    HapticChannels channels;
    HapticLoop loop(omni, clock, channels);
    loop.run_ticks(1);
    EXPECT_EQ(loop.late_ticks(), 0u);
    clock.extra = 300'000;  // within half a period
    loop.run_ticks(1);
    EXPECT_EQ(loop.late_ticks(), 0u);
    clock.extra = 5'200'000;  // five deadlines gone by
    const Nanoseconds before = clock.now;
    loop.run_ticks(2);
    EXPECT_EQ(loop.late_ticks(), 1u);
    EXPECT_EQ(loop.skipped_deadlines(), 5u);
    EXPECT_EQ(clock.now, before + 7 * kMs);  // late tick at +6.2, the next at +7: on the grid, no burst
    TickRecord record;
    std::uint64_t late = 0;
    while (channels.records.pop(record)) late += (record.flags & kTickLate) != 0;
    EXPECT_EQ(late, 1u);
}

TEST(HapticLoop, ALeadMakesUpForLateWakeUps) {
    struct LateClock final : Clock {
        Nanoseconds now = 0;
        Nanoseconds now_ns() noexcept override { return now; }
        void sleep_until(Nanoseconds deadline_ns) noexcept override { now = std::max(now, deadline_ns + 60'000); }
        void spin_until(Nanoseconds deadline_ns) noexcept override { now = std::max(now, deadline_ns); }
    };
    for (const bool leads : {false, true}) {
        LateClock clock;
        SimulatedOmni omni(*SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
        HapticChannels channels;
        HapticLoop loop(omni, clock, channels);
        loop.run_ticks(20, nullptr, {.lead_ns = leads ? HapticLoop::kLead_ns : 0});
        EXPECT_EQ(loop.ticks(), 20u);
        for (TickRecord record; channels.records.pop(record);) EXPECT_EQ(record.lateness_ns, leads ? 0 : 60'000);
    }
}

TEST(HapticLoop, RestsOnlyWhereItMayAndNothingHappens) {
    // Still for 3 s in the air, moved, still for 2 s, then pressed on the plane for good.
    const std::vector<HandPose> script{{0.0, Vec3(0.0, 0.015, 0.0)},
                                       {3.0, Vec3(0.0, 0.015, 0.0)},
                                       {3.1, Vec3(0.01, 0.015, 0.0)},
                                       {5.1, Vec3(0.01, 0.015, 0.0)},
                                       {5.4, Vec3(0.01, -0.001, 0.0)}};
    for (const bool rests : {false, true}) {
        Rig rig(script);
        rig.publish(*test::plane(0.1, 20), 1);
        rig.publish(tool(), 1);
        rig.loop.run_ticks(4000, nullptr, {.rests = rests});
        Nanoseconds last_ns = 0, changed_ns = kMs;
        DeviceSample last;
        int rested = 0, pressed = 0;
        for (TickRecord r; rig.channels.records.pop(r); last_ns = r.time_ns, last = r.sample) {
            const bool may_rest = rests && last_ns - changed_ns >= HapticLoop::kStill_ns;
            ASSERT_EQ(r.time_ns - last_ns, may_rest ? HapticLoop::kRest_ns : kMs) << r.tick;
            EXPECT_EQ(r.cause, GateCause::none) << r.tick;
            const bool moved = last_ns > 0 && r.sample.position_device_m != last.position_device_m;
            if (moved || r.given.force_device_N != Vec3(0.0)) changed_ns = r.time_ns;
            rested += may_rest ? 1 : 0;
            pressed += r.given.force_device_N.y > 0.1 ? 1 : 0;
        }
        EXPECT_EQ(rig.loop.skipped_deadlines(), 0u);
        if (!rests) continue;
        EXPECT_GT(last_ns, 5'500 * kMs);
        EXPECT_GT(rested, 180);  // of 3 s and 2 s all but the first second, 71 a second
        EXPECT_GT(pressed, 100);
    }
}

TEST(HapticLoop, ARealTimeThreadTicksWhileOthersPublishAndStopsAtZeroForce) {
    MonotonicClock clock;
    SimulatedOmni omni(*SimulatedHand::create(press_and_drag()), {}, &clock);
    HapticChannels channels(1u << 14, 1u << 14);
    HapticLoop loop(omni, clock, channels);
    TickParameters p = tool();
    p.sequence = 1;
    channels.parameters.draft() = p;
    channels.parameters.publish();
    const test::Surface plane = test::plane();
    HapticThread thread(loop);
    const RealtimeNotice notice = thread.start();
    EXPECT_EQ(notice.text.empty(), notice.priority && notice.memory_locked);
    std::uint64_t last_tick = 0;
    for (std::uint64_t i = 1; i <= 40; ++i) {
        LocalSurface& draft = channels.surface.draft();
        draft = *plane;
        draft.sequence = i;
        draft.made_ns = clock.now_ns();
        channels.surface.publish();
        clock.sleep_until(clock.now_ns() + 5 * kMs);
        const ToolState& state = channels.tool.newest();
        EXPECT_GE(state.tick, last_tick);
        last_tick = state.tick;
    }
    while (channels.tool.newest().tick < 20) clock.sleep_until(clock.now_ns() + kMs);
    thread.stop();
    TickRecord record;
    std::uint64_t count = 0, surface = 0;
    while (channels.records.pop(record)) {
        EXPECT_EQ(record.tick, ++count);
        EXPECT_GE(record.surface_sequence, surface);
        surface = record.surface_sequence;
    }
    EXPECT_EQ(count, loop.ticks());
    EXPECT_GE(count, 20u);
}

}  // namespace burin

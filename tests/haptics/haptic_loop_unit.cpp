// SPDX-License-Identifier: MIT
#include "haptics/haptic_loop.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>

#include "haptics/realtime.hpp"
#include "tests/haptics/rig.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

using test::Rig;

// Down from 10 mm above to 6 mm below the ball's rest on the plane y = 0, hold, drag, up again. Tool radius 5 mm.
std::vector<devices::HandPose> press_and_drag() {
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
    EXPECT_EQ(before.front().gate.given.force_device_N, Vec3(0.0));
    const auto pressed = rig.ticks(550);
    // 600 (d) = 200 (6 mm - d) give or take friction 0.26 N: d = 1.5 mm +- 0.33 mm.
    EXPECT_NEAR(pressed.back().deepest().penetration_m, 1.5e-3, 0.26 / 800.0 + 0.1e-3);
    EXPECT_NEAR(pressed.back().gate.given.force_device_N.y, 600.0 * pressed.back().deepest().penetration_m, 1e-9);
    EXPECT_EQ(pressed.back().surface_sequence, 1u);
    EXPECT_EQ(pressed.back().parameter_sequence, 1u);
    EXPECT_EQ(pressed.back().gate.cause, GateCause::none);
    const auto rest = rig.ticks(1400);
    EXPECT_EQ(rest.back().gate.given.force_device_N, Vec3(0.0));
    for (const TickRecord& r : rest) EXPECT_EQ(r.flags & kTickWorkLimited, 0u);
}

TEST(HapticLoop, PublishesEveryTickInOrderWithItsNumbers) {
    Rig rig(press_and_drag());
    rig.publish(*test::plane(), 7);
    rig.publish(tool(), 3);
    const auto told = rig.ticks(1000);
    TickRecord record, of_scene;
    for (std::uint64_t i = 1; i <= 1000; ++i) {
        ASSERT_TRUE(rig.channels.records.pop(record));
        ASSERT_TRUE(rig.channels.ticks.pop(of_scene));
        EXPECT_EQ(record.tick, i);
        EXPECT_EQ(of_scene.tick, i);
        EXPECT_EQ(of_scene.deepest().hip_object_m, record.deepest().hip_object_m);
        EXPECT_EQ(of_scene.deepest().proxy_object_m, record.deepest().proxy_object_m);
        EXPECT_EQ(of_scene.sample.buttons, record.sample.buttons);
        EXPECT_EQ(record.surface_sequence, 7u);
        EXPECT_EQ(of_scene.parameter_sequence, 3u);
        EXPECT_EQ(record.time_ns, static_cast<Nanoseconds>(i) * kMs);
        EXPECT_EQ(record.gate.given.force_device_N, told[i - 1].gate.given.force_device_N);
    }
    EXPECT_FALSE(rig.channels.records.pop(record));
    const ToolState& tool_state = rig.channels.tool.newest();
    EXPECT_EQ(tool_state.tick, 1000u);
    EXPECT_EQ(tool_state.given.force_device_N, record.gate.given.force_device_N);
}

TEST(HapticLoop, AFullRingIsFlaggedAndCounted) {
    SimulatedClock clock;
    devices::SimulatedOmni omni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
    HapticChannels channels(4, 4);
    HapticLoop loop(omni, clock, channels);
    loop.run_ticks(6);
    EXPECT_EQ(channels.ticks.refused(), 2u);
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
        touched = touched || a[i].deepest().penetration_m > 0.0;
        EXPECT_EQ(std::memcmp(&a[i].deepest().proxy_object_m, &b[i].deepest().proxy_object_m, sizeof(Vec3)), 0) << i;
        EXPECT_EQ(std::memcmp(&a[i].gate.given.force_device_N, &b[i].gate.given.force_device_N, sizeof(Vec3)), 0) << i;
        EXPECT_EQ(std::memcmp(&a[i].sample.position_device_m, &b[i].sample.position_device_m, sizeof(Vec3)), 0) << i;
        EXPECT_EQ(a[i].flags, b[i].flags);
    }
    EXPECT_TRUE(touched);
}

TEST(HapticLoop, AWarmUpTickChangesNothing) {
    Rig plain(press_and_drag()), warmed_up(press_and_drag());
    TickParameters p = tool();
    p.clearance_ratio = 0.02;
    for (Rig* rig : {&plain, &warmed_up}) {
        rig->publish(*test::groove(0.005, 0.08, 20, 100, 1e-5), 1);
        rig->publish(p, 1);
    }
    bool touched = false;
    for (int i = 0; i < 2300; ++i) {
        warmed_up.loop.warm_up();
        const TickRecord a = plain.tick(), b = warmed_up.tick();
        touched = touched || a.deepest().penetration_m > 0.0;
        ASSERT_EQ(std::memcmp(&a.deepest().proxy_object_m, &b.deepest().proxy_object_m, sizeof(Vec3)), 0) << i;
        ASSERT_EQ(std::memcmp(&a.gate.given.force_device_N, &b.gate.given.force_device_N, sizeof(Vec3)), 0) << i;
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
        EXPECT_EQ(record.gate.given.force_device_N, expected.gate.given.force_device_N);
        EXPECT_EQ(record.time_ns, expected.time_ns);
    }
}

TEST(HapticLoop, DeviceFaultsTurnTheForceOffAndItComesBackGently) {
    struct Case {
        devices::InjectedFault fault;
        GateCause cause;
    };
    for (const Case& c : {Case{devices::InjectedFault::disconnected, GateCause::device_fault},
                          {devices::InjectedFault::nan_position, GateCause::not_finite},
                          {devices::InjectedFault::overspeed, GateCause::overspeed},
                          {devices::InjectedFault::frozen, GateCause::stale_sample}}) {
        Rig rig(press_and_drag());
        rig.publish(*test::plane(0.1, 20), 1);
        rig.publish(tool(), 1);
        ASSERT_GT(rig.ticks(1100).back().gate.given.force_device_N.y, 0.5);
        rig.omni.inject(c.fault);
        const auto faulty = rig.ticks(25);
        EXPECT_EQ(faulty.back().gate.cause, c.cause) << text(c.cause);
        EXPECT_EQ(faulty.back().gate.given.force_device_N, Vec3(0.0)) << text(c.cause);
        EXPECT_NE(faulty.back().flags & kTickFault, 0u);
        for (const TickRecord& r : faulty) EXPECT_TRUE(std::isfinite(glm::length(r.gate.given.force_device_N)));
        rig.omni.inject(devices::InjectedFault::none);
        Vec3 last(0.0);
        for (const TickRecord& r : rig.ticks(60)) {
            EXPECT_LE(glm::length(r.gate.given.force_device_N - last), 0.05) << text(c.cause);  // no kick
            last = r.gate.given.force_device_N;
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
    EXPECT_GT(rig.tick().gate.given.force_device_N.y, 0.5);
    EXPECT_EQ(rig.ticks(150).back().gate.cause, GateCause::stale_surface);
    EXPECT_EQ(rig.tick().gate.given.force_device_N, Vec3(0.0));
    rig.publish(*plane, 2000);
    EXPECT_GT(rig.ticks(190).back().gate.given.force_device_N.y, 0.5);
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
    devices::SimulatedOmni omni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
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
        devices::SimulatedOmni omni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
        HapticChannels channels;
        HapticLoop loop(omni, clock, channels);
        loop.run_ticks(20, nullptr, {.lead_ns = leads ? HapticLoop::kLead_ns : 0});
        EXPECT_EQ(loop.ticks(), 20u);
        for (TickRecord record; channels.records.pop(record);) EXPECT_EQ(record.lateness_ns, leads ? 0 : 60'000);
    }
}

TEST(HapticLoop, RestsOnlyWhereItMayAndNothingHappens) {
    // Still for 3 s in the air, moved, still for 2 s, then pressed on the plane for good.
    const std::vector<devices::HandPose> script{{0.0, Vec3(0.0, 0.015, 0.0)},
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
        devices::DeviceSample last;
        int rested = 0, pressed = 0;
        for (TickRecord r; rig.channels.records.pop(r); last_ns = r.time_ns, last = r.sample) {
            const bool may_rest = rests && last_ns - changed_ns >= HapticLoop::kStill_ns;
            ASSERT_EQ(r.time_ns - last_ns, may_rest ? HapticLoop::kRest_ns : kMs) << r.tick;
            EXPECT_EQ(r.gate.cause, GateCause::none) << r.tick;
            const bool moved = last_ns > 0 && r.sample.position_device_m != last.position_device_m;
            if (moved || r.gate.given.force_device_N != Vec3(0.0)) changed_ns = r.time_ns;
            rested += may_rest ? 1 : 0;
            pressed += r.gate.given.force_device_N.y > 0.1 ? 1 : 0;
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
    devices::SimulatedOmni omni(*devices::SimulatedHand::create(press_and_drag()), {}, &clock);
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
        geometry::LocalSurface& draft = channels.surface.draft();
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

namespace {
// What the motors are told, one order after the other, by a loop that presses an Omni on a plane.
class OverheardOmni final : public devices::HapticDevice {
public:
    explicit OverheardOmni(devices::SimulatedOmni& omni) : omni_(omni) {}
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override {
        return omni_.description();
    }
    [[nodiscard]] devices::DeviceSample read() noexcept override {
        if (++reads == stop_after && stop != nullptr) stop->store(true);
        return omni_.read();
    }
    void write(const devices::DeviceWrench& wrench) noexcept override {
        before = newest;
        newest = wrench;
        omni_.write(wrench);
    }
    devices::DeviceWrench before, newest;  // the last two orders
    std::uint64_t reads = 0, stop_after = 0;
    std::atomic<bool>* stop = nullptr;

private:
    devices::SimulatedOmni& omni_;
};
}  // namespace

TEST(HapticLoop, ALoopThatEndsWhileTheToolIsPressedLeavesNoForceOnTheDevice) {
    for (const bool is_stopped : {false, true}) {
        Rig rig(press_and_drag());
        rig.publish(*test::plane(0.1, 20), 1);
        rig.publish(tool(), 1);
        OverheardOmni device(rig.omni);
        HapticLoop loop(device, rig.clock, rig.channels);
        std::atomic<bool> stop = false;
        if (is_stopped) {
            device.stop_after = 1100;
            device.stop = &stop;
            loop.run(stop, {});
        } else {
            loop.run_ticks(1100);
        }
        ASSERT_EQ(loop.ticks(), 1100u);
        EXPECT_GT(device.before.force_device_N.y, 0.5) << "the last tick pushed back";
        EXPECT_EQ(device.newest.force_device_N, Vec3(0.0));
        EXPECT_EQ(device.newest.torque_device_Nm, Vec3(0.0));
    }
}

TEST(HapticLoop, TheFrameIsToldTheToolAsItIsInTheRecord) {
    Rig rig(
        {{0.0, Vec3(0.0, 0.015, 0.0)}, {0.4, Vec3(0.01, -0.001, 0.0), glm::normalize(Quat(0.9, 0.3, -0.2, 0.1)), 1}});
    rig.publish(*test::plane(0.1, 20), 1);
    TickParameters p = tool();
    p.probe.count = 2;
    p.probe.points[1] = {{0.0, -0.006, 0.0}, 0.005};  // lower down: the deeper one
    // Device and object share the plane's normal, but neither the origin nor the direction along it.
    p.workspace.object_from_device = {Vec3(0.004, 0.0, -0.01), glm::normalize(Quat(0.8, 0.0, 0.6, 0.0)), 1.0};
    p.materials[0].damping_Ns_per_m = 0.0;
    rig.publish(p, 1);
    rig.ticks(600);
    const TickRecord record = rig.tick();
    const ToolState& told = rig.channels.tool.newest();
    ASSERT_EQ(record.contact.point_count, 2u);
    ASSERT_EQ(told.point_count, 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(told.proxies_object_m[i], record.contact.points[i].proxy_object_m) << i;
    EXPECT_NE(record.contact.points[0].proxy_object_m, record.contact.points[1].proxy_object_m);
    EXPECT_NE(record.contact.points[1].proxy_object_m, Vec3(0.0));
    EXPECT_EQ(told.orientation_object, p.workspace.object_from_device.orientation * record.sample.orientation_device);
    EXPECT_EQ(told.position_device_m, record.sample.position_device_m);
    EXPECT_EQ(told.buttons, record.sample.buttons);
    // What is told is of the deepest point; the first one carves.
    EXPECT_GT(record.contact.points[1].penetration_m, record.contact.points[0].penetration_m);
    EXPECT_EQ(record.deepest().proxy_object_m, record.contact.points[1].proxy_object_m);
    EXPECT_EQ(record.deepest().penetration_m, record.contact.points[1].penetration_m);
    TickRecord of_scene;
    while (rig.channels.ticks.pop(of_scene)) continue;
    EXPECT_EQ(of_scene.tick, record.tick);
    EXPECT_EQ(of_scene.contact.points[0].proxy_object_m, record.contact.points[0].proxy_object_m);
    EXPECT_EQ(of_scene.contact.points[0].hip_object_m, record.contact.points[0].hip_object_m);
}

TEST(HapticLoop, AnObjectThatStandsOnItsSidePushesAlongItsOwnNormal) {
    // The object stands on its side before the device: pushed along the device's x the tool meets the face whose normal
    // is the object's y.
    Rig rig({{0.0, Vec3(0.015, 0.0, 0.0)}, {0.5, Vec3(-0.001, 0.0, 0.0)}});
    rig.publish(*test::plane(0.1, 20), 1);
    TickParameters p = tool();
    const double half = 0.25 * 3.14159265358979324;
    p.workspace.object_from_device.orientation =
        Quat(std::cos(half), 0.0, 0.0, std::sin(half));  // a quarter turn about z
    p.materials[0].static_friction = p.materials[0].dynamic_friction = 0.0;
    rig.publish(p, 1);
    const TickRecord record = rig.ticks(900).back();
    ASSERT_GT(record.gate.given.force_device_N.x, 0.5);
    const Vec3 force_object_N = record.motion.object_from_device.orientation * record.gate.given.force_device_N;
    EXPECT_NEAR(force_object_N.y, record.gate.given.force_device_N.x, 1e-12);
    EXPECT_NEAR(force_object_N.x, 0.0, 1e-5);  // of a plane in float
}

TEST(HapticLoop, LateTicksAreToldToTheCarvingSideAndTheFrameToo) {
    SlowClock clock;
    devices::SimulatedOmni omni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
    HapticChannels channels;
    HapticLoop loop(omni, clock, channels);
    loop.run_ticks(1);
    clock.extra = 700'000;  // more than half a period
    loop.run_ticks(1);
    TickRecord first, second;
    ASSERT_TRUE(channels.ticks.pop(first) && channels.ticks.pop(second));
    EXPECT_EQ(first.flags & kTickLate, 0u);
    EXPECT_NE(second.flags & kTickLate, 0u);
    EXPECT_EQ(channels.tool.newest().late_ticks, 1u);
}

TEST(HapticLoop, HoweverLongTheLeadMostOfAPeriodIsForSleep) {
    struct Sleeper final : Clock {
        Nanoseconds now = 0, least_sleep = INT64_MAX;
        Nanoseconds now_ns() noexcept override { return now; }
        void sleep_until(Nanoseconds deadline_ns) noexcept override {
            least_sleep = std::min(least_sleep, deadline_ns - now);
            now = std::max(now, deadline_ns);
        }
        void spin_until(Nanoseconds deadline_ns) noexcept override { now = std::max(now, deadline_ns); }
    };
    Sleeper clock;
    devices::SimulatedOmni omni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
    HapticChannels channels;
    HapticLoop loop(omni, clock, channels);
    loop.run_ticks(20, nullptr, {.lead_ns = 50 * kMs});
    EXPECT_GE(clock.least_sleep, kMs * 3 / 4);
    EXPECT_EQ(clock.now, 20 * kMs);
}

TEST(HapticLoop, AButtonOrAnotherSettingWakesARestingLoop) {
    const auto gap_after_next = [](Rig& rig) {
        const Nanoseconds before_ns = rig.clock.now_ns();
        rig.loop.run_ticks(2, nullptr, {.rests = true});
        return rig.clock.now_ns() - before_ns;
    };
    {  // after two seconds without anything it rests between any two ticks
        Rig rig({{0.0, Vec3(0.0)}});
        rig.publish(tool(), 1);
        rig.loop.run_ticks(1200, nullptr, {.rests = true});
        EXPECT_EQ(gap_after_next(rig), kMs + HapticLoop::kRest_ns);
        rig.publish(tool(), 2);
        EXPECT_EQ(gap_after_next(rig), 2 * kMs);
    }
    // Pressed at 3 s, without moving: from then on a second of ticks a millisecond apart.
    Rig rig({{0.0, Vec3(0.0)}, {3.0, Vec3(0.0), {1, 0, 0, 0}, 1}, {9.0, Vec3(0.0), {1, 0, 0, 0}, 1}});
    rig.publish(tool(), 1);
    rig.loop.run_ticks(2200, nullptr, {.rests = true});
    Nanoseconds last_ns = 0;
    int awake = 0;
    for (TickRecord r; rig.channels.records.pop(r); last_ns = r.time_ns)
        if (r.time_ns > 3'020 * kMs && r.time_ns < 3'900 * kMs) awake += r.time_ns - last_ns == kMs ? 1 : 0;
    EXPECT_GT(awake, 800);
}

}  // namespace burin::haptics

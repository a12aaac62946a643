// SPDX-License-Identifier: MIT
// The loop itself stands still and comes back: the gate through the whole tick.
#include <gtest/gtest.h>

#include "haptics/tick.hpp"
#include "tests/haptics/rig.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

struct Session {
    test::Surface plane = test::plane();
    TickParameters parameters;
    FullTickState state{};
    Nanoseconds now_ns = 0;
    double y_m = 0.0019;

    Session() {
        parameters.probe = ball_probe(0.004);
        parameters.limit_stiffness = false;
        parameters.passivity.control = false;
        parameters.max_surface_age_s = 0.0;
    }
    // A hand that rests, at first 2 mm beyond the surface.
    TickRecord after(Nanoseconds gap_ns) {
        now_ns += gap_ns;
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        sample.position_device_m = {0.0, y_m, 0.0};
        const FullTick full = full_tick(state, sample, *plane, parameters, test::kStrongDevice, now_ns, kDt);
        state = full.next;
        return full.record;
    }
    TickRecord many(int ticks) {
        TickRecord last;
        for (int i = 0; i < ticks; ++i) last = after(kMs);
        return last;
    }
};

}  // namespace

TEST(LostLoop, AGapOfThirtyMillisecondsGivesNoForceSaysWhyAndComesBackGently) {
    Session session;
    const double full_N = session.many(500).gate.given.force_device_N.y;
    ASSERT_GT(full_N, 0.5);
    const TickRecord lost = session.after(30 * kMs);
    EXPECT_EQ(lost.gate.cause, GateCause::lost_loop);
    EXPECT_STREQ(text(lost.gate.cause), "no force: the haptic loop stood still");
    EXPECT_EQ(lost.gate.given.force_device_N, Vec3(0.0));
    EXPECT_NE(lost.flags & kTickLoopGap, 0u);
    EXPECT_NE(lost.flags & kTickFault, 0u);
    double last_N = 0.0;
    for (int i = 0; i < 400; ++i) {
        const TickRecord record = session.after(kMs);
        EXPECT_EQ(record.gate.cause, GateCause::none);
        EXPECT_LE(record.gate.given.force_device_N.y - last_N, 0.02) << i;  // no kick
        last_N = record.gate.given.force_device_N.y;
        if (i < 45) {
            EXPECT_EQ(last_N, 0.0) << i;  // all must be well for a while first
        }
    }
    EXPECT_NEAR(last_N, full_N, 1e-3);
}

TEST(LostLoop, WithoutAPromiseOneLostTickIsFlaggedAndFromTheSecondOnTheForceFades) {
    const auto left_after = [](Nanoseconds gap_ns) {
        Session session;
        session.parameters.limits.max_slew_N_per_s = 1e6;
        const double full_N = session.many(500).gate.given.force_device_N.y;
        const TickRecord late = session.after(gap_ns);
        EXPECT_EQ(late.gate.cause, GateCause::none);
        EXPECT_NE(late.flags & kTickLoopGap, 0u);
        EXPECT_EQ((late.flags & kTickRamping) != 0, gap_ns > 2 * kMs);
        EXPECT_EQ(session.after(kMs).flags & kTickLoopGap, 0u);
        EXPECT_NEAR(session.many(100).gate.given.force_device_N.y, full_N, 1e-3);  // and comes back
        return late.gate.given.force_device_N.y / full_N;
    };
    EXPECT_NEAR(left_after(2 * kMs), 1.0, 0.03);
    EXPECT_NEAR(left_after(3 * kMs), 0.8, 0.03);
    EXPECT_NEAR(left_after(4 * kMs), 0.4, 0.03);
    EXPECT_NEAR(left_after(5 * kMs), 0.0, 0.03);
}

// An Omni that a hand presses on a plate with 2 N, at rest, and a loop that loses ticks in bursts.
TEST(LostLoop, AToolAtRestDoesNotSinkInOverFiveLostTicksAndComesToBearAgainAfterMore) {
    for (const int lost : {1, 2, 3, 4, 5, 30}) {
        const double at_rest_m = 0.004 - 2.0 / 600.0;
        const devices::HandGrip grip{0.1, 100.0, 3.0};
        test::Rig rig({{0.0, {0.0, 0.01, 0.0}}, {0.5, {0.0, at_rest_m - 2.0 / 100.0, 0.0}}}, grip);
        rig.publish(*test::plane(), 1);
        TickParameters parameters;
        parameters.probe = ball_probe(0.004);
        parameters.clearance_ratio = 0.0;
        parameters.max_surface_age_s = 0.0;
        rig.publish(parameters, 1);
        TickRecord record = rig.ticks(2000).back();
        const double before_m = record.sample.position_device_m.y, before_N = record.gate.given.force_device_N.y;
        EXPECT_NEAR(before_N, 2.0, 0.3);
        double lowest_m = before_m;
        for (int burst = 0; burst < 40; ++burst) {
            rig.clock.sleep_until(rig.clock.now_ns() + lost * rig.loop.period_ns());
            for (int i = 0; i < 20; ++i) {
                record = rig.tick();
                lowest_m = std::min(lowest_m, record.sample.position_device_m.y);
            }
            if (lost > 5) break;
        }
        record = rig.ticks(2000).back();
        lowest_m = std::min(lowest_m, record.sample.position_device_m.y);
        if (lost <= 5) {
            EXPECT_LE(before_m - lowest_m, 1e-4) << lost << " lost";
            EXPECT_NEAR(record.gate.given.force_device_N.y, before_N, 0.1) << lost << " lost";
        } else {
            // Without force for 50 ms and more, it sinks; then what the hand has paid for bears it again.
            const double rests_at_m = record.sample.position_device_m.y, pressed_N = record.gate.given.force_device_N.y;
            EXPECT_LE(std::abs(rig.ticks(1000).back().sample.position_device_m.y - rests_at_m), 1e-4);
            EXPECT_GT(pressed_N, 1.0);
            EXPECT_LE(before_m - lowest_m, 0.01);
        }
    }
}

TEST(LostLoop, AGapWithoutForceIsNoFaultAndAContactThatBeganInItFadesIn) {
    Session session;
    session.y_m = 0.01;  // in the air: a loop that rests ticks every 14 ms
    for (int i = 0; i < 50; ++i) EXPECT_EQ(session.after(14 * kMs).gate.cause, GateCause::none);
    session.y_m = 0.0019;
    const TickRecord touch = session.after(14 * kMs);
    EXPECT_EQ(touch.gate.cause, GateCause::none);
    EXPECT_LT(touch.gate.given.force_device_N.y, 0.02);
    EXPECT_GT(session.many(300).gate.given.force_device_N.y, 0.5);
}

// One wrong sample among good ones: no force in its tick, a cause, and the contact afterwards as if it had begun then.
TEST(LostLoop, ASampleOutOfReachOrAheadOfTheClockGivesNoForceAndNoKick) {
    for (const bool ahead : {false, true}) {
        Session session;
        session.parameters.passivity.control = true;
        session.many(500);
        devices::DeviceSample sample;
        session.now_ns += kMs;
        sample.time_ns = session.now_ns + (ahead ? 1000 * kMs : 0);
        sample.position_device_m = {0.0, ahead ? session.y_m : -1e8, 0.0};
        const FullTick wrong = full_tick(session.state, sample, *session.plane, session.parameters, test::kStrongDevice,
                                         session.now_ns, kDt);
        session.state = wrong.next;
        EXPECT_EQ(wrong.record.gate.cause, ahead ? GateCause::future_sample : GateCause::out_of_reach);
        EXPECT_EQ(wrong.record.gate.given.force_device_N, Vec3(0.0));
        double last_N = 0.0;
        for (int i = 0; i < 400; ++i) {
            const TickRecord record = session.after(kMs);
            EXPECT_EQ(record.gate.cause, GateCause::none) << i;
            EXPECT_LE(record.gate.given.force_device_N.y - last_N, 0.02) << i;
            last_N = record.gate.given.force_device_N.y;
        }
        EXPECT_GT(last_N, 0.5);
    }
}

// A device whose clock is set back, or that stamps one sample a little ahead, does not make the hand seem faster.
TEST(LostLoop, AClockThatIsSetBackDoesNotMakeTheHandFaster) {
    for (const bool back : {false, true}) {
        Session session;
        double fastest_m_per_s = 0.0;
        for (int i = 0; i < 400; ++i) {
            session.now_ns += kMs;
            devices::DeviceSample sample;
            sample.time_ns = session.now_ns;
            if (back && i >= 200) sample.time_ns -= 10 * kMs;
            if (!back && i == 200) sample.time_ns += 4 * kMs;
            sample.position_device_m = {0.0, 0.02 - 1e-4 * i, 0.0};  // 0.1 m/s
            const FullTick full = full_tick(session.state, sample, *session.plane, session.parameters,
                                            test::kStrongDevice, session.now_ns, kDt);
            session.state = full.next;
            fastest_m_per_s = std::max(fastest_m_per_s, glm::length(full.record.motion.velocity_device_m_per_s));
        }
        EXPECT_GT(fastest_m_per_s, 0.08);
        EXPECT_LT(fastest_m_per_s, 0.15) << back;
    }
}

}  // namespace burin::haptics

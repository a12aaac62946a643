// SPDX-License-Identifier: MIT
#include "devices/haptic/simulated_omni.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace burin::devices {
namespace {

// A hand that does not hold: for the device's own dynamics.
constexpr HandGrip kLetGo{0.0, 0.0, 0.0};

SimulatedHand gripping_hand(std::vector<HandPose> script, HandGrip grip = {}) {
    return *SimulatedHand::create(std::move(script), HandPath::straight, grip);
}

SimulatedHand resting(HandGrip grip = {}, const Vec3& at = Vec3(0.0)) { return gripping_hand({{0.0, at}}, grip); }

}  // namespace

TEST(SimulatedOmni, DescribesThePhantomOmni) {
    const SimulatedOmni omni(resting());
    EXPECT_EQ(omni.description().workspace_m, Vec3(0.1626, 0.1219, 0.0711));
    EXPECT_EQ(omni.description().max_force_N, 3.3);
    EXPECT_EQ(omni.description().resolution_m, 0.055e-3);
    EXPECT_EQ(omni.description().rate_Hz, 1000.0);
}

TEST(SimulatedOmni, ForcesBelowFrictionMoveNothing) {
    SimulatedOmni omni(resting(kLetGo));
    for (int i = 0; i < 500; ++i) {
        omni.advance(kMs);
        static_cast<void>(omni.read());
        omni.write({{0.18, -0.18, 0.04}});  // 0.2577 N in all
    }
    EXPECT_EQ(omni.true_position_device_m(), Vec3(0.0));
    EXPECT_EQ(omni.true_velocity_device_m_per_s(), Vec3(0.0));
}

TEST(SimulatedOmni, AConstantForceGivesTheClosedFormMotion) {
    // m v' = F - c - b v  ->  v = (F - c)/b (1 - exp(-b t/m)), x its integral.
    SimulatedOmni omni(resting(kLetGo));
    const OmniModel model;
    const double net = 1.0 - model.friction_N;
    omni.write({{1.0, 0.0, 0.0}});
    omni.advance(kMs);  // from here on the force acts
    for (int i = 0; i < 60; ++i) {
        omni.advance(kMs);
        const double t = 1e-3 * (i + 1), rate = model.damping_Ns_per_m / model.apparent_mass_kg;
        const double v = net / model.damping_Ns_per_m * (1.0 - std::exp(-rate * t));
        const double x = net / model.damping_Ns_per_m * (t - (1.0 - std::exp(-rate * t)) / rate);
        // First order in the 50 us step: v is exact to rate * h, x lags by half a step's travel.
        EXPECT_NEAR(omni.true_velocity_device_m_per_s().x, v, 1e-4 * v + 1e-9);
        EXPECT_NEAR(omni.true_position_device_m().x, x, 0.5 * 50e-6 * v + 1e-4 * x + 1e-9);
    }
}

TEST(SimulatedOmni, FrictionStopsASlidingStylusAndKeepsItStill) {
    SimulatedOmni omni(resting(kLetGo));
    omni.write({{3.0, 1.0, 0.0}});
    omni.advance(5 * kMs);
    static_cast<void>(omni.read());
    omni.write({});
    EXPECT_GT(glm::length(omni.true_velocity_device_m_per_s()), 0.2);
    omni.advance(200 * kMs);
    EXPECT_EQ(omni.true_velocity_device_m_per_s(), Vec3(0.0));
    const Vec3 rest = omni.true_position_device_m();
    EXPECT_NEAR(rest.y / rest.x, 1.0 / 3.0, 1e-9);  // friction acts along the motion, not axis by axis
    omni.advance(100 * kMs);
    EXPECT_EQ(omni.true_position_device_m(), rest);
}

TEST(SimulatedOmni, ForcesActAMillisecondLateAndAreHeldAndClamped) {
    SimulatedOmni omni(resting());
    omni.advance(kMs);
    static_cast<void>(omni.read());
    omni.write({{30.0, 40.0, 0.0}});
    EXPECT_EQ(omni.acting_force_device_N(), Vec3(0.0));
    omni.advance(kMs - SimulatedOmni::kStep_ns);
    EXPECT_EQ(omni.acting_force_device_N(), Vec3(0.0));  // still in transport
    omni.advance(20 * kMs);                              // held, however long nothing new is written
    EXPECT_NEAR(omni.acting_force_device_N().x, 3.3 * 0.6, 1e-12);
    EXPECT_NEAR(omni.acting_force_device_N().y, 3.3 * 0.8, 1e-12);
    omni.write({{std::nan(""), 0.0, 0.0}});
    omni.advance(kMs);
    EXPECT_EQ(omni.acting_force_device_N(), Vec3(0.0));
}

TEST(SimulatedOmni, AWatchdogTakesTheForceOffUntilSomethingIsWrittenAgain) {
    OmniModel model;
    model.watchdog_s = 0.004;
    SimulatedOmni omni(resting(), model);
    EXPECT_EQ(omni.description().watchdog_s, 0.004);
    for (int i = 0; i < 3; ++i) {  // written every 3 ms: it stays on
        omni.write({{1.0, 0.0, 0.0}});
        omni.advance(3 * kMs);
        EXPECT_EQ(omni.acting_force_device_N().x, 1.0);
    }
    omni.advance(2 * kMs);
    EXPECT_EQ(omni.acting_force_device_N().x, 0.0);
    omni.write({{2.0, 0.0, 0.0}});
    omni.advance(kMs / 2);
    omni.write({{2.0, 0.0, 0.0}});
    EXPECT_EQ(omni.acting_force_device_N().x, 0.0) << "what was silenced does not come back";
    omni.advance(kMs / 2);
    EXPECT_EQ(omni.acting_force_device_N().x, 2.0);
}

TEST(SimulatedOmni, PositionsComeInEncoderSteps) {
    SimulatedOmni omni(gripping_hand({{0.0, Vec3(0.0)}, {1.0, Vec3(0.02, -0.01, 0.005)}}));
    for (int i = 0; i < 1000; ++i) {
        omni.advance(kMs);
        const DeviceSample sample = omni.read();
        for (int axis = 0; axis < 3; ++axis) {
            const double steps = sample.position_device_m[axis] / 0.055e-3;
            EXPECT_NEAR(steps, std::round(steps), 1e-6);
            EXPECT_LE(std::abs(sample.position_device_m[axis] - omni.true_position_device_m()[axis]),
                      0.5000001 * 0.055e-3);
        }
    }
}

TEST(SimulatedOmni, TheHandFollowsASlowPathWithinTwoMillimetresInFreeAir) {
    std::vector<HandPose> circle;
    for (int i = 0; i <= 200; ++i) {  // 25 mm radius in 4 s: 39 mm/s
        const double a = 2.0 * 3.14159265358979 * i / 200.0;
        circle.push_back({0.02 * i, Vec3(0.025 * std::cos(a), 0.025 * std::sin(a), 0.005 * std::sin(2 * a))});
    }
    SimulatedOmni omni(gripping_hand(circle));
    double worst = 0.0;
    for (int i = 1; i <= 4000; ++i) {
        omni.advance(kMs);
        const Vec3 wanted = omni.scripted_hand()->target(1e-3 * i).position_device_m;
        worst = std::max(worst, glm::length(omni.true_position_device_m() - wanted));
    }
    EXPECT_LT(worst, 2e-3);
    EXPECT_GT(worst, 0.5e-3);  // friction 0.26 N over 200 N/m is 1.3 mm: without it the model would be wrong
}

TEST(SimulatedOmni, StopsAtTheEndOfItsWorkspace) {
    SimulatedOmni omni(gripping_hand({{0.0, Vec3(0.0)}, {0.5, Vec3(0.2, -0.2, 0.2)}}));
    omni.advance(1000 * kMs);
    EXPECT_EQ(omni.true_position_device_m(), 0.5 * Vec3(0.1626, -0.1219, 0.0711));
}

TEST(SimulatedOmni, TheSameScriptGivesTheSameBitsByAdvanceAndByClock) {
    const std::vector<HandPose> script{
        {0.0, Vec3(0.0)}, {0.3, Vec3(0.03, 0.01, 0.0), {0.9, 0.1, 0, 0}, 1}, {0.7, Vec3(-0.02, 0.02, 0.01)}};
    SimulatedClock clock;
    SimulatedOmni a(gripping_hand(script)), b(gripping_hand(script)), by_clock(gripping_hand(script), {}, &clock);
    for (int i = 1; i <= 800; ++i) {
        a.advance(kMs);
        b.advance(400'000);  // the same millisecond in unequal parts
        b.advance(617'000);
        b.advance(-17'000);
        clock.sleep_until(i * kMs);
        const DeviceSample sa = a.read(), sb = b.read(), sc = by_clock.read();
        const Vec3 force = -20.0 * sa.position_device_m;
        a.write({force}), b.write({force}), by_clock.write({force});
        EXPECT_EQ(sa.time_ns, i * kMs);
        for (const DeviceSample& other : {sb, sc}) {
            EXPECT_EQ(sa.time_ns, other.time_ns);
            EXPECT_EQ(std::memcmp(&sa.position_device_m, &other.position_device_m, sizeof(Vec3)), 0) << i;
            EXPECT_EQ(std::memcmp(&sa.orientation_device, &other.orientation_device, sizeof(Quat)), 0) << i;
            EXPECT_EQ(sa.buttons, other.buttons);
        }
    }
}

TEST(SimulatedOmni, ALongPauseOfItsClockIsNotCaughtUp) {
    SimulatedClock clock;
    SimulatedOmni omni(gripping_hand({{0.0, Vec3(0.0)}, {100.0, Vec3(0.05, 0.0, 0.0)}}), {}, &clock);
    clock.sleep_until(60 * kNanosecondsPerSecond);
    const DeviceSample sample = omni.read();
    EXPECT_EQ(omni.time_ns(), SimulatedOmni::kMostCatchUp_ns);
    EXPECT_EQ(sample.time_ns, 60 * kNanosecondsPerSecond);  // yet the sample is of now
}

TEST(SimulatedOmni, InjectedFaultsShowAsTheyWouldOnHardware) {
    SimulatedOmni omni(resting());
    omni.advance(kMs);
    const DeviceSample good = omni.read();
    EXPECT_EQ(good.fault, DeviceFault::none);
    omni.inject(InjectedFault::frozen);
    omni.advance(kMs);
    EXPECT_EQ(omni.read().time_ns, good.time_ns);
    omni.inject(InjectedFault::nan_position);
    EXPECT_TRUE(std::isnan(omni.read().position_device_m.x));
    omni.inject(InjectedFault::overspeed);
    const double x0 = omni.read().position_device_m.x;
    EXPECT_NEAR(omni.read().position_device_m.x - x0, 0.01, 1e-12);
    omni.inject(InjectedFault::disconnected);
    EXPECT_EQ(omni.read().fault, DeviceFault::disconnected);
    omni.write({{1.0, 0.0, 0.0}});
    static_cast<void>(omni.read());
    EXPECT_EQ(omni.acting_force_device_N(), Vec3(0.0));
    omni.inject(InjectedFault::none);
    omni.advance(kMs);
    EXPECT_EQ(omni.read().fault, DeviceFault::none);
}

TEST(SimulatedOmni, EachRunawayBeginsWhereTheStylusIs) {
    SimulatedOmni omni(resting());
    for (int times = 0; times < 2; ++times) {
        omni.inject(InjectedFault::overspeed);
        EXPECT_NEAR(omni.read().position_device_m.x - omni.true_position_device_m().x, 0.01, 1e-4) << times;
        static_cast<void>(omni.read());
        omni.inject(InjectedFault::none);
        EXPECT_NEAR(omni.read().position_device_m.x, omni.true_position_device_m().x, 1e-4) << times;
    }
}

TEST(SimulatedOmni, TheForceGoesWithTheConnection) {
    SimulatedOmni omni(resting());
    omni.write({{1.0, 0.0, 0.0}});
    omni.advance(kMs);
    static_cast<void>(omni.read());
    ASSERT_EQ(omni.acting_force_device_N(), Vec3(1.0, 0.0, 0.0));
    omni.inject(InjectedFault::disconnected);
    static_cast<void>(omni.read());
    EXPECT_EQ(omni.acting_force_device_N(), Vec3(0.0));
    omni.inject(InjectedFault::none);
    static_cast<void>(omni.read());
    EXPECT_EQ(omni.acting_force_device_N(), Vec3(0.0)) << "what was told before comes not back";
}

TEST(SimulatedOmni, RestsAtTheEndOfItsWorkspaceAndBeginsWithinIt) {
    SimulatedOmni pushed(gripping_hand({{0.0, Vec3(0.0)}, {0.5, Vec3(0.2, -0.2, 0.2)}}));
    pushed.advance(1000 * kMs);
    EXPECT_EQ(pushed.true_velocity_device_m_per_s(), Vec3(0.0));
    const SimulatedOmni beyond(gripping_hand({{0.0, Vec3(0.2, -0.2, 0.2)}}));
    EXPECT_EQ(beyond.true_position_device_m(), 0.5 * Vec3(0.1626, -0.1219, 0.0711));
}

TEST(SimulatedOmni, FollowsAClockInPartsOfAStepWithoutRunningAhead) {
    const std::vector<HandPose> script{{0.0, Vec3(0.0)}, {0.3, Vec3(0.03, 0.01, 0.0)}};
    SimulatedClock clock;
    SimulatedOmni omni(gripping_hand(script), {}, &clock);
    for (int i = 1; i <= 3000; ++i) {
        const Nanoseconds now_ns = i * Nanoseconds{133'337};
        clock.sleep_until(now_ns);
        static_cast<void>(omni.read());
        ASSERT_EQ(omni.time_ns(), now_ns / SimulatedOmni::kStep_ns * SimulatedOmni::kStep_ns) << i;
    }
}

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
#include "haptics/stability/rendered_wall.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "devices/haptic/simulated_omni.hpp"

namespace burin::haptics {
namespace {

devices::DeviceDescription omni() {
    devices::DeviceDescription device =
        devices::SimulatedOmni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}})).description();
    return device;
}

devices::DeviceDescription damped(double damping, double rate_Hz) {
    devices::DeviceDescription device;
    device.damping_Ns_per_m = damping;
    device.rate_Hz = rate_Hz;
    return device;
}

ContactDemand demand(double stiffness, double damping) {
    ContactDemand d;
    d.stiffness_N_per_m = stiffness;
    d.damping_Ns_per_m = damping;
    return d;
}

}  // namespace

TEST(StiffnessLimit, LeavesTheDefaultMaterialOnTheSimulatedOmniAsItIs) {
    const StiffnessLimit limit = limited(demand(600.0, 0.5), omni());
    EXPECT_EQ(limit.bound, StiffnessBound::none);
    EXPECT_EQ(limit.stiffness_N_per_m, 600.0);
    EXPECT_EQ(limit.damping_Ns_per_m, 0.5);
}

TEST(StiffnessLimit, OfADampedDeviceIsColgatesAndSchenkelsWithDelay) {
    for (const double rate : {250.0, 1000.0, 4000.0}) {
        devices::DeviceDescription device = damped(2.0, rate);
        const double T = 1.0 / rate;
        EXPECT_NEAR(limited(demand(1e9, 0.0), device).stiffness_N_per_m, 2.0 * 2.0 / T, 1e-6);
        device.delay_s = 3.0 * T;
        EXPECT_NEAR(limited(demand(1e9, 0.0), device).stiffness_N_per_m, 2.0 / (3.5 * T), 1e-6);
        device.delay_s = 2.2 * T;  // as bad as three
        EXPECT_NEAR(limited(demand(1e9, 0.0), device).stiffness_N_per_m, 2.0 / (3.5 * T), 1e-6);
        EXPECT_EQ(limited(demand(1e9, 0.0), device).bound, StiffnessBound::sampling);
    }
}

TEST(StiffnessLimit, FrictionAndStepsAloneGiveAbbottsAndOkamurasForSlowContacts) {
    devices::DeviceDescription device = omni();
    device.max_stiffness_N_per_m = 0.0;
    ContactDemand d = demand(1e9, 0.0);
    d.contact_speed_m_per_s = 0.0;
    const StiffnessLimit limit = limited(d, device);
    EXPECT_NEAR(limit.stiffness_N_per_m, 2.0 * 0.26 / 0.055e-3, 1e-6);
    EXPECT_NEAR(limit.stiffness_N_per_m, 9455.0, 1.0);  // as the literature's constants give it for the Omni
}

TEST(StiffnessLimit, FrictionCoversLessTheFasterTheContactIs) {
    devices::DeviceDescription device = omni();
    device.max_stiffness_N_per_m = 0.0;
    device.resolution_m = 0.0;
    for (const double v : {0.05, 0.15, 0.6}) {
        ContactDemand d = demand(1e9, 0.0);
        d.contact_speed_m_per_s = v;
        // Diolaiti's c / v beside b
        EXPECT_NEAR(limited(d, device).stiffness_N_per_m, (0.05 + 0.26 / v) / 0.0015, 1e-6);
    }
}

TEST(StiffnessLimit, AFilterOnTheForceCostsLikeADelay) {
    devices::DeviceDescription delayed = omni(), plain = omni();
    delayed.delay_s += 0.009;
    ContactDemand filtered = demand(1e9, 0.0);
    filtered.filter_lag_s = 0.009;
    const StiffnessLimit limit = limited(filtered, plain);
    EXPECT_NEAR(limit.stiffness_N_per_m, limited(demand(1e9, 0.0), delayed).stiffness_N_per_m, 1e-9);
    EXPECT_LT(limit.stiffness_N_per_m, 200.0);
}

TEST(StiffnessLimit, TheLoopsOwnPeriodCountsWhereItIsGiven) {
    ContactDemand d = demand(1e9, 0.0);
    d.period_s = 1.0 / 250.0;
    EXPECT_NEAR(limited(d, damped(1.0, 1000.0)).stiffness_N_per_m, 2.0 * 1.0 * 250.0, 1e-6);
}

TEST(StiffnessLimit, DampingGivesWayFirstAndStiffnessAfterIt) {
    const StiffnessLimit much = limited(demand(600.0, 5.0), omni());
    EXPECT_EQ(much.bound, StiffnessBound::damping);
    EXPECT_EQ(much.stiffness_N_per_m, 600.0);
    EXPECT_GT(much.damping_Ns_per_m, 0.5);
    EXPECT_LT(much.damping_Ns_per_m, 5.0);
    // what is left is allowed as it is, and no more of it
    EXPECT_EQ(limited(demand(600.0, much.damping_Ns_per_m), omni()).bound, StiffnessBound::none);
    EXPECT_EQ(limited(demand(600.0, much.damping_Ns_per_m * 1.001), omni()).bound, StiffnessBound::damping);

    devices::DeviceDescription unlimited = omni();
    unlimited.max_stiffness_N_per_m = 0.0;
    const StiffnessLimit stiff = limited(demand(5000.0, 5.0), unlimited);
    EXPECT_EQ(stiff.bound, StiffnessBound::sampling);
    EXPECT_EQ(stiff.damping_Ns_per_m, 0.0);
}

TEST(StiffnessLimit, TheMakersWordHoldsWhereTheRestAllowsMore) {
    const StiffnessLimit limit = limited(demand(5000.0, 0.0), omni());
    EXPECT_EQ(limit.bound, StiffnessBound::device);
    EXPECT_EQ(limit.stiffness_N_per_m, 700.0);
}

TEST(StiffnessLimit, OfADeviceOfWhichNothingIsKnownOnlyTheMakerLimits) {
    devices::DeviceDescription unknown;
    EXPECT_EQ(limited(demand(5000.0, 3.0), unknown).stiffness_N_per_m, 5000.0);
    EXPECT_EQ(limited(demand(5000.0, 3.0), unknown).bound, StiffnessBound::none);
    unknown.max_stiffness_N_per_m = 400.0;
    EXPECT_EQ(limited(demand(5000.0, 3.0), unknown).stiffness_N_per_m, 400.0);
    EXPECT_EQ(limited(demand(5000.0, 3.0), unknown).damping_Ns_per_m, 3.0);
}

TEST(StiffnessLimit, ACoarseEncoderWithoutFrictionToHideItIsNamed) {
    devices::DeviceDescription device = damped(5.0, 1000.0);
    device.resolution_m = 1e-3;
    device.friction_N = 0.1;
    const StiffnessLimit limit = limited(demand(1e9, 0.0), device);
    EXPECT_EQ(limit.bound, StiffnessBound::quantisation);
    EXPECT_NEAR(limit.stiffness_N_per_m, 200.0, 1e-9);
}

TEST(StiffnessLimit, TheTorqueOfSeveralPointsIsLimitedAsTheirForceIs) {
    devices::DeviceDescription wand = omni();
    const double squares = 2.0 * 0.08 * 0.08;  // 7.7 N m/rad at 600 N/m
    const auto torsion = [&] { return limited_by_rotation(demand(600.0, 0.5), squares, wand); };
    EXPECT_EQ(torsion().bound, StiffnessBound::none) << "it gives no torque";
    wand.max_torque_Nm = Vec3(0.5);
    EXPECT_EQ(torsion().stiffness_N_per_m, 600.0) << "nothing is known of its rotation";
    wand.max_torsion_Nm_per_rad = 3.0;
    EXPECT_EQ(torsion().bound, StiffnessBound::rotation);
    EXPECT_NEAR(torsion().stiffness_N_per_m * squares, 3.0, 1e-12);
    wand.max_torsion_Nm_per_rad = 0.0;
    wand.angular_friction_Nm = 0.01;
    wand.orientation_step_rad = 0.0015;
    // K ((T/2 + t_d) W + step/2) = c
    EXPECT_NEAR(torsion().stiffness_N_per_m * squares, 0.01 / (0.0015 * kTurnSpeed_rad_per_s + 0.00075), 1e-9);
    EXPECT_EQ(torsion().damping_Ns_per_m, 0.0);
    EXPECT_EQ(limited_by_rotation(demand(600.0, 0.5), 0.0, wand).stiffness_N_per_m, 600.0) << "one point, no arm";
}

TEST(StiffnessLimit, EveryReasonHasASentenceOfItsOwn) {
    std::set<std::string> sentences;
    for (const auto bound : {StiffnessBound::none, StiffnessBound::sampling, StiffnessBound::quantisation,
                             StiffnessBound::device, StiffnessBound::damping, StiffnessBound::rotation}) {
        EXPECT_TRUE(sentences.insert(text(bound)).second);
        EXPECT_FALSE(std::string(text(bound)).empty());
    }
}

}  // namespace burin::haptics

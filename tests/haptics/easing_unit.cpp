// SPDX-License-Identifier: MIT
// What changes under a hand that presses: shares of several points, materials, and what a hand takes hold of.
#include "haptics/forces/easing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "haptics/tick.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/haptics/ticked_hand.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

constexpr double kEasedArm_m = 0.08, kEasedBall_m = 0.004;

// A wand with a ball at each end, upright before a wall that looks along z, on a device that renders 1715 N/m.
struct PressedWand {
    test::Surface wall = test::box(Vec3(-0.3, -0.3, -0.2), Vec3(0.3, 0.3, 0.0));
    TickParameters parameters;
    devices::DeviceDescription device = test::kStrongDevice;
    FullTickState state{};
    Nanoseconds now_ns = kMs;

    explicit PressedWand(double stiffness_N_per_m) {
        device.max_stiffness_N_per_m = 1715.0;
        device.max_torque_Nm = Vec3(0.0);
        parameters.probe.count = 2;
        parameters.probe.points[0] = {{0.0, kEasedArm_m, 0.0}, kEasedBall_m};
        parameters.probe.points[1] = {{0.0, -kEasedArm_m, 0.0}, kEasedBall_m};
        parameters.clearance_ratio = 0.0;
        parameters.materials[0].stiffness_N_per_m = stiffness_N_per_m;
        parameters.materials[0].damping_Ns_per_m = 0.0;
        parameters.max_surface_age_s = 0.0;
    }
    // How deep each end is in the wall.
    TickRecord at(double top_m, double bottom_m) {
        const double lean_rad = std::asin((bottom_m - top_m) / (2.0 * kEasedArm_m));
        devices::DeviceSample sample;
        sample.time_ns = now_ns += kMs;
        sample.position_device_m = {0.0, 0.0, kEasedBall_m - 0.5 * (top_m + bottom_m)};
        sample.orientation_device = Quat(std::cos(0.5 * lean_rad), std::sin(0.5 * lean_rad), 0.0, 0.0);
        const FullTick full = full_tick(state, sample, *wall, parameters, device, now_ns, kDt);
        state = full.next;
        return full.record;
    }
};

TEST(Easing, AWandsSecondEndTakesNothingFromTheFirstAtOnceAndLetsNothingRise) {
    PressedWand hand(1500.0);
    for (int i = 0; i < 400; ++i) hand.at(0.0008, -0.002);
    double before_N = hand.at(0.0008, -0.002).gate.given.force_device_N.z, most_N = 0.0, stiffest = 0.0;
    EXPECT_NEAR(before_N, 1500.0 * 0.0008, 1e-4);
    const auto step_to = [&](double bottom_m) {
        const TickRecord record = hand.at(0.0008, bottom_m);
        most_N = std::max(most_N, std::abs(record.gate.given.force_device_N.z - before_N));
        before_N = record.gate.given.force_device_N.z;
        const auto& points = record.contact.points;
        stiffest = std::max(stiffest, points[0].rendered.stiffness_N_per_m + points[1].rendered.stiffness_N_per_m);
        return record;
    };
    for (int i = 0; i < 300; ++i) step_to(-0.002 + 1e-5 * i);  // 10 mm/s
    // Half of 1.2 N in 50 ticks, and what the second end gives meanwhile.
    EXPECT_LT(most_N, 0.02);
    EXPECT_LE(stiffest, 1715.0 * (1.0 + 1e-12));
    const TickRecord both = step_to(0.001);
    EXPECT_NEAR(both.contact.points[0].rendered.stiffness_N_per_m, 857.5, 1e-9);
    EXPECT_NEAR(both.contact.points[1].rendered.stiffness_N_per_m, 857.5, 1e-9);
    EXPECT_EQ(both.contact.points[0].asked.stiffness_N_per_m, 1500.0);
    // And back: the first end gets its share again.
    for (int i = 0; i < 300; ++i) step_to(0.001 - 1e-5 * i);
    for (int i = 0; i < 60; ++i) step_to(-0.002);
    EXPECT_LT(most_N, 0.02);
    EXPECT_NEAR(before_N, 1500.0 * 0.0008, 1e-4);
}

test::TickedHand hand_that_presses(double stiffness_N_per_m) {
    test::TickedHand hand{*test::plane(), {}};
    hand.surface.made_ns = 0;
    hand.parameters.probe = ball_probe(kEasedBall_m);
    hand.parameters.clearance_ratio = 0.0;
    hand.parameters.max_surface_age_s = 0.0;
    hand.parameters.materials.fill({.stiffness_N_per_m = stiffness_N_per_m, .damping_Ns_per_m = 0.0});
    for (int i = 0; i < 300; ++i) hand.tick({0.0, 0.01, 0.0});
    for (int i = 0; i <= 90; ++i) hand.tick({0.0, 0.01 - 1e-4 * i, 0.0});
    for (int i = 0; i < 20; ++i) hand.tick({0.0, kEasedBall_m - 0.003, 0.0});
    return hand;
}

TEST(Easing, AStiffnessThatIsEditedUnderTheToolIsReachedInFiftyMilliseconds) {
    for (const auto& [from, to] : {std::pair{100.0, 700.0}, std::pair{700.0, 100.0}}) {
        test::TickedHand hand = hand_that_presses(from);
        double before_N = hand.record.gate.given.force_device_N.y;
        EXPECT_NEAR(before_N, from * 0.003, 1e-5);
        hand.parameters.materials[0].stiffness_N_per_m = to;
        int ticks = 0;
        for (double now_N = before_N; std::abs(now_N - to * 0.003) > 1e-5 && ticks < 1000; ++ticks) {
            now_N = hand.tick({0.0, kEasedBall_m - 0.003, 0.0}).gate.given.force_device_N.y;
            EXPECT_LT(std::abs(now_N - before_N), 0.037) << ticks;  // 1.8 N in 50 ticks
            before_N = now_N;
        }
        EXPECT_EQ(ticks, 50);
    }
}

TEST(Easing, WhatAHandTakesHoldOfLetsItGoInFiftyMilliseconds) {
    test::TickedHand hand = hand_that_presses(300.0);
    hand.parameters.holds = true;
    double before_N = hand.record.gate.given.force_device_N.y;
    for (int i = 0; i < 50; ++i) {
        const double now_N = hand.tick({0.0, kEasedBall_m - 0.003, 0.0}).gate.given.force_device_N.y;
        EXPECT_NEAR(before_N - now_N, 0.9 / 50.0, 1e-6) << i;
        before_N = now_N;
    }
    EXPECT_NEAR(before_N, 0.0, 1e-9);
    EXPECT_FALSE(hand.record.in_contact());
}

TEST(Easing, ForceThatIsSwitchedOffIsNotHeld) {
    test::TickedHand hand = hand_that_presses(300.0);
    hand.parameters.enabled = false;
    EXPECT_EQ(hand.tick({0.0, kEasedBall_m - 0.003, 0.0}).gate.given.force_device_N, Vec3(0.0));
}

TEST(Easing, ALargerToolPushesTheHandOverFiftyMilliseconds) {
    test::TickedHand hand = hand_that_presses(300.0);
    double before_N = hand.record.gate.given.force_device_N.y;
    hand.parameters.probe.points[0].radius_m = 0.008;
    for (int i = 0; i < 200; ++i) {
        const double now_N = hand.tick({0.0, kEasedBall_m - 0.003, 0.0}).gate.given.force_device_N.y;
        EXPECT_LT(std::abs(now_N - before_N), 0.03) << i;  // 1.2 N in 50 ticks
        before_N = now_N;
    }
    EXPECT_NEAR(before_N, 300.0 * 0.007, 1e-3);
}

TEST(Easing, TheTorqueOfAContactAndWhatItStoresFadeAsItsForceDoes) {
    EasedForce state;
    const Vec3 from_Nm(0.02, -0.07, 0.05), to_Nm(-0.04, 0.01, 0.06);
    const ContactForce from{{{1.0, 0.0, 0.0}, from_Nm}, 0.003}, to{{{0.0, 1.0, 0.0}, to_Nm}, 0.008};
    for (int i = 0; i < 3; ++i) static_cast<void>(eased(state, from, 0.0, kDt));
    int between = 0;
    for (int i = 0; i < 60; ++i) {
        const ContactForce now = eased(state, to, i == 0 ? kEase_s : 0.0, kDt);
        const double left = now.wrench.force_device_N.x, come = now.wrench.force_device_N.y;
        between += left > 0.01 && come > 0.01 ? 1 : 0;
        EXPECT_LT(glm::distance(now.wrench.torque_device_Nm, left * from_Nm + come * to_Nm), 1e-12) << i;
        EXPECT_NEAR(now.stored_J, left * 0.003 + come * 0.008, 1e-12) << i;
    }
    EXPECT_GT(between, 40);
}

// Stiffness and damping have their own rooms: what one has left is not the other's.
TEST(Easing, APointThatComesTakesNoMoreOfEitherThanTheOthersHaveLeft) {
    std::array<EasedWall, 2> walls;
    const CoupledWall whole{1000.0, 8.0}, half{400.0, 5.0};
    for (int i = 0; i < 100; ++i) ease_walls(walls, std::array<std::optional<CoupledWall>, 2>{whole, {}}, kDt);
    for (int i = 0; i < 100; ++i) {
        ease_walls(walls, std::array<std::optional<CoupledWall>, 2>{half, half}, kDt);
        const CoupledWall one = walls[0].wall(), other = walls[1].wall();
        EXPECT_LE(one.stiffness_N_per_m + other.stiffness_N_per_m, 1000.0 + 1e-9) << i;
        EXPECT_LE(one.damping_Ns_per_m + other.damping_Ns_per_m, 10.0 + 1e-9) << i;
        if (i > 0) continue;
        EXPECT_EQ(other.stiffness_N_per_m, 0.0) << "the first has 600 N/m to give, and gives 12 a tick";
        EXPECT_NEAR(other.damping_Ns_per_m, 2.0, 1e-12) << "the first has 3 Ns/m to give";
    }
    for (const EasedWall& wall : walls) {
        EXPECT_NEAR(wall.wall().stiffness_N_per_m, 400.0, 1e-9);
        EXPECT_NEAR(wall.wall().damping_Ns_per_m, 5.0, 1e-9);
    }
}

TEST(Easing, BothFrictionsOfAMaterialThatIsEditedAreReachedInFiftyMilliseconds) {
    EasedFriction friction;
    const TouchMaterial bark{.static_friction = 0.9, .dynamic_friction = 0.7};
    const TouchMaterial ice{.static_friction = 0.3, .dynamic_friction = 0.1};
    for (int i = 0; i < 5; ++i) static_cast<void>(with_eased_friction(friction, bark, i > 0, kDt));
    for (int i = 1; i <= 60; ++i) {
        const TouchMaterial now = with_eased_friction(friction, ice, true, kDt);
        const double share = std::min(i / 50.0, 1.0);
        EXPECT_NEAR(now.static_friction, 0.9 - 0.6 * share, 1e-12) << i;
        EXPECT_NEAR(now.dynamic_friction, 0.7 - 0.6 * share, 1e-12) << i;
    }
}

TEST(Easing, AContactThatChangesInEveryTickFallsSilent) {
    EasedForce state;
    const auto next_N = [&](double force_N, double changed_s) {
        return eased(state, {{{0.0, force_N, 0.0}, {}}, 0.0}, changed_s, kDt).wrench.force_device_N.y;
    };
    static_cast<void>(next_N(1.0, 0.0));
    EXPECT_EQ(next_N(1.0, 0.0), 1.0);
    double before_N = 1.1;  // the first change lets a little of what comes through
    for (int i = 0; i < 500; ++i) {
        const double now_N = next_N(i % 2 == 0 ? 3.0 : 0.5, kEase_s);
        EXPECT_LE(now_N, before_N);
        before_N = now_N;
    }
    EXPECT_LT(before_N, 1e-3);
    // Once it goes on, its force comes.
    for (int i = 0; i < 51; ++i) before_N = next_N(1.0, 0.0);
    EXPECT_EQ(before_N, 1.0);
}

TEST(Easing, AnotherMaterialBeginsWithItsOwnFrictionAndNotWithTheLastOnes) {
    EasedFriction friction;
    TouchMaterial bark{.static_friction = 0.9, .dynamic_friction = 0.7},
        ice{.static_friction = 0.05, .dynamic_friction = 0.03};
    for (int i = 0; i < 5; ++i) static_cast<void>(with_eased_friction(friction, bark, i > 0, kDt));
    // The hand leaves, and comes to something else: what is known of it in the first tick is the last material.
    static_cast<void>(with_eased_friction(friction, bark, false, kDt));
    EXPECT_EQ(with_eased_friction(friction, ice, true, kDt).static_friction, 0.05);
    // Under the tool it changes over 50 ms.
    EXPECT_NEAR(with_eased_friction(friction, bark, true, kDt).static_friction, 0.05 + 0.85 / 50.0, 1e-12);
}

}  // namespace
}  // namespace burin::haptics

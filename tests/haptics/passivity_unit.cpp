// SPDX-License-Identifier: MIT
// The passivity observer and controller: an energy account against one kept along the true motion, and what the controller may
// and may not do.
#include "haptics/stability/passivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace burin {
namespace {

constexpr double kDt = 1e-3, kStep = 0.055e-3;

DeviceDescription device(double friction = 0.26, double damping = 0.05, double delay_s = 0.001) {
    DeviceDescription d;
    d.resolution_m = kStep;
    d.friction_N = friction;
    d.damping_Ns_per_m = damping;
    d.delay_s = delay_s;
    return d;
}

// A wall of stiffness K below y = 0, pushing up.
PassivityInput at(double y_m, double stiffness, double max_force_N = 0.0) {
    PassivityInput in;
    in.position_device_m = {0.0, y_m, 0.0};
    const double depth = std::max(0.0, -y_m);
    in.wanted_force_device_N = {0.0, stiffness * depth, 0.0};
    in.stored_J = 0.5 * stiffness * depth * depth;
    in.max_force_N = max_force_N;
    in.in_contact = depth > 0.0;
    return in;
}

// Down at the speed, then up again, until the tool has been out for a while. The device gives what it is told, up to its force.
struct Push {
    double left_J = 0.0;        // E just before it is reset in free space
    double most_damping = 0.0;  // that the controller gave
    double work_J = 0.0;        // of the force that acted on the tool, along the true motion
};
Push push(double stiffness, double speed, double depth_m, const DeviceDescription& d, PassivitySettings settings = {},
          double max_force_N = 1e9) {
    PassivityState state;
    Push out;
    double told_N = 0.0, acting_N = 0.0, y = 0.0042e-3, before = y;
    bool down = true;
    for (int i = 0; i < 4000 && y < 2e-3; ++i) {
        const double sampled = kStep * std::floor(y / kStep + 0.5);
        const PassivityStep step = keep_passive(state, at(sampled, stiffness, max_force_N), settings, d, kDt);
        out.work_J += acting_N * (y - before);
        if (step.energy_J != 0.0) out.left_J = step.energy_J;
        out.most_damping = std::max(out.most_damping, step.damping_Ns_per_m);
        acting_N = d.delay_s > 0.0 ? told_N : std::min(step.force_device_N.y, max_force_N);
        told_N = std::min(step.force_device_N.y, max_force_N);
        state = told(step.next, {0.0, told_N, 0.0});
        before = y;
        y += (down ? -speed : speed) * kDt;
        if (y < -depth_m) down = false;
    }
    return out;
}

}  // namespace

TEST(PassivityObserver, CountsTheEnergyOfASampledWallAsTheClosedFormDoes) {
    // In and out at v the force is late by T/2 and the delay, which gives K (T/2 + t_d) v on every metre of the way.
    PassivitySettings observe;
    observe.control = false;
    for (const double delay : {0.0, 0.001}) {
        const double K = 800.0, v = 0.1, depth = 4e-3;
        const Push p = push(K, v, depth, device(0.26, 0.05, delay), observe);
        const double expected = -K * (0.5 * kDt + delay) * v * 2.0 * depth;
        EXPECT_NEAR(p.left_J / expected, 1.0, 0.1) << delay;  // the turn, and the steps of the encoder
        EXPECT_NEAR(p.left_J, -p.work_J, 0.05 * std::abs(p.work_J));
        EXPECT_EQ(p.most_damping, 0.0);
    }
}

TEST(PassivityController, IsQuietWhereTheDevicesFrictionCoversTheWall) {
    // 600 N/m at 0.15 m/s lies within the limiter's promise for this device.
    for (const double v : {0.02, 0.1, 0.15}) EXPECT_EQ(push(600.0, v, 4e-3, device()).most_damping, 0.0) << v;
}

TEST(PassivityController, IsQuietOnASoftWallPressedBeyondTheForceLimit) {
    EXPECT_EQ(push(600.0, 0.12, 15e-3, device(), {}, 3.3).most_damping, 0.0);
}

TEST(PassivityController, TakesBackWhatAStiffWallGivesOutTooMuch) {
    PassivitySettings observe, control;
    observe.control = false;
    const DeviceDescription bare = device(0.0, 0.0, 0.001);
    const Push without = push(1000.0, 0.2, 4e-3, bare, observe), with = push(1000.0, 0.2, 4e-3, bare, control);
    EXPECT_GT(with.most_damping, 0.0);
    EXPECT_LT(with.work_J, 0.5 * without.work_J);
}

TEST(PassivityController, NeverTurnsAForceAddsEnergyOrExceedsItsGainOnAnyMotion) {
    std::mt19937_64 engine(7);
    const auto number = [&](double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    int acted = 0;
    for (int run = 0; run < 300; ++run) {
        PassivitySettings settings;
        settings.max_damping_Ns_per_m = number(0.0, 20.0);
        const DeviceDescription d = device(number(0.0, 0.2), number(0.0, 0.2), number(0.0, 0.02));
        PassivityState state;
        Vec3 position(0.0);
        for (int i = 0; i < 200; ++i) {
            const Vec3 moved = Vec3(number(-1, 1), number(-1, 1), number(-1, 1)) * number(0.0, 4e-4);
            position += moved;
            PassivityInput in = at(position.y, number(100.0, 20'000.0), 3.3);
            in.position_device_m = position;
            in.wanted_force_device_N.x = number(-0.5, 0.5) * in.wanted_force_device_N.y;
            in.jumped = number(0.0, 1.0) < 0.01;
            const PassivityStep step = keep_passive(state, in, settings, d, kDt);
            const Vec3 added = step.force_device_N - in.wanted_force_device_N;
            const double wanted = glm::length(in.wanted_force_device_N);
            EXPECT_LE(glm::dot(added, moved), 1e-15);                                 // no energy by what it has seen
            EXPECT_GE(glm::dot(step.force_device_N, in.wanted_force_device_N), 0.0);  // no pull
            EXPECT_NEAR(glm::length(glm::cross(step.force_device_N, in.wanted_force_device_N)), 0.0, 1e-9);
            EXPECT_LE(glm::length(added), settings.max_damping_Ns_per_m * glm::length(moved) / kDt + 1e-12);
            EXPECT_LE(step.damping_Ns_per_m, settings.max_damping_Ns_per_m);
            if (i > 0 && std::abs(glm::dot(moved, in.wanted_force_device_N)) < 1.99 * kStep * wanted) {
                EXPECT_EQ(added, Vec3(0.0));  // quiet below two steps
            }
            if (step.damping_Ns_per_m > 0.0) ++acted;
            state = told(step.next, step.force_device_N * std::min(1.0, 3.3 / std::max(3.3, wanted)));
        }
    }
    EXPECT_GT(acted, 1000);
}

TEST(PassivityObserver, StartsAnewInFreeSpaceOnceTheLastForceHasActed) {
    PassivityState state;
    const DeviceDescription d = device();
    const auto go = [&](double y) {
        const PassivityStep step = keep_passive(state, at(y, 1000.0), {}, d, kDt);
        state = told(step.next, step.force_device_N);
        return step.energy_J;
    };
    (void)go(0.001);
    (void)go(-0.001);
    (void)go(-0.001);
    EXPECT_NE(go(0.001), 0.0);   // the force of the tick before is still acting
    EXPECT_NE(go(0.0011), 0.0);  // told before the wall was left
    EXPECT_EQ(go(0.0012), 0.0);
}

TEST(PassivityController, DoesNothingWhereNobodySaysWhatTheDeviceWasTold) {
    PassivityState state;
    for (int i = 0; i < 40; ++i) {
        const PassivityStep step = keep_passive(state, at(-0.0003 * i, 2000.0), {}, device(0.0, 0.0, 0.0), kDt);
        EXPECT_EQ(step.damping_Ns_per_m, 0.0);
        EXPECT_EQ(step.energy_J, 0.0);
        state = step.next;
    }
}

TEST(PassivityController, WaitsWhileTheGateFadesAForceIn) {
    PassivityState state;
    const DeviceDescription d = device(0.0, 0.0, 0.0);
    double damping = 0.0;
    for (int i = 0; i < 40; ++i) {
        PassivityInput in = at(-0.0003 * i, 2000.0);
        in.jumped = i <= 1;
        const PassivityStep step = keep_passive(state, in, {}, d, kDt);
        damping = std::max(damping, step.damping_Ns_per_m);
        state = told(step.next, step.force_device_N * (0.01 * i));
    }
    EXPECT_EQ(damping, 0.0);
}

}  // namespace burin

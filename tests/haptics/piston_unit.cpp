// SPDX-License-Identifier: MIT
// The force of a glove's piston: the rule and where it ends, and what a whole tick makes of it.
#include "haptics/forces/piston.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "haptics/tick.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics {
namespace {

constexpr double kRight = 0.5 * std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinite = HUGE_VAL;

Vec3 any_vector(compute::test::Random& random) {
    return {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
}

// At this angle to the y axis, about which it is turned anyhow.
Vec3 tilted(double theta, double around = 0.0) {
    return {std::sin(theta) * std::cos(around), std::cos(theta), std::sin(theta) * std::sin(around)};
}

}  // namespace

TEST(Piston, GivesTheForceWhoseComponentAlongTheContactsIsTheContacts) {
    compute::test::Random random(1);
    int in_the_cone = 0;
    for (int i = 0; i < 10'000; ++i) {
        const Vec3 force = 3.0 * any_vector(random), along = 0.1 * any_vector(random);
        const double cosine = glm::dot(force, along) / (glm::length(force) * glm::length(along));
        const PistonForce p = piston_force(force, along);
        if (cosine < PistonSettings{}.least_cosine) {
            EXPECT_NE(p.bound, PistonBound::none);
            continue;
        }
        ++in_the_cone;
        EXPECT_EQ(p.bound, PistonBound::none);
        EXPECT_NEAR(glm::length(p.force_N), glm::length(force) / cosine, 1e-12);
        EXPECT_NEAR(glm::dot(p.force_N, force) / glm::length(force), glm::length(force), 1e-12);
        EXPECT_NEAR(glm::length(glm::cross(p.force_N, along)), 0.0, 1e-14) << "along the piston and nowhere else";
    }
    EXPECT_GT(in_the_cone, 3000);
}

TEST(Piston, NeverGivesMoreThanItsBoundAndFallsToNothingAtARightAngleWithoutAStep) {
    for (const double least : {0.1, 0.25, 0.5, 1.0}) {
        double last_N = 2.0;
        for (int i = 0; i <= 180'000; ++i) {
            const double theta = 2.0 * kRight * i / 180'000;
            const PistonForce p = piston_force(2.0 * tilted(theta), {0.0, 0.07, 0.0}, {least});
            const double force_N = p.force_N.y;
            ASSERT_GE(force_N, 0.0);
            ASSERT_LE(force_N, 2.0 / least * (1.0 + 1e-12));
            // It changes at most as fast as 2 / cos(theta) does at the bound, or as falls from there to a right angle.
            ASSERT_LE(std::abs(force_N - last_N), 2.01 / (least * least) * 2.0 * kRight / 180'000) << theta;
            ASSERT_EQ(p.bound == PistonBound::pull, theta > kRight) << theta;
            ASSERT_EQ(p.bound == PistonBound::near_square, theta < kRight && std::cos(theta) < least) << theta;
            ASSERT_EQ(force_N == 0.0, theta > kRight) << theta;
            last_N = force_N;
        }
    }
}

TEST(Piston, GivesNothingWhereThereIsNoForceOrNoDirectionAndHidesNothingThatIsNotFinite) {
    EXPECT_EQ(piston_force(Vec3(0.0), {0.0, 0.07, 0.0}).force_N, Vec3(0.0));
    EXPECT_EQ(piston_force(Vec3(0.0), {0.0, 0.07, 0.0}).bound, PistonBound::none);
    EXPECT_EQ(piston_force({0.0, 1.0, 0.0}, Vec3(0.0)).force_N, Vec3(0.0));
    EXPECT_EQ(piston_force({0.0, 1.0, 0.0}, Vec3(0.0)).bound, PistonBound::no_axis);
    EXPECT_EQ(piston_force(Vec3(0.0), Vec3(0.0)).force_N, Vec3(0.0));
    EXPECT_EQ(piston_force({0.0, -1.0, 0.0}, {0.0, 0.07, 0.0}).force_N, Vec3(0.0));
    EXPECT_EQ(piston_force({0.0, 1.0, 0.0}, {0.0, 1e-300, 0.0}).force_N, Vec3(0.0)) << "shorter than can be squared";
    for (const double bad : {kNaN, kInfinite, -kInfinite})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 broken(0.0, 1.0, 0.0);
            broken[axis] = bad;
            for (const Vec3& whole : {Vec3(0.0, 1.0, 0.0), Vec3(0.0)}) {
                EXPECT_FALSE(finite(piston_force(broken, whole).force_N)) << bad << ' ' << axis;
                EXPECT_FALSE(finite(piston_force(whole, broken).force_N)) << bad << ' ' << axis;
            }
            EXPECT_FALSE(finite(piston_force(broken, broken).force_N)) << bad << ' ' << axis;
            EXPECT_FALSE(finite(pushed_part(broken, {true, {}}, {0.0, 1.0, 0.0}))) << bad << ' ' << axis;
            EXPECT_FALSE(finite(pushed_part(broken, {true, {}}, Vec3(0.0)))) << bad << ' ' << axis;
        }
}

TEST(Piston, OfOtherForcesGivesWhatPushes) {
    const devices::Piston none, piston{true, {0.0, -0.07, 0.0}};
    EXPECT_EQ(pushed_part({1.0, 2.0, 3.0}, none, Vec3(0.0)), Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(pushed_part({1.0, 2.0, 3.0}, piston, Vec3(0.0)), Vec3(0.0, 2.0, 0.0));
    EXPECT_EQ(pushed_part({1.0, -2.0, 3.0}, piston, Vec3(0.0)), Vec3(0.0));
    EXPECT_EQ(pushed_part({1.0, 2.0, 3.0}, piston, piston.foot_device_m), Vec3(0.0));
}

// ---- In the tick

namespace {

constexpr double kStiffness_N_per_m = 500.0, kBall_m = 0.004;

// A fingertip that a piston drives, its foot 70 mm below the origin, in a palm beneath what is grasped.
devices::DeviceDescription glove() {
    devices::DeviceDescription device = test::kStrongDevice;
    device.max_torque_Nm = Vec3(0.0);
    device.friction_N = 0.1;
    device.damping_Ns_per_m = 0.05;
    device.apparent_mass_kg = 0.01;
    device.piston = {true, {0.0, -0.07, 0.0}};
    return device;
}

TickParameters firm() {
    TickParameters p;
    p.probe = ball_probe(kBall_m);
    p.clearance_ratio = 0.0;
    p.materials[0].stiffness_N_per_m = kStiffness_N_per_m;
    p.materials[0].damping_Ns_per_m = 0.0;
    p.limit_stiffness = false;
    p.passivity.control = false;
    p.max_surface_age_s = 0.0;
    p.limits.max_force_N = 100.0;
    p.limits.ramp_s = p.limits.contact_ramp_s = 0.0;
    return p;
}

// A plane through the origin whose normal is at this angle to the y axis.
test::Surface tilted_plane(double theta) {
    test::SurfaceBuilder b;
    const Vec3 n = tilted(theta), u(n.y, -n.x, 0.0), w(0.0, 0.0, 1.0);
    b.quad(-0.3 * u - 0.3 * w, -0.3 * u + 0.3 * w, 0.3 * u + 0.3 * w, 0.3 * u - 0.3 * w);
    return b.finish();
}

// Ticks that follow each other, gate included.
struct Ticks {
    const geometry::LocalSurface& surface;
    TickParameters parameters = firm();
    devices::DeviceDescription device = glove();
    FullTickState state{};
    Nanoseconds now_ns = 1'000'000'000;

    TickRecord operator()(const Vec3& hand_m) {
        devices::DeviceSample sample;
        sample.time_ns = now_ns += 1'000'000;
        sample.position_device_m = hand_m;
        const FullTick full = full_tick(state, sample, surface, parameters, device, now_ns, 1e-3);
        state = full.next;
        return full.record;
    }
};

}  // namespace

TEST(Piston, MakesAWallAsStiffAlongItselfAsItsMaterialHoweverItIsTilted) {
    for (const double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 80.0, 88.0}) {
        const double theta = degrees / 90.0 * kRight, cosine = std::cos(theta);
        const test::Surface wall = tilted_plane(theta);
        Ticks ticks{*wall};
        // The ball's centre is where it touches; from there the tip goes down the piston's axis.
        const double touching_m = kBall_m / cosine;
        const bool within = cosine >= PistonSettings{}.least_cosine;
        std::uint64_t bound = 0;
        for (int i = -50; i <= 400; ++i) {
            const double x = 1e-5 * i;
            const TickRecord r = ticks({0.0, touching_m - x, 0.0});
            if (i < 10) continue;
            const double softer = within ? 1.0 : cosine * cosine / std::pow(PistonSettings{}.least_cosine, 2);
            const Vec3 given = r.gate.given.force_device_N;
            EXPECT_NEAR(given.y, kStiffness_N_per_m * x * softer, 1e-6) << degrees << ' ' << i;
            EXPECT_EQ(Vec3(given.x, 0.0, given.z), Vec3(0.0)) << degrees;
            EXPECT_EQ(r.contact.piston_bound, within ? PistonBound::none : PistonBound::near_square);
            EXPECT_EQ((r.flags & kTickPistonBound) != 0, !within);
            EXPECT_NEAR(r.contact.spring_energy_J, 0.5 * given.y * x, 1e-9) << "as that of a spring along the piston";
            bound = r.contact.piston_bound_ticks;
        }
        EXPECT_EQ(bound > 350, !within) << degrees << ": where the bound bites it is counted";
    }
}

TEST(Piston, GivesTheSumOfAFingertipsFivePointsAndNoTorque) {
    const test::Surface wall = tilted_plane(0.6);
    Ticks ticks{*wall};
    ticks.parameters.probe.count = 5;
    for (std::uint32_t i = 1; i < 5; ++i) {
        const double around = kRight * i;
        ticks.parameters.probe.points[i].offset_device_m = 0.003 * Vec3(std::cos(around), 0.0, std::sin(around));
        ticks.parameters.probe.points[i].radius_m = kBall_m;
    }
    ticks.device.max_torque_Nm = Vec3(1.0);
    for (int i = -200; i <= 200; ++i) {
        const TickRecord r = ticks({0.0, kBall_m / std::cos(0.6) - 1e-5 * i, 0.0});
        Vec3 sum_N(0.0);
        for (std::uint32_t k = 0; k < 5; ++k) sum_N += r.contact.points[k].force_device_N;
        ASSERT_NEAR(r.wanted.force_device_N.y, glm::length(sum_N) / std::cos(0.6), 1e-6) << i;
        ASSERT_EQ(r.wanted.torque_device_Nm, Vec3(0.0));
    }
}

TEST(Piston, StillEndsAtTheGate) {
    const test::Surface wall = tilted_plane(1.2);
    Ticks ticks{*wall};
    ticks.device.max_force_N = 1.0;
    ticks.parameters.limits.max_slew_N_per_s = 100.0;
    double last_N = 0.0, most_N = 0.0;
    for (int i = 0; i < 200; ++i) {
        const TickRecord r = ticks({0.0, kBall_m / std::cos(1.2) - 1e-4 * i, 0.0});
        const double given_N = r.gate.given.force_device_N.y;
        ASSERT_LE(given_N, 1.0 + 1e-12);
        ASSERT_LE(std::abs(given_N - last_N), 0.1 + 1e-12);
        most_N = std::max(most_N, r.wanted.force_device_N.y);
        last_N = given_N;
    }
    EXPECT_GT(most_N, 5.0) << "it was asked for much more";
    EXPECT_NEAR(last_N, 1.0, 1e-12);
    ticks.device.piston.foot_device_m.x = kNaN;
    TickRecord r = ticks({0.0, 0.0, 0.0});
    EXPECT_EQ(r.gate.cause, GateCause::not_finite);
    EXPECT_EQ(r.gate.given.force_device_N, Vec3(0.0));
    ticks.device.piston.foot_device_m.x = 0.0;
    ticks.parameters.piston.least_cosine = 0.0;
    r = ticks({0.0, 0.0, 0.0});
    EXPECT_EQ(r.gate.cause, GateCause::bad_parameters);
}

TEST(Piston, GivesNoWorkThatWasNotPutInWhereAHandMovesAcrossIt) {
    // Sideways into a slope, where the piston resists nothing, and out along the piston, which pushes.
    const test::Surface wall = tilted_plane(1.0);
    const auto excess_J = [&](bool control) {
        Ticks ticks{*wall};
        ticks.parameters.passivity.control = control;
        ticks.device.max_force_N = 5.0;
        const double speed = 0.9 * ticks.parameters.passivity.contact_speed_m_per_s, step_m = 1e-3 * speed;
        const Vec3 out = Vec3(0.0, kBall_m / std::cos(1.0) + 2.0 * step_m, 0.0), aside(-0.008, 0.0, 0.0);
        const Vec3 up(0.0, 0.008 * std::tan(1.0), 0.0);
        const std::array corners{out, out + aside, out + aside + up, out + up};
        Vec3 at = out, given_N(0.0);
        double given_J = 0.0, taken_J = 0.0, worst_J = -HUGE_VAL;
        std::size_t next = 1;
        for (int i = 0; i < 4000; ++i) {
            const Vec3 way = corners[next] - at;
            const Vec3 moved = glm::length(way) <= step_m ? way : step_m * glm::normalize(way);
            if (glm::length(way) <= step_m) next = (next + 1) % corners.size();
            given_J += glm::dot(given_N, moved);
            taken_J += ticks.device.friction_N * glm::length(moved) +
                       ticks.device.damping_Ns_per_m * glm::dot(moved, moved) / 1e-3;
            worst_J = std::max(worst_J, given_J - taken_J);
            at += moved;
            const TickRecord r = ticks(at);
            given_N = r.gate.given.force_device_N;
            if (!r.in_contact() && given_N == Vec3(0.0)) given_J = taken_J = 0.0;
        }
        return worst_J;
    };
    EXPECT_LE(excess_J(true), 1e-12);
    EXPECT_GT(excess_J(false), 1e-3) << "or there would be nothing to keep from the hand";
}

}  // namespace burin::haptics

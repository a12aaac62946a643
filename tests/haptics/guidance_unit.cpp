// SPDX-License-Identifier: MIT
#include "haptics/forces/guidance.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace burin::haptics {
namespace {

GuidanceCurve curve_through(const std::vector<Vec3>& points) {
    GuidanceCurve curve;
    for (const Vec3& p : points) curve.points_object_m[curve.count++] = Vec3f(p);
    return curve;
}

// Along x from 0 to 0.1.
GuidanceCurve straight(double scale = 1.0) {
    return curve_through({{0, 0, 0}, {0.025 * scale, 0, 0}, {0.05 * scale, 0, 0}, {0.1 * scale, 0, 0}});
}

GuidanceSettings settings() {
    GuidanceSettings s;
    s.stiffness_N_per_m = 200.0;
    s.max_force_N = 1.5;
    s.reach_m = 0.02;
    return s;
}

// The point stays until the next call.
GuidanceInput at(const Vec3& hip, const Vec3& velocity = Vec3(0.0)) {
    static std::array<GuidedPoint, 1> point;
    point[0].hip_object_m = hip;
    GuidanceInput in;
    in.points = point;
    in.velocity_device_m_per_s = velocity;
    in.dt_s = kDt;
    return in;
}

}  // namespace

TEST(Guidance, DrawsToTheNearestPointWithStiffnessTimesDistance) {
    const GuidanceStep step = guide({}, at({0.03, 0.003, -0.004}), straight(), settings());
    EXPECT_TRUE(step.next.held);
    EXPECT_NEAR(step.next.along_m, 0.03, 1e-8);
    EXPECT_NEAR(step.distance_m, 0.005, 1e-9);
    EXPECT_LT(glm::length(step.force_device_N - 200.0 * Vec3(0.0, -0.003, 0.004)), 1e-6);
}

TEST(Guidance, BeyondTheEndsItDrawsBackToThem) {
    EXPECT_LT(glm::length(guide({}, at({-0.003, 0, 0}), straight(), settings()).force_device_N - Vec3(0.6, 0, 0)),
              1e-6);
    EXPECT_LT(glm::length(guide({}, at({0.103, 0, 0}), straight(), settings()).force_device_N - Vec3(-0.6, 0, 0)),
              1e-5);
}

TEST(Guidance, IsAtMostTheLargestForceAndFadesToNothingAtTheEndOfTheReach) {
    double last = 0.0;
    for (int i = 1; i <= 300; ++i) {
        const double distance = 1e-4 * i;
        const GuidanceStep step = guide({}, at({0.05, distance, 0}), straight(), settings());
        const double expected = std::min(200.0 * distance, 1.5) * std::clamp((0.02 - distance) / 0.005, 0.0, 1.0);
        EXPECT_NEAR(-step.force_device_N.y, expected, 1e-6) << distance;
        EXPECT_LT(std::abs(-step.force_device_N.y - last), 0.035) << distance;  // no jump anywhere on the way
        EXPECT_EQ(step.next.held, distance < 0.02);
        last = -step.force_device_N.y;
    }
}

TEST(Guidance, AlongTheCurveItIsFreeAndAcrossItDamps) {
    GuidanceSettings s = settings();
    s.damping_Ns_per_m = 3.0;
    const GuidanceStep step = guide({}, at({0.03, 0.0, 0.0}, {0.2, 0.05, -0.1}), straight(), s);
    EXPECT_LT(glm::length(step.force_device_N - Vec3(0.0, -0.15, 0.3)), 1e-6);
    s.damping_Ns_per_m = 100.0;  // spring and damper together stay within the largest force
    EXPECT_LE(glm::length(guide({}, at({0.03, 0.01, 0.0}, {0, 0.5, 0.1}), straight(), s).force_device_N), 1.5 + 1e-12);
}

TEST(Guidance, WithAGainAndATurnedDeviceItFeelsTheSame) {
    for (const double scale : {0.05, 1.0, 20.0}) {
        GuidanceInput in = at(scale * Vec3(0.03, 0.003, -0.004), {0.01, 0.02, 0.03});
        in.scale = scale;
        in.object_from_device_orientation = glm::normalize(Quat(0.7, 0.1, -0.4, 0.5));
        GuidanceSettings s = settings();
        s.reach_m *= scale;
        s.damping_Ns_per_m = 2.0;
        const Vec3 force_object_N =
            in.object_from_device_orientation * guide({}, in, straight(scale), s).force_device_N;
        const Vec3 velocity_object = in.object_from_device_orientation * in.velocity_device_m_per_s;
        const Vec3 expected = 200.0 * Vec3(0.0, -0.003, 0.004) - 2.0 * Vec3(0.0, velocity_object.y, velocity_object.z);
        EXPECT_LT(glm::length(force_object_N - expected), 1e-5) << scale;
    }
}

TEST(Guidance, IsContinuousAlongACornerAndAnArc) {
    std::vector<Vec3> points{{-0.05, 0, 0}};
    for (int i = 0; i <= 60; ++i) {
        const double a = std::numbers::pi * i / 60 - std::numbers::pi / 2.0;
        points.push_back({0.03 * std::cos(a), 0.03 * std::sin(a) + 0.03, 0.0});
    }
    points.push_back({-0.05, 0.06, 0.0});
    points.push_back({-0.05, 0.08, 0.0});
    const GuidanceCurve curve = curve_through(points);
    GuidanceState state;
    Vec3 last(0.0);
    for (int i = 0; i <= 4000; ++i) {  // outside the bend, where the nearest point is unique
        const double a = std::numbers::pi * i / 4000 - std::numbers::pi / 2.0;
        const Vec3 hip(0.034 * std::cos(a), 0.034 * std::sin(a) + 0.03, 0.002 * std::sin(9.0 * a));
        const GuidanceStep step = guide(state, at(hip), curve, settings());
        ASSERT_TRUE(step.next.held);
        const Vec3 to_arc = 200.0 * (Vec3(0.03 * std::cos(a), 0.03 * std::sin(a) + 0.03, 0.0) - hip);
        EXPECT_LT(glm::length(step.force_device_N - to_arc), 0.03) << i;  // the polyline's corners cut the arc
        if (i > 0) {
            EXPECT_LT(glm::length(step.force_device_N - last), 0.01) << i;
        }
        last = step.force_device_N;
        state = step.next;
    }
}

TEST(Guidance, OfTwoStretchesTheOneHeldIsKeptUntilTheOtherIsNearerByATenthOfTheReach) {
    // A hairpin: along x at y = 0, back at y = 0.01.
    const GuidanceCurve curve = curve_through({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.01, 0}, {0, 0.01, 0}});
    for (const bool upwards : {true, false}) {
        GuidanceState state;
        double changed_at = -1.0;
        for (int i = 0; i <= 100; ++i) {
            const double y = upwards ? 1e-4 * i : 0.01 - 1e-4 * i;
            const GuidanceStep step = guide(state, at({0.03, y, 0}), curve, settings());
            const bool lower = step.next.along_m < 0.1;
            if (lower != upwards && changed_at < 0.0) changed_at = y;
            state = step.next;
        }
        // |distance to one - distance to the other| is 0.002 a millimetre beyond the middle.
        EXPECT_NEAR(changed_at, upwards ? 0.006 : 0.004, 1.5e-4);
    }
}

TEST(Guidance, LeadsAlongAtItsSpeedWaitsForTheHandAndStaysAtTheEnd) {
    GuidanceSettings s = settings();
    s.lead_speed_m_per_s = 0.02;
    GuidanceStep step = guide({}, at({0.01, 0, 0}), straight(), s);
    EXPECT_NEAR(step.next.along_m, 0.01, 1e-8);
    // A hand that goes along, a little behind.
    for (int i = 1; i <= 1000; ++i) {
        const double x = 0.01 + 0.02 * kDt * i - 0.002;
        step = guide(step.next, at({x, 0, 0}), straight(), s);
    }
    EXPECT_NEAR(step.next.along_m, 0.03, 1e-6);
    EXPECT_NEAR(step.force_device_N.x, 200.0 * 0.002, 1e-4);  // taken along
    // A hand that stops: the point runs ahead, slower and slower, to half the reach.
    for (int i = 0; i < 5000; ++i) step = guide(step.next, at({0.028, 0, 0}), straight(), s);
    EXPECT_NEAR(step.next.along_m, 0.028 + 0.01, 2e-4);
    EXPECT_TRUE(step.next.held);
    // Followed again it goes on, to the end and no farther.
    for (int i = 0; i < 6000; ++i) step = guide(step.next, at({step.next.along_m, 0, 0}), straight(), s);
    EXPECT_NEAR(step.next.along_m, 0.1, 1e-6);
    EXPECT_LT(glm::length(step.force_device_N), 1e-6);
}

// A wand whose two points lie 0.03 m off its middle along its y axis.
struct Wand {
    explicit Wand(const Vec3& middle, const Quat& orientation = {1, 0, 0, 0}) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3 offset(0.0, i == 0 ? 0.03 : -0.03, 0.0);
            points[i] = {middle + orientation * offset, offset, orientation * offset};
        }
        in.points = points;
        in.dt_s = kDt;
    }
    Wand(const Wand&) = delete;
    Wand& operator=(const Wand&) = delete;
    std::array<GuidedPoint, 2> points;
    GuidanceInput in;
};

TEST(Guidance, DrawsTheMiddleOfAWandAndTurnsItOnlyWhereAnOrientationIsSet) {
    const Quat leaning = glm::angleAxis(0.1, Vec3(0, 0, 1));
    const Wand wand({0.03, 0.003, -0.004}, leaning);
    GuidanceSettings s = settings();
    const GuidanceStep free = guide({}, wand.in, straight(), s);
    EXPECT_LT(glm::length(free.force_device_N - 200.0 * Vec3(0.0, -0.003, 0.004)), 1e-6);
    EXPECT_EQ(free.torque_device_Nm, Vec3(0.0));
    s.holds_orientation = true;
    const GuidanceStep held = guide({}, wand.in, straight(), s);
    EXPECT_LT(glm::length(held.force_device_N - free.force_device_N), 1e-6);  // opposite pulls at the ends cancel
    // Each end is drawn by 100 N/m to its place: about z, 2 * 100 * 0.03^2 sin(0.1), back to upright.
    EXPECT_NEAR(held.torque_device_Nm.z, -2.0 * 100.0 * 0.03 * 0.03 * std::sin(0.1), 1e-8);
    EXPECT_NEAR(held.torque_device_Nm.x, 0.0, 1e-9);
    EXPECT_NEAR(held.torque_device_Nm.y, 0.0, 1e-9);
}

TEST(Guidance, LeadsAWandInTheOrientationThatIsSetWithoutTorqueOnceItIsThere) {
    const Quat leaning = glm::angleAxis(0.4, glm::normalize(Vec3(1, 0, 2)));
    const Wand wand({0.05, 0.0, 0.0}, leaning);
    GuidanceSettings s = settings();
    s.holds_orientation = true;
    s.orientation_object = leaning;
    const GuidanceStep step = guide({}, wand.in, straight(), s);
    EXPECT_LT(glm::length(step.force_device_N), 1e-6);
    EXPECT_LT(glm::length(step.torque_device_Nm), 1e-9);
}

TEST(Guidance, BothPointsTogetherGiveAtMostTheLargestForceAndAreDampedInTurning) {
    Wand wand({0.05, 0.012, 0.0});
    GuidanceSettings s = settings();
    s.holds_orientation = true;
    EXPECT_NEAR(glm::length(guide({}, wand.in, straight(), s).force_device_N), 1.5, 1e-9);
    s.damping_Ns_per_m = 2.0;
    Wand turning({0.05, 0.0, 0.0});
    turning.in.angular_velocity_device_rad_per_s = {0.5, 0.0, 0.0};  // its ends move along z, across the curve
    const GuidanceStep step = guide({}, turning.in, straight(), s);
    EXPECT_NEAR(step.torque_device_Nm.x, -2.0 * 1.0 * 0.03 * 0.03 * 0.5, 1e-9);
    EXPECT_LT(glm::length(step.force_device_N), 1e-9);
}

TEST(Guidance, PushesOffTheCurveWhereErrorsAreAugmented) {
    GuidanceSettings s = settings();
    s.repels = true;
    s.lead_speed_m_per_s = 0.1;
    GuidanceStep step = guide({}, at({0.03, 0.003, -0.004}), straight(), s);
    EXPECT_LT(glm::length(step.force_device_N - 200.0 * Vec3(0.0, 0.003, -0.004)), 1e-6);
    for (int i = 0; i < 100; ++i) step = guide(step.next, at({0.03, 0.003, -0.004}), straight(), s);
    EXPECT_NEAR(step.next.along_m, 0.03, 1e-8);  // leads nowhere
    EXPECT_LE(glm::length(guide({}, at({0.03, 0.012, 0.0}), straight(), s).force_device_N), 1.5 + 1e-12);
}

TEST(Guidance, NothingIsDrawnWithoutACurveOrStiffnessOrWithinNoReach) {
    EXPECT_FALSE(guide({}, at(Vec3(0.0)), {}, settings()).next.held);
    EXPECT_FALSE(guide({}, at(Vec3(0.0)), straight(), {}).next.held);
    GuidanceSettings s = settings();
    s.reach_m = 0.0;
    EXPECT_FALSE(guide({}, at(Vec3(0.0)), straight(), s).next.held);
    // Points that coincide are no trouble.
    const GuidanceCurve still = curve_through({{0.01, 0, 0}, {0.01, 0, 0}, {0.01, 0, 0}});
    EXPECT_LT(glm::length(guide({}, at(Vec3(0.005, 0, 0)), still, settings()).force_device_N - Vec3(1.0, 0, 0)), 1e-5);
}

TEST(Guidance, FollowsTheToolBackAsItDoesForth) {
    const GuidanceCurve curve = straight();
    GuidanceState state;
    for (int i = 0; i <= 180; ++i) {  // 90 mm forth and back over all stretches
        const double x = 0.005 + 0.001 * (i <= 90 ? i : 180 - i);
        const GuidanceStep step = guide(state, at({x, 0.003, 0.0}), curve, settings());
        ASSERT_TRUE(step.next.held);
        ASSERT_NEAR(step.next.along_m, x, 1e-8) << i;
        ASSERT_NEAR(step.distance_m, 0.003, 1e-9) << i;
        state = step.next;
    }
}

}  // namespace burin::haptics

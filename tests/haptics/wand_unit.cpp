// SPDX-License-Identifier: MIT
// The two-point wand: forces of both ends as one force and one torque, through the real tick.
#include <gtest/gtest.h>

#include <cmath>

#include "devices/haptic/wand_description.hpp"
#include "haptics/tick.hpp"
#include "tests/haptics/cutting_ball.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

const Vec3 kTop(0.0, 0.08, 0.0), kBottom(0.0, -0.08, 0.0);

// What the wand's maker says: yaw, about y, is passive.
constexpr devices::DeviceDescription kWand{
    .name = "wand", .max_force_N = 100.0, .max_torque_Nm = Vec3(10.0, 0.0, 10.0), .max_stiffness_N_per_m = 1e6};

TickParameters wand(double radius_m, double stiffness_N_per_m) {
    TickParameters p;
    p.probe.count = 2;
    p.probe.points[0] = {kTop, radius_m};
    p.probe.points[1] = {kBottom, radius_m};
    p.clearance_ratio = 0.0;
    p.limit_stiffness = false;
    p.passivity.control = false;
    p.materials[0].stiffness_N_per_m = stiffness_N_per_m;
    p.materials[0].damping_Ns_per_m = 0.0;
    p.max_surface_age_s = 0.0;
    return p;
}

struct WandHand {
    const geometry::LocalSurface* surface;
    TickParameters parameters;
    devices::DeviceDescription device = test::kStrongDevice;
    TickState state{};
    Nanoseconds now_ns = 0;

    TickRecord at(const Vec3& position, const Quat& orientation = {1, 0, 0, 0}) {
        now_ns += kMs;
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        sample.position_device_m = position;
        sample.orientation_device = orientation;
        const Tick t = tick(state, sample, *surface, parameters, device, now_ns, kDt);
        state = t.next;
        return t.record;
    }
};

// Three walls that meet in a corner at `apex`, open towards `out` (its signs): a ball in it can be pushed back in any
// direction between the walls' normals.
void add_corner(test::SurfaceBuilder& b, const Vec3& apex, const Vec3& out, double size) {
    const Vec3 s(std::copysign(size, out.x), std::copysign(size, out.y), std::copysign(size, out.z));
    const bool even = s.x * s.y * s.z > 0.0;
    const auto wall = [&](const Vec3& u, const Vec3& v) {
        if (even) {
            b.quad(apex, apex + u, apex + u + v, apex + v);
        } else {
            b.quad(apex, apex + v, apex + u + v, apex + u);
        }
    };
    wall({s.x, 0, 0}, {0, s.y, 0});
    wall({0, s.y, 0}, {0, 0, s.z});
    wall({0, 0, s.z}, {s.x, 0, 0});
}

Quat rotation_of_check() {
    const Vec3 k = Vec3(1.0, 2.0, 3.0) / std::sqrt(14.0);
    return {std::cos(0.35), std::sin(0.35) * k.x, std::sin(0.35) * k.y, std::sin(0.35) * k.z};
}

void expect_near(const Vec3& value, const Vec3& expected, double tolerance) {
    EXPECT_NEAR(value.x, expected.x, tolerance);
    EXPECT_NEAR(value.y, expected.y, tolerance);
    EXPECT_NEAR(value.z, expected.z, tolerance);
}

}  // namespace

TEST(Wand, TheSumHasTheCheckValuesOfTheRequirements) {
    const PointForce top{kTop, {0.0, 0.0, -1.0}};
    expect_near(sum_of({&top, 1}).torque_device_Nm, {-0.08, 0.0, 0.0}, 1e-15);
    const Quat R = rotation_of_check();
    const std::array both{PointForce{R * kTop, {0.3, -0.2, -1.0}}, PointForce{R * kBottom, {0.0, 0.1, -0.4}}};
    const devices::DeviceWrench sum = sum_of(both);
    expect_near(sum.force_device_N, {0.3, -0.1, -1.4}, 1e-15);
    expect_near(sum.torque_device_Nm, {-0.03338649, -0.01662965, -0.00837842}, 1e-8);
}

TEST(Wand, TheTickHasTheCheckValuesOfTheRequirements) {
    // Each end lies in a corner of three walls and is pressed so far beyond each that its spring gives the force
    // wanted. A soft spring makes the way long against the walls' rounding to float: the top corner is exact, the
    // bottom one within 6e-9 m.
    const double k = 10.0, radius = 0.002;
    const Quat R = rotation_of_check();
    const Vec3 position(0.013, -0.027, 0.041);
    const Vec3 top_force(0.3, -0.2, -1.0), bottom_force(0.0, 0.1, -0.4);
    const auto signs = [](const Vec3& v) {
        return Vec3(std::copysign(1.0, v.x), std::copysign(1.0, v.y), std::copysign(1.0, v.z));
    };
    // HIP + F / k is where the proxy shall be: a radius off the apex along each wall's normal.
    const auto apex_for = [&](const Vec3& arm, const Vec3& force) {
        return position + R * arm + force / k - radius * signs(force);
    };
    const Vec3 top_apex = apex_for(kTop, top_force);
    const Vec3 bottom_apex = apex_for(kBottom, bottom_force) - Vec3(0.02, 0.0, 0.0);  // its x wall is far from the ball
    test::SurfaceBuilder b(top_apex);
    add_corner(b, top_apex, top_force, 0.03);
    add_corner(b, bottom_apex, bottom_force, 0.06);
    const test::Surface corners = b.finish();
    WandHand hand{corners.get(), wand(radius, k)};
    hand.parameters.shading = false;
    hand.at(position, R);
    // Both ends come from the open side of their corners.
    const auto in_the_open = [&](const Vec3& apex, const Vec3& out) {
        return ProxyState{apex + 0.012 * signs(out), corners->sequence, true, false};
    };
    hand.state.probe.proxies[0] = in_the_open(top_apex, top_force);
    hand.state.probe.proxies[1] = in_the_open(bottom_apex, bottom_force);
    hand.state.probe.proxies[1].position_object_m.x += 0.02;
    TickRecord out;
    for (int i = 0; i < 50; ++i) out = hand.at(position, R);
    ASSERT_EQ(out.contact.points[0].constraints, 3u);
    ASSERT_EQ(out.contact.points[1].constraints, 2u);
    expect_near(out.contact.points[0].force_device_N, top_force, 1e-12);
    expect_near(out.contact.points[1].force_device_N, bottom_force, 1e-7);
    expect_near(out.wanted.force_device_N, {0.3, -0.1, -1.4}, 1e-7);
    expect_near(out.wanted.torque_device_Nm, {-0.03338649, -0.01662965, -0.00837842}, 1e-8);
    // And of the very forces that the points have, to the last digits.
    const Vec3 torque = glm::cross(R * kTop, out.contact.points[0].force_device_N) +
                        glm::cross(R * kBottom, out.contact.points[1].force_device_N);
    expect_near(out.wanted.torque_device_Nm, torque, 1e-15);
    // The Quanser wand drives x and z of it.
    const devices::WandDescription quanser;
    hand.device = devices::device_of(quanser);
    out = hand.at(position, R);
    expect_near(out.wanted.force_device_N, {0.3, -0.1, -1.4}, 1e-7);
    expect_near(out.wanted.torque_device_Nm, {-0.03338649, 0.0, -0.00837842}, 1e-8);
}

TEST(Wand, OnACubeTopAloneTurnsOneWayBottomAloneTheOtherAndBothCancel) {
    // The wand stands upright before the cube's face z = 0 and is pressed into it along +z; a narrow cube meets one end
    // alone.
    const auto press = [](const geometry::LocalSurface& cube) {
        WandHand hand{&cube, wand(0.004, 500.0)};
        hand.at({0.0, 0.0, -0.02});
        return hand.at({0.0, 0.0, -0.002});  // 2 mm beyond where the balls touch
    };
    const test::Surface whole = test::box({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.4}, 8);
    const test::Surface upper = test::box({-0.2, 0.02, 0.0}, {0.2, 0.2, 0.4}, 8);
    const test::Surface lower = test::box({-0.2, -0.2, 0.0}, {0.2, -0.02, 0.4}, 8);
    const double force = 500.0 * 0.002;
    const TickRecord top = press(*upper), bottom = press(*lower), both = press(*whole);
    expect_near(top.wanted.force_device_N, {0.0, 0.0, -force}, 1e-4);
    expect_near(top.wanted.torque_device_Nm, {-0.08 * force, 0.0, 0.0}, 1e-5);
    EXPECT_EQ(top.contact.points[1].constraints, 0u);
    expect_near(bottom.wanted.force_device_N, {0.0, 0.0, -force}, 1e-4);
    expect_near(bottom.wanted.torque_device_Nm, {0.08 * force, 0.0, 0.0}, 1e-5);
    EXPECT_EQ(bottom.contact.points[0].constraints, 0u);
    expect_near(both.wanted.force_device_N, {0.0, 0.0, -2.0 * force}, 2e-4);
    expect_near(both.wanted.torque_device_Nm, Vec3(0.0), 1e-5);
}

TEST(Wand, ASinglePointFeelsNothingAtItsEnds) {
    const test::Surface upper = test::box({-0.2, 0.02, 0.0}, {0.2, 0.2, 0.4}, 8);
    TickParameters p = wand(0.004, 500.0);
    p.probe = ball_probe(0.004);
    WandHand hand{upper.get(), p};
    hand.at({0.0, 0.0, -0.02});
    const TickRecord out = hand.at({0.0, 0.0, 0.01});  // the upper end would be a centimetre deep
    EXPECT_EQ(out.wanted.force_device_N, Vec3(0.0));
    EXPECT_EQ(out.wanted.torque_device_Nm, Vec3(0.0));
}

TEST(Wand, PassiveAxesGetNoTorque) {
    // Pressed at the top, sideways and turned: torque about all three axes, but for the yaw that nothing drives.
    const test::Surface wall = test::box({-0.2, 0.02, 0.0}, {0.2, 0.2, 0.4}, 8);
    const Quat lean = glm::normalize(Quat(1.0, 0.05, 0.1, 0.2));
    WandHand free{wall.get(), wand(0.004, 500.0)}, driven{wall.get(), wand(0.004, 500.0), kWand};
    for (WandHand* hand : {&free, &driven}) hand->at({0.0, 0.0, -0.04}, lean);
    const TickRecord all = free.at({0.0, 0.0, -0.012}, lean), some = driven.at({0.0, 0.0, -0.012}, lean);
    ASSERT_GT(std::abs(all.wanted.torque_device_Nm.y), 1e-3);
    EXPECT_EQ(some.wanted.torque_device_Nm.y, 0.0);
    EXPECT_EQ(some.wanted.torque_device_Nm.x, all.wanted.torque_device_Nm.x);
    EXPECT_EQ(some.wanted.torque_device_Nm.z, all.wanted.torque_device_Nm.z);
    EXPECT_EQ(some.wanted.force_device_N, all.wanted.force_device_N);
}

TEST(Wand, AGainScalesTheSceneAndLeavesForceAndTorqueAsTheyWere) {
    devices::DeviceWrench unscaled;
    for (const double gain : {1.0, 0.2, 30.0}) {
        const test::Surface cube = test::box(gain * Vec3(-0.2, 0.02, 0.0), gain * Vec3(0.2, 0.2, 0.4), 8);
        WandHand hand{cube.get(), wand(0.004 * gain, 500.0)};
        hand.parameters.workspace.object_from_device.scale = gain;
        hand.at({0.0, 0.0, -0.02});
        const TickRecord out = hand.at({0.0, 0.0, -0.002});
        if (gain == 1.0) unscaled = out.wanted;
        expect_near(out.wanted.force_device_N, unscaled.force_device_N, 1e-6);
        expect_near(out.wanted.torque_device_Nm, unscaled.torque_device_Nm, 1e-7);
    }
}

// Two springs side by side are as stiff as one of the sum: together they must not exceed what the device renders.
TEST(Wand, TwoPointsThatTouchShareTheStiffnessThatTheDeviceRenders) {
    const test::Surface plane = test::plane();
    devices::DeviceDescription device = test::kStrongDevice;
    device.max_stiffness_N_per_m = 700.0;
    const auto force_of = [&](const Vec3& top, const Vec3& bottom) {
        TickParameters parameters = wand(0.002, 600.0);
        parameters.limit_stiffness = true;
        parameters.probe.points[0].offset_device_m = top;
        parameters.probe.points[1].offset_device_m = bottom;
        WandHand hand{plane.get(), parameters, device};
        hand.at({0.0, 0.003, 0.0});
        return hand.at({0.0, 0.001, 0.0});
    };
    const TickRecord both = force_of({0.01, 0, 0}, {-0.01, 0, 0}), one = force_of({0.01, 0, 0}, {-0.01, 0.01, 0});
    EXPECT_NEAR(both.wanted.force_device_N.y, 0.7, 1e-6);  // 350 N/m each, 1 mm deep
    EXPECT_NE(both.flags & kTickStiffnessLimited, 0u);
    EXPECT_NEAR(one.wanted.force_device_N.y, 0.6, 1e-6);
    EXPECT_EQ(one.flags & kTickStiffnessLimited, 0u);
}

// q and -q are one orientation: a tracker may change from the one to the other in any sample.
TEST(Wand, TurnsAtTheSameSpeedWhenTheQuaternionChangesItsSign) {
    const test::Surface far_away = test::plane(0.05, 2, -5.0);
    const double turn_a_tick = 0.004;
    const Vec3 axis = glm::normalize(Vec3(1.0, -2.0, 0.5));
    WandHand steady{far_away.get(), wand(0.004, 500.0)}, signs{far_away.get(), wand(0.004, 500.0)};
    for (int i = 0; i < 60; ++i) {
        const double half = 0.5 * turn_a_tick * i;
        const Quat q(std::cos(half), std::sin(half) * axis);
        const Vec3 even = steady.at({0.0, 0.0, 0.0}, q).motion.angular_velocity_device_rad_per_s;
        const Vec3 changing = signs.at({0.0, 0.0, 0.0}, i % 3 == 1 ? -q : q).motion.angular_velocity_device_rad_per_s;
        EXPECT_EQ(changing, even) << i;
        // 4 rad/s; the estimate of a small turn by its sine is 1e-6 of it short.
        if (i > 20) expect_near(even, axis * (turn_a_tick / kDt), 1e-4);
    }
}

// A ball behind three thousand triangles tests them twice on its way out: more than a tick may test in all.
TEST(Wand, AnEndInABusyPlaceLeavesTheOtherItsShareOfTheTicksWork) {
    constexpr int kFine = 39;
    const double radius = 0.005, half = 0.0034;  // the corners of the fine patch are 4.8 mm off
    test::SurfaceBuilder b;
    const double s = 2.0 * half / kFine;
    for (int j = 0; j < kFine; ++j)
        for (int i = 0; i < kFine; ++i) {  // seen from below
            const double x = -half + s * i, z = -half + s * j;
            b.quad({x, 0.0, z}, {x + s, 0.0, z}, {x + s, 0.0, z + s}, {x, 0.0, z + s});
        }
    b.quad({0.05, 0.0, -0.05}, {0.05, 0.0, 0.05}, {0.15, 0.0, 0.05}, {0.15, 0.0, -0.05});
    const test::Surface surface = b.finish();
    WandHand hand{surface.get(), wand(radius, 500.0)};
    hand.parameters.probe.points[0].offset_device_m = {0.0, 0.0001, 0.0};  // just behind the fine patch
    hand.parameters.probe.points[1].offset_device_m = {0.1, 0.004, 0.0};   // 1 mm deep in the coarse one
    const TickRecord out = hand.at(Vec3(0.0));
    EXPECT_NE(out.flags & kTickWorkLimited, 0u) << "the fine patch was to be too much for one tick";
    EXPECT_LE(cost_ns(out.contact.work), 1.01 * ProxyBudget{}.max_cost_ns);
    EXPECT_EQ(out.contact.points[1].constraints, 1u);
    EXPECT_NEAR(out.contact.points[1].penetration_m, 0.001, 1e-5);
    EXPECT_NEAR(out.contact.points[1].force_device_N.y, 0.5, 0.005);
}

// The second end is behind a patch that half of a tick's work is enough for, and nothing is not: it comes out in the
// first tick, although the first end's patch would take the whole of it.
TEST(Wand, TheFirstEndDoesNotSpendTheSecondsHalfOfTheTicksWork) {
    const double half = 0.0034, apart = 0.1;
    test::SurfaceBuilder b;
    const auto patch = [&](double at, int fine) {  // seen from below
        const double s = 2.0 * half / fine;
        for (int j = 0; j < fine; ++j)
            for (int i = 0; i < fine; ++i) {
                const double x = at - half + s * i, z = -half + s * j;
                b.quad({x, 0.0, z}, {x + s, 0.0, z}, {x + s, 0.0, z + s}, {x, 0.0, z + s});
            }
    };
    patch(0.0, 39);
    patch(apart, 12);
    const test::Surface surface = b.finish();
    WandHand hand{surface.get(), wand(0.005, 500.0)};
    hand.parameters.probe.points[0].offset_device_m = {0.0, 0.0001, 0.0};
    hand.parameters.probe.points[1].offset_device_m = {apart, 0.0001, 0.0};
    const TickRecord out = hand.at(Vec3(0.0));
    EXPECT_NE(out.flags & kTickWorkLimited, 0u) << "the first patch was to be too much for one tick";
    EXPECT_LE(cost_ns(out.contact.work), 1.01 * ProxyBudget{}.max_cost_ns);
    EXPECT_LT(out.contact.points[1].proxy_object_m.y, -0.0045);
    EXPECT_GE(out.contact.points[1].constraints, 1u);
}

// Half of a tick's work is enough for neither end: they come out one after the other.
TEST(Wand, TwoEndsInBusyPlacesComeOutInTurns) {
    for (const int fine : {30, 36, 39}) {
        const double half = 0.0034, apart = 0.1;
        test::SurfaceBuilder b;
        for (const double at : {0.0, apart}) {  // seen from below
            const double s = 2.0 * half / fine;
            for (int j = 0; j < fine; ++j)
                for (int i = 0; i < fine; ++i) {
                    const double x = at - half + s * i, z = -half + s * j;
                    b.quad({x, 0.0, z}, {x + s, 0.0, z}, {x + s, 0.0, z + s}, {x, 0.0, z + s});
                }
        }
        const test::Surface surface = b.finish();
        WandHand hand{surface.get(), wand(0.005, 500.0)};
        hand.parameters.probe.points[0].offset_device_m = {0.0, 0.0001, 0.0};
        hand.parameters.probe.points[1].offset_device_m = {apart, 0.0001, 0.0};
        std::array<bool, 2> out{};
        for (int tick = 0; tick < 200; ++tick) {
            const TickRecord record = hand.at(Vec3(0.0));
            EXPECT_LE(cost_ns(record.contact.work), ProxyBudget{}.max_cost_ns) << fine;
            for (std::size_t i = 0; i < 2; ++i) {
                const PointRecord& point = record.contact.points[i];
                out[i] = out[i] || (point.constraints > 0 && point.proxy_object_m.y < -0.0045);
            }
        }
        EXPECT_TRUE(out[0] && out[1]) << fine << " squares a side: " << out[0] << ", " << out[1];
    }
}

TEST(Wand, AfterAGapInTheSamplesItIsNotTakenToHaveTurnedFast) {
    const test::Surface far_away = test::plane(0.05, 2, -5.0);
    WandHand hand{far_away.get(), wand(0.004, 500.0)};
    for (int i = 0; i < 20; ++i) hand.at(Vec3(0.0));
    hand.now_ns += 30 * kMs;  // ticks were lost, and the wand was turned by a fifth of a radian meanwhile
    EXPECT_EQ(hand.at(Vec3(0.0), Quat(std::cos(0.1), 0.0, 0.0, std::sin(0.1))).motion.angular_velocity_device_rad_per_s,
              Vec3(0.0));
}

TEST(Wand, ATurningEndIsDampedByItsOwnSpeed) {
    // Turned about z at w, the upper end goes to -x at w times 80 mm, against a wall that looks to +x.
    const double stiffness = 500.0, damping = 2.0, w = 1.0, radius = 0.004, wall_x = -0.02;
    const test::Surface wall = test::box({-0.2, 0.02, -0.2}, {wall_x, 0.3, 0.2}, 8);
    WandHand hand{wall.get(), wand(radius, stiffness)};
    hand.parameters.materials[0].damping_Ns_per_m = damping;
    hand.parameters.materials[0].static_friction = hand.parameters.materials[0].dynamic_friction = 0.0;
    hand.parameters.position_noise_m = 1e-9;
    TickRecord out;
    double angle = 0.0;
    for (int i = 0; i < 220; ++i) {
        angle = w * kDt * i;
        out = hand.at(Vec3(0.0), Quat(std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)));
    }
    const double depth = wall_x + radius - -0.08 * std::sin(angle), speed = 0.08 * w * std::cos(angle);
    ASSERT_GT(depth, 5e-4);
    // The estimate over 16 ticks is 8 ms late, a percent of the speed here; the wall is in float.
    EXPECT_NEAR(out.contact.points[0].force_device_N.x, stiffness * depth + damping * speed, 0.02 * damping * speed);
}

TEST(Wand, OnlyItsFirstEndCuts) {
    const test::Surface plane = test::plane(0.2, 40);
    WandHand hand{plane.get(), wand(0.005, 500.0)};
    hand.parameters.probe.points[0].offset_device_m = {0.03, 0.0, 0.0};
    hand.parameters.probe.points[1].offset_device_m = {-0.03, 0.0, 0.0};
    hand.parameters.action = ToolAction::cut;
    hand.parameters.tool = test::ball_tool(0.005);
    hand.parameters.materials[0].hardness_Ns_per_m3 = 1e7;
    hand.at({0.0, 0.01, 0.0});
    TickRecord out;
    for (int i = 0; i < 50; ++i) {
        devices::DeviceSample sample;
        hand.now_ns += kMs;
        sample.time_ns = hand.now_ns;
        sample.position_device_m = {0.0, 0.003, 0.0};
        sample.buttons = 1;
        const Tick t = tick(hand.state, sample, *plane, hand.parameters, hand.device, hand.now_ns, kDt);
        hand.state = t.next;
        out = t.record;
    }
    ASSERT_NE(out.flags & kTickCutting, 0u);
    EXPECT_NEAR(out.contact.cut_object_m.x, 0.03, 1e-3);
    // Where it has eaten its way in the wall has given way; the other end feels all of it.
    EXPECT_NEAR(out.contact.points[1].force_device_N.y, 500.0 * 0.002, 1e-3);
    EXPECT_LT(out.contact.points[0].force_device_N.y, 0.9 * out.contact.points[1].force_device_N.y);
}

}  // namespace burin::haptics

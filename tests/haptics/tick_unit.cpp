// SPDX-License-Identifier: MIT
#include "haptics/tick.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/geometry/touch_samples.hpp"
#include "tests/haptics/cutting_ball.hpp"
#include "tests/haptics/smooth_shapes.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

struct Ticker {
    const geometry::LocalSurface* surface;
    TickParameters parameters;
    TickState state{};
    Nanoseconds now_ns = 0;

    TickRecord at(const Vec3& position_device, devices::DeviceSample sample = {}) {
        now_ns += kMs;
        sample.time_ns = now_ns;
        sample.position_device_m = position_device;
        const Tick t = tick(state, sample, *surface, parameters, test::kStrongDevice, now_ns, kDt);
        state = t.next;
        return t.record;
    }
};

TickParameters parameters_for(double radius, double stiffness = 600.0, double damping = 0.0) {
    TickParameters p;
    p.probe.points[0].radius_m = radius;
    p.clearance_ratio = 0.0;
    p.limit_stiffness = false;
    p.passivity.control = false;  // the hand's jumps from tick to tick are no motion that it should judge
    p.materials[0].stiffness_N_per_m = stiffness;
    p.materials[0].damping_Ns_per_m = damping;
    p.max_surface_age_s = 0.0;
    return p;
}

Similarity tilted(double scale) {
    return {Vec3(0.01, -0.02, 0.005) * scale, glm::normalize(Quat(0.9, 0.2, -0.3, 0.1)), scale};
}

}  // namespace

TEST(Tick, FreeSpaceGivesExactlyZeroForce) {
    const test::Surface plane = test::plane();
    Ticker t{plane.get(), parameters_for(0.004, 600.0, 5.0)};
    for (int i = 0; i < 500; ++i) {
        const TickRecord out = t.at({0.02 * std::sin(0.05 * i), 0.0051 + 0.001 * std::cos(0.3 * i), 0.0});
        EXPECT_EQ(out.wanted.force_device_N, Vec3(0.0));
        EXPECT_EQ(out.flags & kTickInContact, 0u);
        EXPECT_EQ(out.contact.points[0].active_triangle, kNoTriangle);
    }
}

TEST(Tick, ForceIsStiffnessTimesPenetrationAlongTheNormal) {
    const test::Surface plane = test::plane();
    Ticker t{plane.get(), parameters_for(0.004)};
    t.at({0.001, 0.01, 0.002});
    for (int i = 0; i < 100; ++i) {
        const double depth = 1e-5 * i;
        const TickRecord out = t.at({0.001, 0.004 - depth, 0.002});
        EXPECT_NEAR(out.wanted.force_device_N.y, 600.0 * depth, 1e-6);
        EXPECT_NEAR(glm::length(Vec3(out.wanted.force_device_N.x, 0.0, out.wanted.force_device_N.z)), 0.0, 1e-6);
        EXPECT_NEAR(out.contact.points[0].penetration_m, depth, 1e-9);
    }
}

TEST(Tick, DampingActsInContactOnlyAgainstTheMotionAndNeverPulls) {
    const test::Surface plane = test::plane();
    Ticker t{plane.get(), parameters_for(0.004, 600.0, 2.0)};
    t.parameters.position_noise_m = 0.0;
    double y = 0.006;
    for (int i = 0; i < 60; ++i) {  // down at 0.1 m/s
        const TickRecord out = t.at({0.0, y -= 1e-4, 0.0});
        const double depth = 0.004 - y;
        if (depth > 1e-9) {
            EXPECT_NEAR(out.wanted.force_device_N.y, 600.0 * depth + 2.0 * 0.1, 1e-5);
        } else {
            EXPECT_EQ(out.wanted.force_device_N, Vec3(0.0));
        }
    }
    for (int i = 0; i < 60; ++i) {  // and up at 1 m/s: damping would outweigh the spring
        const TickRecord out = t.at({0.0, y += 1e-3, 0.0});
        EXPECT_GE(out.wanted.force_device_N.y, 0.0);
        if (i > 2 && 600.0 * (0.004 - y) < 2.0) {
            EXPECT_EQ(out.wanted.force_device_N.y, 0.0);
        }
    }
}

TEST(Tick, SlidingWithoutFrictionFeelsNoTangentialForce) {
    const test::Surface plane = test::plane(0.05, 30);
    Ticker t{plane.get(), parameters_for(0.004, 600.0, 5.0)};
    t.at({-0.02, 0.01, 0.0});
    for (int i = 0; i < 400; ++i) {
        const TickRecord out = t.at({-0.02 + 1e-4 * i, 0.003, 3e-5 * i});
        EXPECT_LT(std::hypot(out.wanted.force_device_N.x, out.wanted.force_device_N.z),
                  2e-3 * out.wanted.force_device_N.y)
            << i;
    }
}

TEST(Tick, PositionGainScalesMotionUpAndLeavesTheStiffnessFeltAsSet) {
    for (const double scale : {0.1, 1.0, 25.0}) {
        const test::Surface plane = test::plane(0.05 * scale, 10);
        Ticker t{plane.get(), parameters_for(0.004 * scale)};
        t.parameters.workspace.object_from_device = tilted(scale);
        const Similarity device_from_object = inverse(t.parameters.workspace.object_from_device);
        t.at(device_from_object * (Vec3(0.0, 0.01, 0.0) * scale));
        const TickRecord out = t.at(device_from_object * (Vec3(0.0, 0.003, 0.0) * scale));
        // 1 mm deep at the device, whatever the scale; up in the object, turned back into the device frame.
        const Vec3 up_device = glm::conjugate(t.parameters.workspace.object_from_device.orientation) * Vec3(0, 1, 0);
        EXPECT_LT(glm::length(out.wanted.force_device_N - 0.6 * up_device), 1e-5) << scale;
        EXPECT_NEAR(out.contact.points[0].penetration_m, 0.001 * scale, 1e-7 * scale);
    }
}

TEST(Tick, ANewMappingPutsTheProxyBackInsteadOfDraggingIt) {
    const test::Surface plane = test::plane();
    Ticker t{plane.get(), parameters_for(0.004)};
    t.at({0.0, 0.01, 0.0});
    const TickRecord pressed = t.at({0.0, 0.001, 0.0});
    EXPECT_NE(pressed.flags & kTickInContact, 0u);
    t.parameters.workspace.object_from_device.position_m = {0.0, 0.05, 0.0};  // the workspace jumps away
    const TickRecord out = t.at({0.0, 0.001, 0.0});
    EXPECT_NE(out.flags & kTickProxyReset, 0u);
    EXPECT_EQ(out.flags & kTickInContact, 0u);
    // What was pressed fades out, and is not drawn along.
    EXPECT_NEAR(out.wanted.force_device_N.y, (1.0 - kDt / kEase_s) * pressed.wanted.force_device_N.y, 1e-9);
    for (int i = 1; i < 50; ++i) static_cast<void>(t.at({0.0, 0.001, 0.0}));
    EXPECT_EQ(t.at({0.0, 0.001, 0.0}).wanted.force_device_N, Vec3(0.0));
}

TEST(Tick, SwitchedOffItTouchesNothing) {
    const test::Surface plane = test::plane();
    Ticker t{plane.get(), parameters_for(0.004)};
    t.parameters.enabled = false;
    t.at({0.0, 0.01, 0.0});
    const TickRecord out = t.at({0.0, -0.01, 0.0});
    EXPECT_EQ(out.wanted.force_device_N, Vec3(0.0));
    EXPECT_EQ(t.state.probe.proxies[0].position_object_m, out.contact.points[0].hip_object_m);
}

TEST(Tick, SaysWhenThereIsNoSurfaceOrItIsOldOrTheToolLeavesIt) {
    test::Surface plane = test::plane();
    Ticker t{plane.get(), parameters_for(0.004)};
    plane->sequence = 0;
    EXPECT_NE(t.at({0.0, 0.01, 0.0}).flags & kTickNoSurface, 0u);
    plane->sequence = 1;
    plane->radius_m = 0.02;
    EXPECT_EQ(t.at({0.0, 0.01, 0.0}).flags & kTickOutsideKnown, 0u);
    EXPECT_NE(t.at({0.0, 0.0161, 0.0}).flags & kTickOutsideKnown, 0u);  // the ball sticks out by 0.1 mm
    t.parameters.max_surface_age_s = 0.1;
    t.at({0.0, 0.01, 0.0});
    plane->made_ns = t.now_ns;
    EXPECT_EQ(t.at({0.0, 0.003, 0.0}).flags & kTickStaleSurface, 0u);
    t.now_ns += 101 * kMs;
    EXPECT_NE(t.at({0.0, 0.003, 0.0}).flags & kTickStaleSurface, 0u);
    EXPECT_EQ(t.at({0.0, 0.01, 0.0}).flags & kTickStaleSurface, 0u);  // free: its age does not matter
}

TEST(Tick, AScaleThatCannotBeFeltIsRefusedByName) {
    const test::Surface plane = test::plane();
    for (const double scale : {1e-9, 1e-7, 1e7}) {
        FullTickState state;
        TickParameters parameters = parameters_for(0.004);
        parameters.workspace.object_from_device.scale = scale;
        const FullTick full = full_tick(state, {.time_ns = kMs}, *plane, parameters, test::kStrongDevice, kMs, kDt);
        EXPECT_EQ(full.record.gate.cause, GateCause::bad_scale) << scale;
    }
    EXPECT_TRUE(is_felt_at(1e-3) && is_felt_at(1.0) && is_felt_at(1e3));
    EXPECT_NE(std::string(text(GateCause::bad_scale)).find("scale"), std::string::npos);
}

TEST(Tick, NonsenseInGivesZeroForceAndAFreshStart) {
    const test::Surface plane = test::plane();
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (const Vec3& bad : {Vec3(nan, 0, 0), Vec3(0, inf, 0), Vec3(0, 0, -inf)}) {
        Ticker t{plane.get(), parameters_for(0.004)};
        t.at({0.0, 0.01, 0.0});
        t.at({0.0, 0.001, 0.0});
        const TickRecord out = t.at(bad);
        EXPECT_FALSE(out.sample_finite);
        EXPECT_EQ(out.wanted.force_device_N, Vec3(0.0));
        const TickRecord next = t.at({0.0, 0.02, 0.0});
        EXPECT_TRUE(next.sample_finite);
        EXPECT_EQ(t.state.probe.proxies[0].position_object_m, Vec3(0.0, 0.02, 0.0));
    }
    Ticker t{plane.get(), parameters_for(0.004)};
    EXPECT_FALSE(t.at(Vec3(0.0), {.orientation_device = Quat(0, 0, 0, 0)}).sample_finite);
    const auto refused = [&](auto&& spoil) {
        Ticker bad{plane.get(), parameters_for(0.004)};
        spoil(bad.parameters);
        const TickRecord out = bad.at({0.0, 0.001, 0.0});
        return !out.parameters_sensible && out.wanted.force_device_N == Vec3(0.0);
    };
    EXPECT_TRUE(refused([&](TickParameters& p) { p.materials[0].stiffness_N_per_m = -1.0; }));
    EXPECT_TRUE(refused([&](TickParameters& p) { p.materials[0].stiffness_N_per_m = nan; }));
    EXPECT_TRUE(refused([&](TickParameters& p) { p.materials[0].damping_Ns_per_m = inf; }));
    EXPECT_TRUE(refused([&](TickParameters& p) { p.probe.points[0].radius_m = nan; }));
    EXPECT_TRUE(refused([&](TickParameters& p) { p.clearance_ratio = 1.0; }));
    EXPECT_TRUE(refused([&](TickParameters& p) { p.workspace.object_from_device.scale = 0.0; }));
    EXPECT_TRUE(refused([&](TickParameters& p) { p.workspace.object_from_device.orientation = Quat(2, 0, 0, 0); }));
    EXPECT_TRUE(refused([&](TickParameters& p) { p.workspace.object_from_device.position_m.z = nan; }));
}

TEST(Tick, ASurfaceOfAnUnknownMaterialGivesNoForceAndIsNotFeltAsAnother) {
    const auto felt_of = [](std::uint8_t material) {
        test::Surface cube = test::touchable(geometry::test::cube(20 * kMm));
        cube->meshes[0].material = material;
        Ticker t{cube.get(), parameters_for(4 * kMm)};
        (void)t.at({0.0, 30 * kMm, 0.0});
        TickRecord last;
        for (double y = 30 * kMm; y > 22 * kMm; y -= 0.5 * kMm) last = t.at({0.0, y, 0.0});
        return last;
    };
    const TickRecord known = felt_of(kMostMaterials - 1), unknown = felt_of(kMostMaterials);
    EXPECT_GT(known.wanted.force_device_N.y, 0.1);
    EXPECT_TRUE(known.parameters_sensible);
    EXPECT_EQ(unknown.wanted.force_device_N, Vec3(0.0));
    EXPECT_EQ(pass_gate({}, gate_input(unknown, test::kStrongDevice), {}, kDt).output.cause, GateCause::bad_parameters);
}

TEST(Tick, AGapInTheSamplesDoesNotLookLikeSpeed) {
    const test::Surface plane = test::plane();
    Ticker t{plane.get(), parameters_for(0.004)};
    for (int i = 0; i < 20; ++i) t.at({1e-4 * i, 0.01, 0.0});
    t.now_ns += 30 * kMs;  // thirty ticks lost while the hand went on
    EXPECT_LT(glm::length(t.at({50e-4, 0.01, 0.0}).motion.velocity_device_m_per_s), 1e-12);
    EXPECT_NEAR(t.at({51e-4, 0.01, 0.0}).motion.velocity_device_m_per_s.x, 0.1, 1e-9);
}

TEST(Tick, ThePointProbeFeelsAPlaneWithinItsSkin) {
    const test::Surface plane = test::plane(0.05, 50);  // 2 mm squares
    Ticker t{plane.get(), parameters_for(0.0)};
    t.at({0.0, 0.01, 0.0});
    const TickRecord out = t.at({0.0003, -0.001, 0.0001});
    EXPECT_NEAR(out.wanted.force_device_N.y, 0.6, 600.0 * 0.0028 / 500);
}

TEST(Tick, ACutThatWasInterruptedBeginsAnewWhereTheToolIs) {
    const test::Surface plane = test::plane(0.05, 40);
    Ticker t{plane.get(), parameters_for(0.004)};
    t.parameters.action = ToolAction::cut;
    t.parameters.tool = test::ball_tool(0.004);
    t.parameters.materials[0].hardness_Ns_per_m3 = 1e7;
    devices::DeviceSample pressed;
    pressed.buttons = 1;
    t.at({0.0, 0.01, 0.0}, pressed);
    for (int i = 0; i < 50; ++i) t.at({0.0, 0.002, 0.0}, pressed);
    t.parameters.enabled = false;
    t.at({0.02, 0.0035, 0.0}, pressed);
    t.parameters.enabled = true;
    const TickRecord out = t.at({0.02, 0.0035, 0.0}, pressed);
    ASSERT_NE(out.flags & kTickCutting, 0u);
    EXPECT_NEAR(out.contact.cut_object_m.x, 0.02, 1e-5) << "it is drawn back to where it cut before";
    // Samples of the ball are not quite symmetrical.
    EXPECT_NEAR(out.wanted.force_device_N.x, 0.0, 0.01);
}

TEST(Tick, AContactThatIsPushedFartherThanTheHandCouldFollowIsToldAsAJumpAtAnyGain) {
    for (const double gain : {0.1, 1.0, 10.0})
        for (const double rise_device_m : {0.0002, 0.002}) {  // the surface grows by a fifth of a millimetre, or by two
            const test::Surface before = test::plane(0.05 * gain, 10),
                                after = test::plane(0.05 * gain, 10, rise_device_m * gain);
            TickParameters p = parameters_for(0.0);
            p.workspace.object_from_device.scale = gain;
            p.shading = false;
            Ticker t{before.get(), p};
            t.at({0.0, 0.005, 0.0});
            EXPECT_FALSE(t.at({0.0, -0.001, 0.0}).contact.jumped);
            after->sequence = 2;
            t.surface = after.get();
            const TickRecord out = t.at({0.0, -0.001, 0.0});
            EXPECT_NE(out.flags & kTickPushedOut, 0u);
            EXPECT_EQ(out.contact.jumped, rise_device_m > 0.0005) << gain << ' ' << rise_device_m;
        }
}

TEST(Tick, AForceFilterMakesTheWallSofterWhereTheDeviceCannotTakeBackWhatItsLagGivesOut) {
    devices::DeviceDescription device = test::kStrongDevice;
    device.friction_N = 0.1;
    device.damping_Ns_per_m = 0.5;
    device.resolution_m = 5e-5;
    const test::Surface plane = test::plane();
    const auto felt_stiffness = [&](double alpha) {
        TickParameters p = parameters_for(0.004, 5000.0);
        p.limit_stiffness = true;
        p.signals.force_alpha = alpha;
        TickState state;
        TickRecord out;
        for (int i = 0; i < 400; ++i) {
            devices::DeviceSample sample;
            sample.time_ns = (i + 1) * kMs;
            sample.position_device_m = {0.0, i == 0 ? 0.01 : 0.003, 0.0};
            const Tick t = tick(state, sample, *plane, p, device, sample.time_ns, kDt);
            state = t.next;
            out = t.record;
        }
        EXPECT_NE(out.contact.stiffness_bound, StiffnessBound::none);
        return out.wanted.force_device_N.y / 0.001;
    };
    // As the limiter says of the same demand, filter and all.
    for (const double alpha : {0.0, 0.9}) {
        ContactDemand demand;
        demand.stiffness_N_per_m = 5000.0;
        demand.filter_lag_s = kDt * alpha / (1.0 - alpha);
        demand.period_s = kDt;
        EXPECT_NEAR(felt_stiffness(alpha), limited(demand, device).stiffness_N_per_m, 1.0) << alpha;
    }
    EXPECT_LT(felt_stiffness(0.9), 0.6 * felt_stiffness(0.0));
}

TEST(Tick, RefusesFrictionThatSlidesHarderThanItSticksACurveOfOnePointAndAFilterThatNeverAnswers) {
    EXPECT_TRUE(parameters_are_sensible({}));
    const auto refused = [](const auto& spoil) {
        TickParameters p;
        spoil(p);
        return !parameters_are_sensible(p);
    };
    EXPECT_TRUE(refused([](TickParameters& p) {
        p.materials[1].static_friction = 0.2;
        p.materials[1].dynamic_friction = 0.3;
    }));
    EXPECT_TRUE(refused([](TickParameters& p) { p.curve.count = 1; }));
    EXPECT_TRUE(refused([](TickParameters& p) { p.curve.count = kMostCurvePoints + 1; }));
    EXPECT_TRUE(refused([](TickParameters& p) { p.signals.force_alpha = 1.0; }));
    EXPECT_TRUE(refused([](TickParameters& p) { p.signals.velocity_alpha = 1.0; }));
    EXPECT_TRUE(refused([](TickParameters& p) { p.weight.down_device = {0.0, -2.0, 0.0}; }));
    EXPECT_TRUE(refused([](TickParameters& p) { p.clearance_ratio = 1.0; }));
    EXPECT_TRUE(refused([](TickParameters& p) { p.probe.count = 0; }));
}

}  // namespace burin::haptics

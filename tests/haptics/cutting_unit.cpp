// SPDX-License-Identifier: MIT
#include "haptics/forces/cutting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/haptics/pressed_ball.hpp"

namespace burin::haptics {
namespace {

constexpr double kDt = 1e-3;
using test::ball, test::flat, test::kPlenty, test::kRadius_m, test::kStiffness, test::pressing;

TouchMaterial material_of(double hardness_Ns_per_m3, double yield_Pa = 0.0) {
    TouchMaterial material;
    material.hardness_Ns_per_m3 = hardness_Ns_per_m3;
    material.cutting_yield_Pa = yield_Pa;
    return material;
}

Vec3 force_on_hand_N(const CuttingInput& in, const CuttingStep& step) {
    return kStiffness / in.scale * (step.bearing_object_m - in.hip_object_m);
}

double depth_of(const CuttingStep& step) { return kRadius_m - step.bearing_object_m.y; }

// One tick of the ball on the surface as it was before the tool cut.
CuttingStep tick(CuttingState& state, const CuttingInput& in, const TouchMaterial& material,
                 const ToolSurface& tool = ball(), const geometry::LocalSurface& surface = flat()) {
    state.known = look_at(state, in, tool, surface, kPlenty).known;
    CuttingStep step = cut(state, in, tool, material);
    state = step.next;
    return step;
}

CuttingStep after(double time_s, const CuttingInput& in, const TouchMaterial& material) {
    CuttingState state;
    CuttingStep step;
    for (int i = 0; i < std::lround(time_s / in.dt_s); ++i) step = tick(state, in, material);
    return step;
}

// The time that a hand held at depth x needs to bring the tool from the surface to depth s <= R: the integral of
// A_nn(y) / (k (x - y) - p0 A(y)) dy, times H; by Simpson's rule.
double time_to_depth_s(double s, double x, double hardness, double yield_Pa) {
    const auto integrand = [&](double y) {
        const test::EngagedAreas areas = test::engaged_areas(kRadius_m, y);
        return areas.into_m2 / (kStiffness * (x - y) - yield_Pa * areas.section_m2);
    };
    const int n = 2000;
    double sum = integrand(0.0) + integrand(s);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * integrand(s * i / n);
    return hardness * sum * s / (3.0 * n);
}

}  // namespace

TEST(ToolSurface, TheAreasOfItsSamplesAddUpAndTheirNormalsPointOutward) {
    Vec3 sum(0.0);
    double area_m2 = 0.0, into_m2 = 0.0;
    EXPECT_EQ(ball().count, ToolSurface::kMost);
    for (std::uint32_t i = 0; i < ball().count; ++i) {
        const ToolSample& s = ball().samples[i];
        EXPECT_GT(glm::dot(glm::normalize(s.position_m), s.normal), 0.99f);
        sum += Vec3(s.area_m2 * s.normal);
        area_m2 += static_cast<double>(s.area_m2);
        into_m2 += static_cast<double>(s.area_m2 * s.normal.y * s.normal.y);
    }
    const double sphere_m2 = 4.0 * std::numbers::pi * kRadius_m * kRadius_m;
    EXPECT_NEAR(area_m2, sphere_m2, 0.005 * sphere_m2);
    EXPECT_NEAR(into_m2, sphere_m2 / 3.0, 0.01 * sphere_m2);
    EXPECT_LT(glm::length(sum), 0.005 * sphere_m2);
}

TEST(ToolSurface, ItsTableFindsTheSampleNearestToAPlaceAndNoneFarAway) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(-1.0f, 1.0f);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f place =
            static_cast<float>(1.2 * kRadius_m) * glm::normalize(Vec3f(any(random), any(random), any(random)));
        const std::uint8_t found = ball().nearest(place);
        ASSERT_LT(found, ball().count);
        EXPECT_GT(glm::dot(glm::normalize(ball().samples[found].position_m), glm::normalize(place)), 0.9f);
    }
    EXPECT_EQ(ball().nearest(Vec3f(static_cast<float>(2.0 * kRadius_m), 0.0f, 0.0f)), ToolSurface::kNone);
    EXPECT_EQ(ball().nearest(Vec3f(std::numeric_limits<float>::quiet_NaN())), ToolSurface::kNone);
    EXPECT_EQ(toolbox::tool_surface({}, 1.0).count, 0u);
}

TEST(Cutting, AtASteadyPressTheToolCutsAtYieldAndHardnessTimesItsSection) {
    const double hardness = 2e6, yield_Pa = 1e4, speed = 0.01;
    for (const double scale : {0.1, 1.0, 40.0}) {
        const ToolSurface tool = test::ball_tool(kRadius_m * scale);
        const test::Surface plane = test::plane(0.05 * scale, 200);
        CuttingState state;
        CuttingStep step;
        CuttingInput in;
        double depth = 0.0;
        for (int i = 0; i < 200; ++i) {
            depth += speed * kDt;
            in = pressing(depth * scale);
            in.proxy_object_m = {0.0, kRadius_m * scale, 0.0};
            in.hip_object_m = in.proxy_object_m - Vec3(0.0, depth * scale, 0.0);
            in.scale = scale;
            step = tick(state, in, material_of(hardness, yield_Pa), tool, *plane);
        }
        const double cut_m = (in.proxy_object_m.y - step.bearing_object_m.y) / scale;
        const test::EngagedAreas areas = test::engaged_areas(kRadius_m, cut_m);
        const double expected = hardness * areas.into_m2 * step.cut_speed_m_per_s + yield_Pa * areas.section_m2;
        EXPECT_NEAR(force_on_hand_N(in, step).y, expected, 0.04 * expected) << scale << ' ' << cut_m;
        EXPECT_GT(cut_m, 0.3 * kRadius_m);
    }
}

TEST(Cutting, PressedLightlyTheToolHoldsStillAndBeyondTheYieldItSinksToWhereTheMaterialBearsIt) {
    const double yield_Pa = 5e4;
    for (const double x : {0.0002, 0.0005, 0.001, 0.002}) {
        const CuttingStep step = after(1.0, pressing(x), material_of(1e5, yield_Pa));
        // Where it comes to rest the material bears the press.
        const double force_N = force_on_hand_N(pressing(x), step).y, depth = depth_of(step);
        const double bears_N = yield_Pa * test::engaged_areas(kRadius_m, depth).section_m2;
        EXPECT_NEAR(force_N, bears_N, (depth < 0.05 * kRadius_m ? 0.15 : 0.04) * bears_N) << x << ' ' << depth;
    }
    // A tool that lies in its bed and is pressed with half the yield stays where it is, for ten seconds.
    CuttingState state;
    CuttingStep step;
    for (int i = 0; i < 500; ++i) step = tick(state, pressing(0.002), material_of(1e5, yield_Pa));
    const double depth = depth_of(step);
    const double half_m = depth + 0.5 * force_on_hand_N(pressing(0.002), step).y / kStiffness;
    for (int i = 0; i < 10'000; ++i) step = tick(state, pressing(half_m), material_of(1e5, yield_Pa));
    EXPECT_NEAR(depth_of(step), depth, 1e-6);
    EXPECT_GT(force_on_hand_N(pressing(half_m), step).y, 0.1);
}

TEST(Cutting, AHeldHandSinksInAsTheGrowingCapLetsIt) {
    const double hardness = 2e7, x = 0.002;
    for (const double yield_Pa : {0.0, 2e4})
        for (const double time_s : {0.05, 0.2, 0.6}) {
            const double depth = depth_of(after(time_s, pressing(x), material_of(hardness, yield_Pa)));
            EXPECT_GT(depth, 0.0002);
            EXPECT_LT(depth, x);
            EXPECT_NEAR(time_to_depth_s(depth, x, hardness, yield_Pa), time_s, 0.08 * time_s)
                << depth << ' ' << yield_Pa;
        }
}

TEST(Cutting, DrawnAlongItsOwnGrooveItIsLiftedAndHeldBackByWhatLiesAhead) {
    // A groove whose end is the ball's bed: what lies ahead is a quarter of a sphere up to the depth.
    const double hardness = 4e6, speed = 0.03, depth = 0.001;
    const test::Surface bed = test::height_field(0.02, 400, [&](double x, double z) {
        const double along = std::max(x, 0.0), r2 = kRadius_m * kRadius_m - along * along - z * z;
        return r2 > 0.0 ? std::min(0.0, kRadius_m - depth - std::sqrt(r2)) : 0.0;
    });
    CuttingState state;
    CuttingInput in = pressing(0.0);
    in.proxy_object_m = in.hip_object_m = {0.0, kRadius_m - depth, 0.0};
    state.known = look_at(state, in, ball(), *bed, kPlenty).known;
    // The tool is driven so that it goes straight on at this speed.
    const test::EngagedAreas areas = test::engaged_areas(kRadius_m, depth);
    const Vec3 force_N = hardness * speed * Vec3(areas.across_m2, -areas.lift_m2, 0.0);
    state.engaged = true;
    state.point_object_m = in.proxy_object_m;
    in.slack_m = 1.0;
    in.hip_object_m += force_N / kStiffness + Vec3(speed * kDt, 0.0, 0.0);
    const CuttingStep step = cut(state, in, ball(), material_of(hardness));
    const Vec3 went = (step.bearing_object_m - in.proxy_object_m) / kDt;
    EXPECT_NEAR(went.x, speed, 0.12 * speed);
    EXPECT_NEAR(went.y, 0.0, 0.12 * speed);
    EXPECT_NEAR(went.z, 0.0, 0.02 * speed);  // its samples lie unevenly
}

TEST(Cutting, HarderMaterialIsCutLessAndMoreForceCutsDeeper) {
    double last = 1.0;
    for (const double hardness : {1e5, 1e6, 1e7, 1e8, 1e9}) {
        const double depth = depth_of(after(0.2, pressing(0.002), material_of(hardness)));
        EXPECT_LT(depth, last);
        last = depth;
    }
    last = 0.0;
    for (const double x : {0.0005, 0.001, 0.002, 0.003}) {
        const double depth = depth_of(after(0.2, pressing(x), material_of(2e7)));
        EXPECT_GT(depth, last);
        last = depth;
    }
}

TEST(Cutting, WhatHasNoHardnessGivesWayAndWhatIsInfinitelyHardDoesNot) {
    const CuttingInput in = pressing(0.002);
    CuttingState fresh;
    const CuttingStep air = tick(fresh, in, material_of(0.0));
    EXPECT_LT(glm::length(air.bearing_object_m - in.hip_object_m), 1e-12);
    EXPECT_TRUE(air.next.engaged);
    const CuttingStep diamond = cut({}, in, ball(), material_of(std::numeric_limits<double>::infinity()));
    EXPECT_EQ(diamond.bearing_object_m, in.proxy_object_m);
    EXPECT_FALSE(diamond.next.engaged);
    // The limits are approached from both sides, at any period.
    for (const double dt_s : {1e-6, 1e-3, 1.0, 1e3}) {
        EXPECT_NEAR(depth_of(after(dt_s, pressing(0.002, dt_s), material_of(1e-6))), 0.002, 1e-9);
        EXPECT_NEAR(depth_of(after(dt_s, pressing(0.002, dt_s), material_of(1e18))), 0.0, 2e-5) << dt_s;
        EXPECT_NEAR(depth_of(after(dt_s, pressing(0.002, dt_s), material_of(1.0, 1e12))), 0.0, 2e-5) << dt_s;
    }
    CuttingInput idle = in;
    idle.cutting = false;
    EXPECT_EQ(cut({}, idle, ball(), material_of(1e6)).bearing_object_m, in.proxy_object_m);
}

TEST(Cutting, AFreshSurfaceDoesNotMoveTheToolNorTheForce) {
    const TouchMaterial material = material_of(2e7, 1e4);
    CuttingState state;
    CuttingInput in = pressing(0.002);
    CuttingStep before;
    for (int i = 0; i < 200; ++i) before = tick(state, in, material);
    // The cut has arrived: a bed of the ball's shape, and the proxy lies where the tool is, and deeper by the
    // clearance.
    const double depth = depth_of(before);
    const test::Surface bed = test::height_field(0.02, 400, [&](double x, double z) {
        const double r2 = kRadius_m * kRadius_m - x * x - z * z;
        return r2 > 0.0 ? std::min(0.0, kRadius_m - depth - std::sqrt(r2)) : 0.0;
    });
    bed->sequence = 2;
    for (const double clearance_m : {0.0, 3e-5, 6e-5}) {
        CuttingState next = state;
        in.proxy_object_m = before.bearing_object_m - Vec3(0.0, clearance_m, 0.0);
        in.slack_m = 6e-5;
        const CuttingStep step = tick(next, in, material, ball(), *bed);
        const double change_N = glm::length(force_on_hand_N(in, step) - force_on_hand_N(in, before));
        EXPECT_LT(change_N, 0.01) << clearance_m;  // one more step of cutting
    }
}

TEST(Cutting, TheToolNeverGoesBeyondTheHandNorStaysBehindTheProxy) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int run = 0; run < 30; ++run) {
        CuttingState state;
        Vec3 hip(0.0, kRadius_m, 0.0);
        const TouchMaterial material = material_of(std::pow(10.0, 7.0 + 3.0 * any(random)), 1e4 * (1.0 + any(random)));
        for (int i = 0; i < 400; ++i) {
            hip += 2e-4 * Vec3(any(random), any(random) - 0.1, any(random));
            hip.y = std::min(hip.y, kRadius_m - 1e-9);
            CuttingInput in = pressing(0.0);
            in.hip_object_m = hip;
            in.proxy_object_m = {hip.x, kRadius_m, hip.z};
            in.slack_m = 5e-5;
            const CuttingStep step = tick(state, in, material);
            const double lag_m = glm::length(step.bearing_object_m - hip);
            EXPECT_LE(lag_m, glm::length(in.proxy_object_m - hip) + in.slack_m + 1e-12);
        }
    }
}

TEST(Cutting, TakesEnergyAndGivesNoneBack) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int run = 0; run < 40; ++run) {
        CuttingState state;
        constexpr double kDeepAtFirst_m = 1e-6;
        Vec3 hip(0.0, kRadius_m - kDeepAtFirst_m, 0.0), velocity(0.0);
        double taken_J = 0.5 * kStiffness * kDeepAtFirst_m * kDeepAtFirst_m;  // the spring's at first
        const double hardness = std::pow(10.0, 7.0 + 3.0 * any(random)), yield = 1e4 * (1.0 + any(random));
        const TouchMaterial material = material_of(hardness, yield);
        for (int i = 0; i < 500; ++i) {
            const double x = any(random), y = any(random), z = any(random);  // in this order with every compiler
            velocity += 0.02 * Vec3(x, y, z);
            const Vec3 from = hip;
            hip += velocity * kDt;
            if (hip.y >= kRadius_m) hip.y = kRadius_m - 1e-6, velocity.y = 0.0;
            const Vec3 motion = hip - from;
            CuttingInput in = pressing(0.0);
            in.hip_object_m = hip;
            in.proxy_object_m = {hip.x, kRadius_m, hip.z};
            const CuttingStep step = tick(state, in, material);
            // A convex spring's work is never less than its energy gained when counted with the force at the end.
            taken_J -= glm::dot(force_on_hand_N(in, step), motion);
            const double stored_J =
                0.5 * kStiffness * glm::dot(step.bearing_object_m - hip, step.bearing_object_m - hip);
            EXPECT_GE(taken_J, stored_J - 1e-9) << run << ' ' << i;
        }
    }
}

TEST(Cutting, TheSearchForAStepComesToItsEnd) {
    // The step is the least of its function: no other way nearby is resisted less.
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::uint32_t most = 0;
    for (int run = 0; run < 300; ++run) {
        const TouchMaterial material = material_of(std::pow(10.0, 6.0 + 3.0 * any(random)), 3e4 * (1.0 + any(random)));
        CuttingState state;
        CuttingInput in = pressing(0.0008 * (1.0 + any(random)));
        in.hip_object_m += 0.001 * Vec3(any(random), 0.0, any(random));
        (void)tick(state, in, material);
        in.hip_object_m += 0.0003 * Vec3(any(random), any(random), any(random));
        const CuttingStep step = tick(state, in, material);
        most = std::max(most, step.terms);
        // Balance: what the spring pulls with is what the elements resist with, so the same step is found from rest.
        CuttingState from_rest = state;
        from_rest.step_object_m = Vec3(0.0);
        from_rest.point_object_m = step.bearing_object_m - step.next.step_object_m;
        const CuttingStep again = cut(from_rest, in, ball(), material);
        EXPECT_LT(glm::length(again.bearing_object_m - step.bearing_object_m), 1e-7) << run;
    }
    EXPECT_LT(most, 30'000u);
}

TEST(Cutting, ATurningToolIsHeldBackByWhatItTurnsInto) {
    // A beam lies flat on the plane and is turned about its middle, one half into the material and one out of it.
    geometry::TriangleMesh beam;
    const Vec3 half(0.01, 0.002, 0.002);
    for (int i = 0; i < 8; ++i)
        beam.positions_m.push_back(
            {(i & 1) ? half.x : -half.x, (i & 2) ? half.y : -half.y, (i & 4) ? half.z : -half.z});
    for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                     {4, 5, 7, 6},
                                     {0, 1, 5, 4},
                                     {2, 6, 7, 3},
                                     {0, 4, 6, 2},
                                     {1, 3, 7, 5}})
        for (std::uint32_t i = 0; i < 12; ++i)
            for (std::uint32_t j = 0; j < 12; ++j) {
                const auto at = [&](double u, double v) {
                    const Vec3 A = beam.positions_m[a], B = beam.positions_m[b], D = beam.positions_m[d];
                    beam.positions_m.push_back(A + (B - A) * u / 12.0 + (D - A) * v / 12.0);
                    return static_cast<std::uint32_t>(beam.positions_m.size() - 1);
                };
                (void)c;
                const std::uint32_t p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
                beam.triangles.push_back({p, q, r});
                beam.triangles.push_back({p, r, s});
            }
    const ToolSurface tool = toolbox::tool_surface(beam, half.y);
    const TouchMaterial material = material_of(2e6, 1e4);
    CuttingState state;
    CuttingInput in = pressing(0.0);
    in.proxy_object_m = {0.0, half.y, 0.0};
    in.hip_object_m = {0.0, half.y - 0.0005, 0.0};
    for (int i = 0; i < 20; ++i) (void)tick(state, in, material, tool);
    const double angle = 0.002;  // in a tick
    in.orientation_object = glm::angleAxis(angle, Vec3(0.0, 0.0, 1.0));
    const CuttingStep step = tick(state, in, material, tool);
    // Turning about +z lowers the half at -x; the material pushes it back up, which is a torque about -z.
    EXPECT_LT(step.torque_device_Nm.z, -1e-3);
    EXPECT_LT(std::abs(step.torque_device_Nm.x), 0.1 * std::abs(step.torque_device_Nm.z));
}

TEST(Cutting, GrainMakesTheForceSwellAndFallWithThePlace) {
    TouchMaterial material = material_of(2e6, 2e4);
    material.grain_share = 0.3;
    material.grain_spacing_m = 0.002;
    const auto force_at = [&](double x) {
        CuttingState state;
        CuttingInput in = pressing(0.0);
        CuttingStep step;
        for (int i = 0; i < 100; ++i) {
            in = pressing(2e-5 * i);
            in.proxy_object_m.x = in.hip_object_m.x = x;
            step = tick(state, in, material);
        }
        return force_on_hand_N(in, step).y;
    };
    const double peak = force_at(0.0), trough = force_at(0.001);
    EXPECT_GT(peak, 1.2 * trough);
    EXPECT_NEAR(force_at(0.002), peak, 0.01 * peak);
}

TEST(Cutting, DragIsViscousOverTheEngagedArea) {
    TouchMaterial material = material_of(1e7);
    material.cutting_drag_Ns_per_m3 = 2e4;
    CuttingState state;
    CuttingInput in = pressing(0.001);
    in.velocity_device_m_per_s = {0.1, 0.0, -0.05};
    CuttingStep step;
    for (int i = 0; i < 200; ++i) step = tick(state, in, material);
    EXPECT_GT(step.engaged_area_m2, 5e-6);
    EXPECT_LT(glm::length(step.drag_device_N + 2e4 * step.engaged_area_m2 * in.velocity_device_m_per_s), 1e-15);
    in.cutting = false;
    EXPECT_EQ(cut(state, in, ball(), material).drag_device_N, Vec3(0.0));
}

}  // namespace burin::haptics

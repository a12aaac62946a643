// SPDX-License-Identifier: MIT
#include "haptics/forces/cutting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

constexpr double kCutterRadius_m = 0.003;
constexpr double kStiffness = 600.0;
const Vec3 kDown(0.0, -1.0, 0.0);

TouchMaterial of_hardness(double hardness_Ns_per_m3) {
    TouchMaterial material;
    material.hardness_Ns_per_m3 = hardness_Ns_per_m3;
    return material;
}

// A hand at this height that presses on a plane at height 0 (of the ball's centre), material below.
CuttingInput pressing(double hip_y_m, double dt_s = kDt) {
    CuttingInput in;
    in.hip_object_m = {0.0, hip_y_m, 0.0};
    in.normal_object = -kDown;
    in.tool_radius_m = kCutterRadius_m;
    in.cutting = true;
    in.stiffness_N_per_m = kStiffness;
    in.dt_s = dt_s;
    return in;
}

Vec3 force_on_hand_N(const CuttingInput& in, const CuttingStep& step) {
    return kStiffness / in.scale * (step.bearing_object_m - in.hip_object_m);
}

// The time that a hand held at depth x needs to bring the tool from the surface to depth s <= R: the integral of
// A(y) / (x - y) dy, times H / k, with A(y) = 2 pi (R y - y^2 + y^3 / (3 R)); by Simpson's rule.
double time_to_depth_s(double s, double x, double hardness) {
    const double R = kCutterRadius_m;
    const auto integrand = [&](double y) {
        return 2.0 * std::numbers::pi * (R * y - y * y + y * y * y / (3.0 * R)) / (x - y);
    };
    const int n = 2000;
    double sum = integrand(0.0) + integrand(s);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * integrand(s * i / n);
    return hardness / kStiffness * sum * s / (3.0 * n);
}

double depth_after(double time_s, double x, double hardness, double dt_s) {
    CuttingState state;
    CuttingStep step;
    for (int i = 0; i < std::lround(time_s / dt_s); ++i) {
        step = cut(state, pressing(-x, dt_s), of_hardness(hardness));
        state = step.next;
    }
    return -step.bearing_object_m.y;
}

}  // namespace

TEST(Cutting, EngagedAreasAreIntegralsOverTheCap) {
    EXPECT_EQ(engaged_areas(kCutterRadius_m, 0.0).into_m2, 0.0);
    EXPECT_EQ(engaged_areas(0.0, 0.001).into_m2, 0.0);
    for (const double depth : {0.0001, 0.0005, 0.0015, 0.003}) {
        double into = 0.0, across = 0.0, lift = 0.0;
        const int rings = 400, steps = 400;
        const double theta = std::acos((kCutterRadius_m - depth) / kCutterRadius_m);
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < steps; ++j) {
                const double phi = theta * (i + 0.5) / rings, alpha = 2.0 * std::numbers::pi * (j + 0.5) / steps;
                const double element =
                    kCutterRadius_m * kCutterRadius_m * std::sin(phi) * theta / rings * 2.0 * std::numbers::pi / steps;
                const double m_n = std::cos(phi), m_t = std::sin(phi) * std::cos(alpha);
                into += m_n * m_n * element;
                if (m_t > 0.0) across += m_t * m_t * element, lift += m_n * m_t * element;
            }
        const EngagedAreas areas = engaged_areas(kCutterRadius_m, depth);
        EXPECT_NEAR(areas.into_m2, into, 1e-4 * into) << depth;
        EXPECT_NEAR(areas.across_m2, across, 1e-4 * across) << depth;
        EXPECT_NEAR(areas.lift_m2, lift, 1e-4 * lift) << depth;
    }
    EXPECT_EQ(engaged_areas(kCutterRadius_m, 1.0).into_m2, engaged_areas(kCutterRadius_m, kCutterRadius_m).into_m2);
}

TEST(Cutting, AtASteadyPressTheToolCutsAtForceOverHardnessTimesArea) {
    const double hardness = 2e6, speed = 0.01;  // device m/s; it settles with H A / k = 0.1 s
    for (const double scale : {0.1, 1.0, 40.0}) {
        CuttingState state;
        double y = 0.0;
        CuttingStep step;
        CuttingInput in;
        for (int i = 0; i < 4000; ++i) {
            y -= speed * kDt * scale;
            in = pressing(y);
            in.scale = scale;
            in.tool_radius_m = kCutterRadius_m * scale;
            step = cut(state, in, of_hardness(hardness));
            state = step.next;
        }
        const double area_m2 =
            2.0 / 3.0 * std::numbers::pi * kCutterRadius_m * kCutterRadius_m;  // deeper than the radius by now
        EXPECT_NEAR(step.engaged_area_m2, area_m2, 1e-12) << scale;
        EXPECT_NEAR(step.cut_speed_m_per_s, speed, 1e-9) << scale;
        EXPECT_NEAR(force_on_hand_N(in, step).y, hardness * area_m2 * speed, 1e-7) << scale;
    }
}

TEST(Cutting, DrawnAlongItRunsAtTheDepthWhereTheLiftBearsThePress) {
    const double hardness = 4e6, speed = 0.03;
    double last_depth = 0.0;
    for (const double press_N : {0.1, 0.2, 0.4}) {
        // Along a plane that is uncut ahead; the proxy lies as deep as the tool, and the surface shows it.
        CuttingState state;
        double x = 0.0;
        CuttingStep step;
        CuttingInput in;
        for (int i = 0; i < 4000; ++i) {
            x += speed * kDt;
            in = pressing(0.0);
            const double c_y = state.engaged ? state.point_object_m.y : 0.0;
            in.hip_object_m = {x, c_y - press_N / kStiffness, 0.0};
            in.proxy_object_m = {state.engaged ? state.point_object_m.x : 0.0, c_y, 0.0};
            state.known = {-c_y, kDown};
            step = cut(state, in, of_hardness(hardness));
            state = step.next;
        }
        const EngagedAreas areas = engaged_areas(kCutterRadius_m, step.engaged_depth_m);
        EXPECT_NEAR(hardness * areas.lift_m2 * speed, press_N, 0.001 * press_N);
        EXPECT_NEAR(-force_on_hand_N(in, step).x, hardness * areas.across_m2 * speed, 1e-3 * press_N);
        EXPECT_GT(step.engaged_depth_m, last_depth);
        last_depth = step.engaged_depth_m;
    }
    EXPECT_LT(last_depth, kCutterRadius_m);
}

TEST(Cutting, AHeldHandSinksInAsTheGrowingCapLetsIt) {
    const double hardness = 2e7, x = 0.002;
    for (const double time_s : {0.05, 0.2, 0.6}) {
        const double depth = depth_after(time_s, x, hardness, 1e-4);
        EXPECT_GT(depth, 0.0002);
        EXPECT_LT(depth, x);
        EXPECT_NEAR(time_to_depth_s(depth, x, hardness), time_s, 0.005 * time_s + 2e-4) << depth;
    }
}

TEST(Cutting, HalvingThePeriodHalvesTheError) {
    const double hardness = 2e7, x = 0.002, time_s = 0.2;
    const double fine = depth_after(time_s, x, hardness, 1e-5);
    const double coarse_error = std::abs(depth_after(time_s, x, hardness, 2e-3) - fine);
    const double half_error = std::abs(depth_after(time_s, x, hardness, 1e-3) - fine);
    EXPECT_LT(coarse_error, 0.02 * fine);
    EXPECT_NEAR(half_error / coarse_error, 0.5, 0.1);
}

TEST(Cutting, HarderMaterialIsCutLessAndMoreForceCutsDeeper) {
    double last = 1.0;
    for (const double hardness : {1e5, 1e6, 1e7, 1e8, 1e9}) {
        const double depth = depth_after(0.2, 0.002, hardness, kDt);
        EXPECT_LT(depth, last);
        last = depth;
    }
    last = 0.0;
    for (const double x : {0.0005, 0.001, 0.002, 0.003}) {
        const double depth = depth_after(0.2, x, 2e7, kDt);
        EXPECT_GT(depth, last);
        last = depth;
    }
}

TEST(Cutting, WhatHasNoHardnessGivesWayAndWhatIsInfinitelyHardDoesNot) {
    const CuttingInput in = pressing(-0.002);
    const CuttingStep air = cut({}, in, of_hardness(0.0));
    EXPECT_EQ(air.bearing_object_m, in.hip_object_m);
    EXPECT_TRUE(air.next.engaged);
    const CuttingStep diamond = cut({}, in, of_hardness(std::numeric_limits<double>::infinity()));
    EXPECT_EQ(diamond.bearing_object_m, in.proxy_object_m);
    EXPECT_FALSE(diamond.next.engaged);
    // The limits are approached from both sides, at any period.
    for (const double dt_s : {1e-6, 1e-3, 1.0, 1e3}) {
        EXPECT_NEAR(cut({}, pressing(-0.002, dt_s), of_hardness(1e-6)).bearing_object_m.y, -0.002, 1e-9);
        EXPECT_NEAR(cut({}, pressing(-0.002, dt_s), of_hardness(1e18)).bearing_object_m.y, 0.0, 1e-6);
    }
    CuttingInput idle = in;
    idle.cutting = false;
    EXPECT_EQ(cut({}, idle, of_hardness(1e6)).bearing_object_m, in.proxy_object_m);
}

TEST(Cutting, AFreshSurfaceDoesNotMoveTheToolNorTheForce) {
    const double hardness = 2e7;
    CuttingState state;
    CuttingInput in = pressing(-0.002);
    CuttingStep before;
    for (int i = 0; i < 200; ++i) {
        before = cut(state, in, of_hardness(hardness));
        state = before.next;
    }
    // The cut has arrived: the proxy lies where the tool is, and deeper by the clearance; the bed is as deep.
    state.known = {-before.bearing_object_m.y, kDown};
    for (const double clearance_m : {0.0, 3e-5, 6e-5}) {
        in.proxy_object_m = before.bearing_object_m + clearance_m * kDown;
        in.slack_m = 6e-5;
        const CuttingStep after = cut(state, in, of_hardness(hardness));
        const double change_N = glm::length(force_on_hand_N(in, after) - force_on_hand_N(in, before));
        EXPECT_LT(change_N, 0.005) << clearance_m;  // one more step of cutting
    }
}

TEST(Cutting, HowDeepItGetsDoesNotDependOnHowOftenTheSurfaceArrives) {
    const double hardness = 2e7;
    const auto depth_when_published_every = [&](int ticks) {
        CuttingState state;
        CuttingInput in = pressing(-0.002);
        in.slack_m = 0.02 * kCutterRadius_m;
        CuttingStep step;
        for (int i = 1; i <= 500; ++i) {
            step = cut(state, in, of_hardness(hardness));
            state = step.next;
            if (i % ticks != 0) continue;
            // The touching ball is smaller than the cutting one and comes to lie that much deeper.
            in.proxy_object_m = step.bearing_object_m + in.slack_m * kDown;
            state.known = {-in.proxy_object_m.y, kDown};
        }
        return -step.bearing_object_m.y;
    };
    const double never = depth_when_published_every(1'000'000);
    for (const int ticks : {1, 3, 10, 50}) EXPECT_NEAR(depth_when_published_every(ticks), never, 1e-9) << ticks;
}

TEST(Cutting, TheToolNeverGoesBeyondTheHandNorStaysBehindTheProxy) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int run = 0; run < 30; ++run) {
        CuttingState state;
        Vec3 hip(0.0);
        const TouchMaterial material = of_hardness(std::pow(10.0, 7.0 + 3.0 * any(random)));
        for (int i = 0; i < 400; ++i) {
            hip += 2e-4 * Vec3(any(random), any(random) - 0.1, any(random));
            hip.y = std::min(hip.y, -1e-9);
            CuttingInput in = pressing(0.0);
            in.hip_object_m = hip;
            in.proxy_object_m = {hip.x, 0.0, hip.z};
            in.slack_m = 5e-5;
            const CuttingStep step = cut(state, in, material);
            const double lag_m = glm::length(step.bearing_object_m - hip);
            EXPECT_LE(lag_m, glm::length(in.proxy_object_m - hip) + in.slack_m + 1e-12);
            EXPECT_GE(step.bearing_object_m.y, hip.y - 1e-12);
            state = step.next;
        }
    }
}

TEST(Cutting, TakesEnergyAndGivesNoneBack) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int run = 0; run < 40; ++run) {
        CuttingState state;
        state.known = {0.001 * std::abs(any(random)), kDown};
        Vec3 hip(0.0, -1e-6, 0.0), velocity(0.0);
        double taken_J = 0.0;
        const TouchMaterial material = of_hardness(std::pow(10.0, 7.0 + 3.0 * any(random)));
        for (int i = 0; i < 500; ++i) {
            velocity += 0.02 * Vec3(any(random), any(random), any(random));
            const Vec3 from = hip;
            hip += velocity * kDt;
            if (hip.y >= 0.0) hip.y = -1e-6, velocity.y = 0.0;
            const Vec3 motion = hip - from;
            CuttingInput in = pressing(0.0);
            in.hip_object_m = hip;
            in.proxy_object_m = {hip.x, 0.0, hip.z};
            const CuttingStep step = cut(state, in, material);
            // A convex spring's work is never less than its energy gained when counted with the force at the end.
            taken_J -= glm::dot(force_on_hand_N(in, step), motion);
            const double stored_J =
                0.5 * kStiffness * glm::dot(step.bearing_object_m - hip, step.bearing_object_m - hip);
            EXPECT_GE(taken_J, stored_J - 1e-9) << run << ' ' << i;
            state = step.next;
        }
    }
}

TEST(Cutting, DragIsViscousOverTheEngagedArea) {
    TouchMaterial material = of_hardness(1e7);
    material.cutting_drag_Ns_per_m3 = 2e4;
    CuttingState state;
    state.known = {0.002, kDown};
    CuttingInput in = pressing(-0.001);
    in.velocity_device_m_per_s = {0.1, 0.0, -0.05};
    const CuttingStep step = cut(state, in, material);
    EXPECT_GT(step.engaged_area_m2, 1e-5);
    EXPECT_LT(glm::length(step.drag_device_N + 2e4 * step.engaged_area_m2 * in.velocity_device_m_per_s), 1e-15);
    in.cutting = false;
    EXPECT_EQ(cut(state, in, material).drag_device_N, Vec3(0.0));
}

TEST(Engagement, OnAPlaneItIsHowDeepTheBallLies) {
    for (const int squares : {10, 80, 400}) {  // of 10 mm, of 1.25 mm, of a quarter of one
        const test::Surface plane = test::plane(0.05, squares);
        for (const double depth : {0.0, 0.0003, 0.001, 0.002}) {
            const Engagement seen =
                engagement(*plane, {0.0011, kCutterRadius_m - depth, 0.0007}, kCutterRadius_m).engagement;
            EXPECT_NEAR(seen.depth_m, depth, 0.06 * kCutterRadius_m) << squares;
            EXPECT_GT(glm::dot(seen.into_object, kDown), 0.99) << squares;
        }
    }
    const test::Surface plane = test::plane();
    const Engagement away = engagement(*plane, {0.0, 2.0 * kCutterRadius_m, 0.0}, kCutterRadius_m).engagement;
    EXPECT_EQ(away.depth_m, 0.0);
    EXPECT_EQ(away.into_object, Vec3(0.0));
}

TEST(Engagement, InAGrooveItIsWhatTheWallsTakeUpOfTheView) {
    // Half a pipe, open at both ends: within 1.1 R of the middle it is z0 = sqrt(0.21) R long to both sides, and takes
    // up W = 2 pi z0 / (1.1 R) of the view.
    const test::Surface groove = test::groove(kCutterRadius_m, 0.05, 24, 200, 0.0);
    const Engagement seen = engagement(*groove, Vec3(0.0), kCutterRadius_m).engagement;
    EXPECT_NEAR(seen.depth_m, (std::sqrt(0.21) - 0.1) * kCutterRadius_m, 0.03 * kCutterRadius_m);
    EXPECT_GT(glm::dot(seen.into_object, kDown), 0.999);
}

TEST(Engagement, DoesNotDependOnTheUnitOfLengthOrThePlace) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        const double R = kCutterRadius_m * scale;
        const Vec3 origin = scale * Vec3(3.0, -2.0, 1.0);
        const test::Surface wavy = test::height_field(
            0.02 * scale, 80, [&](double x, double z) { return 0.1 * R * std::sin(x / R) * std::cos(z / R); },
            Vec3(0.0));
        wavy->origin_object = origin;
        const Engagement seen = engagement(*wavy, origin + scale * Vec3(0.0004, 0.0021, 0.001), R).engagement;
        const test::Surface same = test::height_field(0.02, 80, [&](double x, double z) {
            return 0.1 * kCutterRadius_m * std::sin(x / kCutterRadius_m) * std::cos(z / kCutterRadius_m);
        });
        const Engagement unscaled = engagement(*same, Vec3(0.0004, 0.0021, 0.001), kCutterRadius_m).engagement;
        EXPECT_NEAR(seen.depth_m / scale, unscaled.depth_m, 1e-6);
    }
}

TEST(Engagement, PiecesOfLargeTrianglesCountAsWorkThatComesToAnEnd) {
    // Sides of eight radii are cut into 24 parts, and so the triangle into 576 pieces. A thousand such triangles lie
    // one above the other.
    test::SurfaceBuilder b;
    const double side = 8.0 * kCutterRadius_m;
    for (int i = 0; i < 1000; ++i) {
        const double y = -0.5 * kCutterRadius_m - 1e-7 * i;
        b.triangle(b.vertex({-0.3 * side, y, -0.3 * side}), b.vertex({-0.3 * side, y, 0.4 * side}),
                   b.vertex({0.4 * side, y, -0.3 * side}));
    }
    const test::Surface many = b.finish();
    const EngagementLook look = engagement(*many, Vec3(0.0), kCutterRadius_m);
    EXPECT_GT(look.engagement.depth_m, 0.0);
    // The longest side, 0.7 sqrt(2) times 8 radii, makes 24 parts of a third of a radius; four triangles are cut up at
    // once.
    EXPECT_LE(look.triangles_seen, kMostEngagementPieces / (24 * 24) + 4);
}

TEST(Engagement, TwoLargeTrianglesAreSeenAsManySmallOnes) {
    const test::Surface coarse = test::plane(4.0 * kCutterRadius_m, 1), fine = test::plane(4.0 * kCutterRadius_m, 40);
    for (const double depth : {0.2 * kCutterRadius_m, 0.5 * kCutterRadius_m, 0.8 * kCutterRadius_m}) {
        const Vec3 center(0.0, kCutterRadius_m - depth, 0.0);
        const double of_few = engagement(*coarse, center, kCutterRadius_m).engagement.depth_m;
        // Pieces of half a radius instead of a third, which a triangle of eleven radii would have to be cut into.
        EXPECT_NEAR(of_few, engagement(*fine, center, kCutterRadius_m).engagement.depth_m, 0.15 * kCutterRadius_m)
            << depth;
    }
}

TEST(Engagement, WhatLiesAheadCountsForBothHalvesAndWhatLiesBehindForNone) {
    // An uncut wall at the ball's side.
    test::SurfaceBuilder b;
    const double x = 0.5 * kCutterRadius_m, half = 3.0 * kCutterRadius_m;
    constexpr int kCells = 40;
    const double s = 2.0 * half / kCells;
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
            const double y = -half + s * i, z = -half + s * j;
            b.quad({x, y, z}, {x, y, z + s}, {x, y + s, z + s}, {x, y + s, z});
        }
    const test::Surface wall = b.finish();
    const auto depth = [&](const Vec3& ahead) {
        return engagement(*wall, Vec3(0.0), kCutterRadius_m, ahead).engagement.depth_m +
               0.1 * kCutterRadius_m;  // 1.1 D
    };
    const double around = depth(Vec3(0.0));
    ASSERT_GT(around, 0.2 * kCutterRadius_m);
    EXPECT_NEAR(depth({1.0, 0.0, 0.0}), 2.0 * around, 1e-6 * kCutterRadius_m);
    EXPECT_NEAR(depth({0.5, 0.0, 0.0}), 1.5 * around, 1e-6 * kCutterRadius_m);
    EXPECT_EQ(depth({-1.0, 0.0, 0.0}), 0.1 * kCutterRadius_m);
}

TEST(Cutting, LooksAgainAtTheSurfaceWhenItIsAnotherOrTheToolHasMovedOnAndElseSparesItself) {
    const test::Surface plane = test::plane(0.05, 40);
    CuttingInput in = pressing(-0.001);
    in.proxy_object_m = {0.0, 0.002, 0.0};
    LookedAt looked = look_at({}, in, *plane);
    EXPECT_GT(looked.triangles_seen, 0u);
    const double depth = looked.next.known.depth_m;
    EXPECT_NEAR(depth, 0.001, 2e-4);
    looked = look_at(looked.next, in, *plane);
    EXPECT_EQ(looked.triangles_seen, 0u) << "nothing is new";
    EXPECT_EQ(looked.next.known.depth_m, depth);
    in.proxy_object_m.y -= 0.05 * kCutterRadius_m;
    looked = look_at(looked.next, in, *plane);
    EXPECT_EQ(looked.triangles_seen, 0u);
    in.proxy_object_m.y -= 0.15 * kCutterRadius_m;
    looked = look_at(looked.next, in, *plane);
    EXPECT_GT(looked.triangles_seen, 0u);
    EXPECT_NEAR(looked.next.known.depth_m - depth, 0.2 * kCutterRadius_m, 1e-4);
    plane->sequence = 2;
    EXPECT_GT(look_at(looked.next, in, *plane).triangles_seen, 0u);
}

}  // namespace burin::haptics

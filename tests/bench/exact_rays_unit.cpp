// SPDX-License-Identifier: MIT
// The benchmark's own references: rays against closed forms and point-by-point looks, creases against the definition.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/measure/exact_creases.hpp"
#include "bench/measure/exact_rays.hpp"
#include "bench/measure/scenes.hpp"
#include "bench/measure/swept_union.hpp"
#include "tests/compute/effort.hpp"

namespace burin::bench {
namespace {

using compute::test::Random;
using compute::test::repeated;

std::vector<compute::BallSweep> random_sweeps(Random& random, int count) {
    std::vector<compute::BallSweep> sweeps;
    for (int i = 0; i < count; ++i) {
        const Vec3 from(random.unit(), random.unit(), random.unit());
        Vec3 to = from;
        if (random.chance(0.7))
            to += Vec3(random.between(-0.3, 0.3), random.between(-0.3, 0.3), random.between(-0.3, 0.3));
        if (random.chance(0.2)) to.x = from.x;  // motions across an axis, and along one, are special
        if (random.chance(0.2)) to.y = from.y;
        sweeps.push_back({from, to, random.between(0.02, 0.2), 0});
    }
    return sweeps;
}

bool holds(const std::vector<Interval>& intervals, double x) {
    for (const Interval& i : intervals) {
        if (x > i.lo && x < i.hi) return true;
    }
    return false;
}

Vec3 on_ray(int axis, double u, double v, double depth) {
    Vec3 p(0.0);
    p[axis] = depth;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    return p;
}

double brute_distance(const std::vector<compute::BallSweep>& sweeps, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const compute::BallSweep& s : sweeps) {
        const Vec3 e = s.end_object_m - s.start_object_m;
        const double length2 = glm::dot(e, e);
        const double t = length2 > 0 ? std::clamp(glm::dot(p - s.start_object_m, e) / length2, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::length(p - s.start_object_m - e * t) - s.radius_m);
    }
    return least;
}

}  // namespace

TEST(ExactRays, ThroughATurnedCubeHoldWhatLiesInIt) {
    Random random(7);
    for (int i = 0; i < repeated(300); ++i) {
        const Vec3 axis_of_turn(random.between(-1, 1), random.between(-1, 1), random.between(0.1, 1));
        const Pose pose{
            {random.between(-0.3, 0.3), random.between(-0.3, 0.3), random.between(-0.3, 0.3)},
            i % 10 == 0 ? Quat(1, 0, 0, 0) : glm::angleAxis(random.between(0, 3), glm::normalize(axis_of_turn))};
        const int axis = i % 3;
        const double u = random.between(-0.5, 1.5), v = random.between(-0.5, 1.5), growth = random.between(-0.1, 0.1);
        const auto cube = through_cube(pose, axis, u, v, growth);
        for (int k = 0; k < 20; ++k) {
            const double depth = random.between(-1.5, 2.5);
            const Vec3 p = glm::conjugate(pose.orientation) * (on_ray(axis, u, v, depth) - pose.position_m);
            const Vec3 outside = glm::abs(p - Vec3(0.5)) - Vec3(0.5 + growth);
            const double most = std::max({outside.x, outside.y, outside.z});
            if (std::abs(most) < 1e-9) continue;  // on a face
            EXPECT_EQ(cube && depth > cube->lo && depth < cube->hi, most < 0.0);
        }
    }
}

TEST(ExactRays, KeepOfGivenIntervalsWhatTheSweepsLeave) {
    // Along the line they cover 0.3 to 0.7 and 0.83 to 0.87.
    const std::vector<compute::BallSweep> balls{{Vec3(0.5), Vec3(0.5), 0.2, 0},
                                                {Vec3(0.85, 0.5, 0.5), Vec3(0.85, 0.5, 0.5), 0.02, 0}};
    const RayColumns columns(balls, 0, 0.0);
    const std::vector<Interval> uncut{{0.0, 0.25}, {0.4, 0.5}, {0.6, 0.72}, {0.75, 0.9}};
    const std::vector<Interval> kept = columns.kept_of(uncut, 0.5, 0.5, 0.0);
    const std::vector<Interval> expected{{0.0, 0.25}, {0.7, 0.72}, {0.75, 0.83}, {0.87, 0.9}};
    ASSERT_EQ(kept.size(), expected.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
        EXPECT_NEAR(kept[i].lo, expected[i].lo, 1e-15);
        EXPECT_NEAR(kept[i].hi, expected[i].hi, 1e-15);
    }
}

TEST(ExactRays, CoverWhatTheDistanceToTheSweepsSays) {
    Random random(1);
    for (int round = 0; round < repeated(400); ++round) {
        const auto sweeps = random_sweeps(random, random.small(1, 6));
        const int axis = random.small(0, 2);
        const double u = random.unit(), v = random.unit();
        const auto intervals = covered(sweeps, axis, u, v);
        for (std::size_t i = 1; i < intervals.size(); ++i) EXPECT_GT(intervals[i].lo, intervals[i - 1].hi);
        for (int k = 0; k < 100; ++k) {
            const double depth = random.between(-0.5, 1.5);
            const double distance = brute_distance(sweeps, on_ray(axis, u, v, depth));
            if (std::abs(distance) < 1e-9) continue;  // either answer is right
            EXPECT_EQ(holds(intervals, depth), distance < 0.0) << depth;
        }
    }
}

TEST(ExactRays, ColumnsLeaveNothingOut) {
    Random random(2);
    const auto sweeps = random_sweeps(random, 60);
    for (int axis = 0; axis < 3; ++axis) {
        const RayColumns columns(sweeps, axis, 0.01);
        for (int i = 0; i < repeated(2000); ++i) {
            const double u = random.between(-0.1, 1.1), v = random.between(-0.1, 1.1),
                         growth = random.between(-0.01, 0.01);
            EXPECT_EQ(columns.covered(u, v, growth), covered(sweeps, axis, u, v, growth));
        }
    }
}

TEST(ExactRays, VolumesApproachTheClosedForms) {
    for (const CarveScene& scene : {ball_scene(), capsule_scene(), cavity_scene()}) {
        EXPECT_NEAR(removed_volume_m3(scene.sweeps, 512) / scene.removed_m3, 1.0, 5e-5)
            << scene.name;  // 512^-1.5: steep walls
    }
    if (!compute::test::kSanitized) {
        const CarveScene stamps = stroke_1000_scene(), swept = stroke_1000_swept_scene();
        EXPECT_NEAR(removed_volume_m3(stamps.sweeps, 512) / stamps.removed_m3, 1.0, 5e-5);
        EXPECT_NEAR(removed_volume_m3(swept.sweeps, 512) / swept.removed_m3, 1.0, 5e-5);
        EXPECT_GT(swept.removed_m3, stamps.removed_m3);
    }
}

TEST(ExactRays, FindPiecesThatAreMissing) {
    using Intervals = std::vector<Interval>;
    const Intervals whole{{0.0, 1.0}}, gap{{0.0, 0.4}, {0.6, 1.0}};
    EXPECT_EQ(pieces_missing(whole, whole, 0.01), 0u);
    EXPECT_EQ(pieces_missing(whole, gap, 0.01), 1u);
    EXPECT_EQ(pieces_missing(gap, whole, 0.01), 0u);
    EXPECT_EQ(pieces_missing(whole, gap, 0.3), 0u);  // the gap is shorter than that
    EXPECT_EQ(pieces_missing(whole, Intervals{}, 0.01), 1u);
    EXPECT_EQ(pieces_missing(whole, Intervals{{0.2, 0.3}, {0.5, 0.9}}, 0.01), 3u);
    EXPECT_EQ(pieces_missing(whole, Intervals{{-1.0, 0.005}, {0.01, 2.0}}, 0.01), 0u);
    EXPECT_EQ(pieces_missing(gap, Intervals{{0.0, 0.4}}, 0.01), 1u);
}

TEST(SweptUnion, IsAsFarAsTheNearestSweep) {
    Random random(3);
    const auto sweeps = random_sweeps(random, 150);
    const SweptUnion tools(sweeps);
    for (int i = 0; i < repeated(20000); ++i) {
        const Vec3 p(random.between(-0.3, 1.3), random.between(-0.3, 1.3), random.between(-0.3, 1.3));
        const double distance = brute_distance(sweeps, p);
        EXPECT_NEAR(tools.distance(p), distance, 1e-14);
        const auto at = tools.surface_error(p);
        EXPECT_NEAR(at.error_m, std::abs(std::max(cube_distance(p), -distance)), 1e-14);
        EXPECT_EQ(at.in_cut_region, distance <= SweptUnion::kCutRegion_m);
    }
}

TEST(ExactCreases, RimOfABallIsItsCircleInTheFace) {
    const CarveScene scene = ball_scene();
    const Vec3 center = scene.sweeps[0].start_object_m;
    const double circle = std::sqrt(0.2 * 0.2 - 0.05 * 0.05);
    const auto points = rim_points(scene, 200);
    EXPECT_GT(points.size(), 100u);
    double turned = 0.0;  // points lie all around
    for (const Vec3& p : points) {
        EXPECT_EQ(p.z, 1.0);
        EXPECT_NEAR(std::hypot(p.x - center.x, p.y - center.y), circle, 1e-12);
        turned += std::atan2(p.y - center.y, p.x - center.x) > 0 ? 1.0 : -1.0;
    }
    EXPECT_LT(std::abs(turned), 0.1 * static_cast<double>(points.size()));
}

TEST(ExactCreases, TwoBallsMeetInACircleWithoutWhatAThirdTakes) {
    const double r = 0.1, half = 0.06;
    const Vec3 a(0.5 - half, 0.5, 0.5), b(0.5 + half, 0.5, 0.5), third(0.5, 0.6, 0.5);
    CarveScene scene{"balls", {{a, a, r, 0}, {b, b, r, 0}}, 0.0};
    const double circle = std::sqrt(r * r - half * half), step = 0.001;
    const auto whole = ball_ball_crease_points(scene, SweptUnion(scene.sweeps), 0.5, step);
    EXPECT_NEAR(static_cast<double>(whole.size()), 2.0 * std::numbers::pi * circle / step, 1.0);
    for (const Vec3& p : whole) {
        EXPECT_NEAR(glm::length(p - a), r, 1e-12);
        EXPECT_NEAR(glm::length(p - b), r, 1e-12);
    }
    scene.sweeps.push_back({third, third, r, 0});
    const SweptUnion tools(scene.sweeps);
    std::size_t kept = 0;
    for (const Vec3& p : whole) kept += glm::length(p - third) > r ? 1 : 0;
    std::size_t found = 0;
    for (const Vec3& p : ball_ball_crease_points(scene, tools, 0.5, step)) {
        EXPECT_GT(glm::length(p - third), r - 1e-9);
        found += std::abs(glm::length(p - a) - r) < 1e-9 && std::abs(glm::length(p - b) - r) < 1e-9 ? 1 : 0;
    }
    EXPECT_LT(kept, whole.size());
    EXPECT_NEAR(static_cast<double>(found), static_cast<double>(kept), 2.0);
}

TEST(ExactCreases, LeaveOutBluntOnesAndThoseOutsideTheCube) {
    const double r = 0.1;
    const auto points = [&](double half, double z, double least_rad) {
        const Vec3 a(0.5 - half, 0.5, z), b(0.5 + half, 0.5, z);
        const CarveScene scene{"balls", {{a, a, r, 0}, {b, b, r, 0}}, 0.0};
        return ball_ball_crease_points(scene, SweptUnion(scene.sweeps), least_rad, 0.001);
    };
    // The normals of two equal balls 2 half apart differ by 2 asin(half / r).
    EXPECT_TRUE(points(0.025, 0.5, 2.0 * std::asin(0.26)).empty());
    EXPECT_FALSE(points(0.025, 0.5, 2.0 * std::asin(0.24)).empty());
    const auto cut_off = points(0.06, 1.0, 0.5);
    EXPECT_FALSE(cut_off.empty());
    for (const Vec3& p : cut_off) EXPECT_LT(p.z, 1.0);
    EXPECT_NEAR(static_cast<double>(cut_off.size()), 0.5 * static_cast<double>(points(0.06, 0.5, 0.5).size()), 3.0);
}

TEST(ExactCreases, UntouchedEdgesKeepTheirDistance) {
    const Vec3 near_edge(0.5, 0.0, 1.0);
    const CarveScene scene{"bite", {{near_edge, near_edge, 0.1, 0}}, 0.0};
    const SweptUnion tools(scene.sweeps);
    const auto points = untouched_edge_points(tools, 1000, 0.05);
    EXPECT_EQ(points.size(), 12000u - 300u);  // 0.15 to either side of the ball's centre, on one edge
    for (const Vec3& p : points) EXPECT_NEAR(cube_distance(p), 0.0, 1e-15);
    EXPECT_EQ(untouched_corners(tools, 0.05).size(), 8u);
    EXPECT_EQ(untouched_corners(tools, 0.45).size(), 6u);
}

}  // namespace burin::bench

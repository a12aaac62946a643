// SPDX-License-Identifier: MIT
// The pieces under the god-object against slow, independent computations.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <set>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/half_spaces.hpp"
#include "haptics/contact/triangle_contact.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics {
namespace {

double any_between(double lo, double hi) { return lo + (hi - lo) * (*rc::gen::inRange(0, 1'000'001) / 1e6); }

Vec3 any_in_cube(double half) {
    const double x = any_between(-half, half), y = any_between(-half, half), z = any_between(-half, half);
    return {x, y, z};
}

geometry::Triangle any_triangle() {
    geometry::Triangle t{any_in_cube(1), any_in_cube(1), any_in_cube(1)};
    RC_PRE(glm::length(glm::cross(t.b - t.a, t.c - t.a)) > 1e-2);
    return t;
}

// Nearest point by bisection on barycentric coordinates: distance is convex along any line in the triangle.
double sampled_distance(const Vec3& p, const geometry::Triangle& t) {
    const auto along = [&](double v) {
        const Vec3 from = t.a + v * (t.c - t.a), to = t.b + v * (t.c - t.b);
        double lo = 0.0, hi = 1.0;
        for (int i = 0; i < 60; ++i) {
            const double a = lo + (hi - lo) / 3.0, b = hi - (hi - lo) / 3.0;
            (glm::length(p - glm::mix(from, to, a)) < glm::length(p - glm::mix(from, to, b)) ? hi : lo) =
                glm::length(p - glm::mix(from, to, a)) < glm::length(p - glm::mix(from, to, b)) ? b : a;
        }
        return glm::length(p - glm::mix(from, to, 0.5 * (lo + hi)));
    };
    double lo = 0.0, hi = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double a = lo + (hi - lo) / 3.0, b = hi - (hi - lo) / 3.0;
        const bool left = along(a) < along(b);
        (left ? hi : lo) = left ? b : a;
    }
    return along(0.5 * (lo + hi));
}

}  // namespace

TEST(TriangleContact, NearestPointAgreesWithATernarySearch) {
    EXPECT_TRUE(rc::check([] {
        const geometry::Triangle t = any_triangle();
        const Vec3 p = any_in_cube(2);
        const NearestOnTriangle on = nearest_on_triangle(p, t);
        RC_ASSERT(std::abs(glm::length(p - on.point) - sampled_distance(p, t)) < 1e-6);
        if (on.on_face) RC_ASSERT(glm::length(glm::cross(p - on.point, outward_normal(t))) < 1e-9);
    }));
}

TEST(TriangleContact, ABallSweptFromTheFrontStopsExactlyWhereItTouches) {
    EXPECT_TRUE(rc::check([] {
        const geometry::Triangle t = any_triangle();
        const Vec3 from = any_in_cube(3), motion = any_in_cube(4);
        const double radius = any_between(0.01, 0.5);
        const auto distance = [&](double f) {
            const Vec3 c = from + f * motion;
            return glm::length(c - nearest_on_triangle(c, t).point);
        };
        const auto height = [&](double f) { return glm::dot(from + f * motion - t.a, outward_normal(t)); };
        RC_PRE(distance(0.0) > radius + 1e-6);
        RC_PRE(height(0.0) > 0.0);
        const double f = fraction_until_touch(from, motion, radius, t);
        if (f <= 1.0) RC_ASSERT(std::abs(distance(f) - radius) < 1e-6);
        // Not a moment too late, unless the ball has gone behind the plane past the triangle: from there it cannot
        // touch.
        for (int i = 0; i <= 200; ++i) {
            const double g = std::min(f, 1.0) * i / 200.0;
            if (height(g) < 0.0) break;
            RC_ASSERT(distance(g) > radius - 1e-6);
        }
    }));
}

TEST(TriangleContact, ABallSweptAtAClosedBoxStopsExactlyWhereItTouches) {
    // Edges and corners too, from any side: all twelve triangles together against the distance to a box in closed form.
    const Vec3 half(0.5, 0.3, 0.7);
    const test::Surface box = test::box(-half, half);
    EXPECT_TRUE(rc::check([&] {
        const Vec3 from = any_in_cube(2), motion = any_in_cube(4);
        const double radius = any_between(0.01, 0.5);
        const auto distance = [&](double f) {
            return glm::length(glm::max(glm::abs(from + f * motion) - half, Vec3(0.0)));
        };
        RC_PRE(distance(0.0) > radius + 1e-6);
        double f = kNoTouch;
        for (std::uint32_t i = 0; i < box->triangles(); ++i) {
            f = std::min(f, fraction_until_touch(from, motion, radius, box->triangle(i)));
        }
        if (f <= 1.0) RC_ASSERT(std::abs(distance(f) - radius) < 1e-6);
        for (int i = 0; i <= 200; ++i) RC_ASSERT(distance(std::min(f, 1.0) * i / 200.0) > radius - 1e-6);
    }));
}

TEST(HalfSpaces, NearestPointSatisfiesTheOptimalityConditions) {
    // Karush-Kuhn-Tucker: inside all, and goal-to-point a non-negative sum of bearing normals. For a convex problem
    // that is proof.
    EXPECT_TRUE(rc::check([] {
        std::vector<HalfSpace> spaces;
        const int n = *rc::gen::inRange(0, 40);
        for (int i = 0; i < n; ++i) {
            const Vec3 v = any_in_cube(1);
            RC_PRE(glm::length(v) > 0.1);
            spaces.push_back({glm::normalize(v), -any_between(0.0, 0.2)});
        }
        const Vec3 goal = any_in_cube(3);
        const NearestInside best = nearest_inside(spaces, goal, 1e-9);
        RC_ASSERT(best.found);  // the origin is inside all
        Vec3 sum = goal;
        for (std::uint32_t i = 0; i < best.bearing_count; ++i) {
            const HalfSpace& plane = spaces[best.bearing[i]];
            RC_ASSERT(best.weights[i] >= 0.0);
            RC_ASSERT(std::abs(glm::dot(plane.normal, best.point) - plane.offset) < 1e-7);
            sum += best.weights[i] * plane.normal;
        }
        RC_ASSERT(glm::length(sum - best.point) < 1e-6);
        for (const HalfSpace& plane : spaces) RC_ASSERT(glm::dot(plane.normal, best.point) > plane.offset - 1e-8);
    }));
}

TEST(HalfSpaces, SaysSoWhenThereIsNoCommonPoint) {
    const std::vector<HalfSpace> apart{{{0, 1, 0}, 1.0}, {{0, -1, 0}, 1.0}};
    EXPECT_FALSE(nearest_inside(apart, Vec3(0.0), 1e-9).found);
}

TEST(HalfSpaces, ThatDifferByLittleAreMetAsExactlyAsOthers) {
    // What a ball of a millimetre has around a corner: a plane for each triangle there, all of almost one direction.
    // Two or three of them bear the answer, which is known, and others are just satisfied.
    compute::test::Random random(4);
    constexpr double kRadius_m = 1e-3, kTolerance_m = 1e-9 * kRadius_m;
    int borne_by_more = 0;
    const int times = compute::test::repeated(100'000);
    for (int i = 0; i < times; ++i) {
        const double differ = std::pow(10.0, random.between(-6.0, -1.0));
        const auto near = [&](const Vec3& v, double most) {
            return v + most * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        };
        const Vec3 up = glm::normalize(near(Vec3(0.0), 1.0));
        std::vector<HalfSpace> spaces;
        for (int k = random.small(2, 6); k > 0; --k) spaces.push_back({glm::normalize(near(up, differ)), 0.0});
        const std::size_t bearing = std::min<std::size_t>(spaces.size(), random.chance(0.5) ? 2 : 3);
        const Vec3 goal = near(-3.0 * kRadius_m * up, 0.5 * kRadius_m);
        Vec3 answer = goal;
        for (std::size_t k = 0; k < bearing; ++k) answer += random.between(0.2, 1.0) * kRadius_m * spaces[k].normal;
        for (std::size_t k = 0; k < spaces.size(); ++k)
            spaces[k].offset = glm::dot(spaces[k].normal, answer) -
                               (k < bearing ? 0.0 : random.between(0.0, 1.0) * differ * differ * kRadius_m);
        const NearestInside best = nearest_inside(spaces, goal, kTolerance_m);
        ASSERT_TRUE(best.found) << i << ", planes that differ by " << differ;
        for (const HalfSpace& space : spaces)
            ASSERT_GE(glm::dot(space.normal, best.point), space.offset - 2.0 * kTolerance_m) << i;
        ASSERT_LE(glm::length(best.point - goal), glm::length(answer - goal) + 2.0 * kTolerance_m) << i;
        borne_by_more += best.bearing_count > 1 ? 1 : 0;
    }
    EXPECT_GT(borne_by_more, times / 2);
}

TEST(LocalSurfaceSearch, EveryBoxFindsEachOfItsTrianglesOnce) {
    EXPECT_TRUE(rc::check([] {
        test::SurfaceBuilder b(any_in_cube(1));
        const double size = *rc::gen::element(0.01, 0.2, 3.0);
        const int n = *rc::gen::inRange(1, 200);
        for (int i = 0; i < n; ++i) {
            const Vec3 at = any_in_cube(1);
            const Vec3 a = at + any_in_cube(size), c = at + any_in_cube(size), d = at + any_in_cube(size);
            const auto va = b.vertex(a), vc = b.vertex(c), vd = b.vertex(d);
            b.triangle(va, vc, vd);
        }
        const test::Surface surface = b.finish();
        const Vec3 lo = any_in_cube(2), hi = lo + glm::abs(any_in_cube(1));
        std::multiset<std::uint32_t> found;
        geometry::for_each_triangle_near(*surface, lo, hi, [&](std::uint32_t i, const geometry::Triangle& t) {
            found.insert(i);
            RC_ASSERT(t.b == surface->triangle(i).b);
            return true;
        });
        for (std::uint32_t i = 0; i < surface->triangles(); ++i) {
            const glm::vec4 sphere = surface->loose->search.spheres[i];
            if (sphere.w < 0) continue;  // degenerate
            const geometry::Triangle t = surface->triangle(i);
            Box box;
            for (const Vec3& corner : {t.a, t.b, t.c}) box.include(corner);
            const bool meets = glm::all(glm::lessThanEqual(box.lo, hi)) && glm::all(glm::lessThanEqual(lo, box.hi));
            RC_ASSERT(found.count(i) <= 1);
            if (meets) RC_ASSERT(found.count(i) == 1);
            for (const Vec3& corner : {t.a, t.b, t.c}) {
                RC_ASSERT((glm::length(corner - Vec3(sphere)) <= static_cast<double>(sphere.w)));
            }
        }
    }));
}

TEST(LocalSurfaceSearch, LeavesOutWhatIsBrokenAndSaysHowMuch) {
    geometry::GriddedTriangles piece;
    piece.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {std::nanf(""), 0, 0}, {0.5, 0, 0}};
    piece.triangles = {{0, 1, 2}, {0, 1, 4'000'000'000u}, {0, 1, 3}, {0, 4, 1}, {0, 0, 0}};
    const geometry::SearchBuild report = geometry::build_search(piece);
    EXPECT_EQ(report.listed, 1u);
    EXPECT_EQ(report.invalid, 2u);
    EXPECT_EQ(report.degenerate, 2u);
    EXPECT_EQ(geometry::build_search(piece).listed, 1u);  // again, from what it left
}

TEST(LocalSurfaceSearch, ALargeSurfaceIsListedCompletely) {
    const test::Surface plane = test::plane(0.05, 200);  // 80 000 triangles
    EXPECT_EQ(plane->loose->search.listed, 80'000u);
    EXPECT_TRUE(plane->loose->search.large.empty());
    std::uint32_t count = 0;
    geometry::for_each_triangle_near(*plane, Vec3(-1.0), Vec3(1.0), [&](std::uint32_t, const geometry::Triangle&) {
        ++count;
        return true;
    });
    EXPECT_EQ(count, 80'000u);
    // An empty one is searchable too.
    test::SurfaceBuilder b;
    const test::Surface empty = b.finish();
    EXPECT_TRUE(geometry::for_each_triangle_near(*empty, Vec3(-1.0), Vec3(1.0),
                                                 [](std::uint32_t, const geometry::Triangle&) { return false; }));
}

}  // namespace burin::haptics

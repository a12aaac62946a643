// SPDX-License-Identifier: MIT
// Which triangles meet: known configurations, and random ones against arithmetic in whole numbers by another method.
#include "geometry/mesh/triangle_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/mesh/exact_sign.hpp"

namespace burin::geometry::test {
namespace {

using CornersOfOne = std::array<Vec3, 3>;
using Whole = std::array<std::int64_t, 3>;

// Rational reference by clipping: cuts the second triangle's edges with the first one's plane in exact fractions, and
// asks whether any point of the cut lies within. Small whole coordinates keep everything within 128 bits.
__extension__ using Wide = __int128;
struct Fraction3 {  // (x, y, z) / w, w > 0
    std::array<Wide, 3> v;
    Wide w;
};

Whole minus(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Whole cross(const Whole& a, const Whole& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

using WholeTriangle = std::array<Whole, 3>;

bool point_within(const Fraction3& p, const WholeTriangle& t, const Whole& normal) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Whole inward = cross(normal, minus(t[(k + 1) % 3], t[k]));
        Wide side = 0;
        for (std::size_t i = 0; i < 3; ++i) side += inward[i] * (p.v[i] - p.w * t[k][i]);
        if (side < 0) return false;
    }
    return true;
}

// Whether the segment a-b, both in the triangle's plane, meets it: clips the segment at the three borders.
bool coplanar_segment_meets(const Whole& a, const Whole& b, const WholeTriangle& t, const Whole& normal) {
    // The parameter's range as fractions lo_n / lo_d and hi_n / hi_d with positive denominators.
    Wide lo_n = 0, lo_d = 1, hi_n = 1, hi_d = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Whole inward = cross(normal, minus(t[(k + 1) % 3], t[k]));
        const Wide at_a = dot(inward, minus(a, t[k])), at_b = dot(inward, minus(b, t[k]));
        if (at_a < 0 && at_b < 0) return false;
        if (at_a >= 0 && at_b >= 0) continue;
        const Wide n = at_a < 0 ? -at_a : at_a, d = at_a < 0 ? at_b - at_a : at_a - at_b;
        if (at_a < 0) {
            if (n * lo_d > lo_n * d) lo_n = n, lo_d = d;
        } else if (n * hi_d < hi_n * d) {
            hi_n = n, hi_d = d;
        }
    }
    return lo_n * hi_d <= hi_n * lo_d;
}

bool reference_one_way(const WholeTriangle& s, const WholeTriangle& t) {
    const Whole normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    for (std::size_t k = 0; k < 3; ++k) {
        const Whole &a = s[k], &b = s[(k + 1) % 3];
        const std::int64_t at_a = dot(normal, minus(a, t[0])), at_b = dot(normal, minus(b, t[0]));
        if ((at_a > 0 && at_b > 0) || (at_a < 0 && at_b < 0)) continue;
        if (at_a == 0 && at_b == 0) {
            if (coplanar_segment_meets(a, b, t, normal)) return true;
            continue;
        }
        const Wide w = at_a > at_b ? at_a - at_b : at_b - at_a;
        Fraction3 crossing{{}, w};
        for (std::size_t i = 0; i < 3; ++i) {
            crossing.v[i] = at_a > at_b ? Wide{at_a} * b[i] - Wide{at_b} * a[i] : Wide{at_b} * a[i] - Wide{at_a} * b[i];
        }
        if (point_within(crossing, t, normal)) return true;
    }
    return false;
}

bool has_area(const WholeTriangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])) != Whole{0, 0, 0}; }

Vec3 place(const Whole& p, double unit, const Vec3& origin) {
    return origin + Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])) * unit;
}

}  // namespace

TEST(ExactSign, DecidesWhereRoundingWouldNot) {
    // A point one step of a double above a slanted plane far from the origin.
    const Vec3 a(12.0, 12.0, 12.0), b(24.0, 12.5, 12.0), c(12.25, 24.0, 13.0);
    const Vec3 on = a + (b - a) * 0.5 + (c - a) * 0.25;
    EXPECT_EQ(side_of_plane(a, b, c, on), 0);
    const Vec3 above(on.x, on.y, std::nextafter(on.z, 100.0)), below(on.x, on.y, std::nextafter(on.z, 0.0));
    EXPECT_EQ(side_of_plane(a, b, c, above), 1);
    EXPECT_EQ(side_of_plane(a, b, c, below), -1);
    EXPECT_EQ(side_of_plane(b, a, c, above), -1);
    EXPECT_EQ(turn_seen_along(2, {0.5, 0.5, 0}, {12, 12, 5}, {24, 24, 9}), 0);
    EXPECT_EQ(turn_seen_along(2, {0.5, 0.5, 0}, {12, 12, 5}, {24, std::nextafter(24.0, 25.0), 9}), 1);
}

TEST(TriangleContact, KnownConfigurations) {
    const CornersOfOne base{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
    const auto meets = [&](const Vec3& a, const Vec3& b, const Vec3& c) { return triangles_meet(base, {a, b, c}); };
    EXPECT_TRUE(meets({1, 1, -1}, {1, 1, 1}, {9, 9, 1})) << "pierced";
    EXPECT_TRUE(meets({1, 1, 0}, {1, 1, 1}, {2, 2, 1})) << "touched by a vertex";
    EXPECT_TRUE(meets({2, -1, 1}, {2, -1, -1}, {2, 5, 0})) << "an edge crosses an edge";
    EXPECT_TRUE(meets({4, 0, 0}, {5, 0, 1}, {5, 0, -1})) << "vertex on vertex";
    EXPECT_TRUE(meets({1, 1, 0}, {2, 1, 0}, {1, 2, 0})) << "one within the other, in one plane";
    EXPECT_TRUE(meets({2, 2, 0}, {4, 4, 0}, {2, 4, 0})) << "touching in one plane";
    EXPECT_FALSE(meets({3, 3, 0}, {4, 4, 0}, {2, 4, 0})) << "beside each other in one plane";
    EXPECT_FALSE(meets({1, 1, 1}, {2, 1, 1}, {1, 2, 1})) << "parallel";
    EXPECT_FALSE(meets({3, 3, -1}, {3, 3, 1}, {9, 9, 1})) << "past the edge";
    EXPECT_TRUE(meets({1, 1, -1}, {1, 1, 0}, {1, 1, 1})) << "a triangle without area through the middle";
    EXPECT_FALSE(meets({5, 5, -1}, {5, 5, 0}, {5, 5, 1})) << "and beside it";
    EXPECT_TRUE(meets({1, 1, 0}, {1, 1, 0}, {1, 1, 0})) << "a point on it";
    EXPECT_FALSE(meets({1, 1, 1}, {1, 1, 1}, {1, 1, 1})) << "and above it";
}

TEST(TriangleContact, NeighboursMeetOnlyBeyondWhatTheyShare) {
    const std::vector<Vec3> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, -4, 0}, {1, 1, 0},
                              {2, 1, 5}, {4, 4, 0}, {2, 2, 3}, {2, 2, -3}, {8, 0, 0}};
    EXPECT_FALSE(meet_beyond_shared(p, {0, 1, 2}, {1, 0, 3})) << "flat neighbours over an edge";
    EXPECT_TRUE(meet_beyond_shared(p, {0, 1, 2}, {0, 1, 4})) << "folded onto each other";
    EXPECT_FALSE(meet_beyond_shared(p, {0, 1, 2}, {1, 0, 5})) << "at an angle";
    EXPECT_FALSE(meet_beyond_shared(p, {0, 1, 2}, {6, 1, 9})) << "flat, one vertex in common";
    EXPECT_TRUE(meet_beyond_shared(p, {0, 1, 2}, {0, 4, 5})) << "one vertex in common, an edge along the triangle";
    EXPECT_TRUE(meet_beyond_shared(p, {0, 1, 2}, {0, 7, 8})) << "one vertex in common, through the far edge";
    EXPECT_FALSE(meet_beyond_shared(p, {0, 1, 2}, {6, 9, 5})) << "apart";
    EXPECT_TRUE(meet_beyond_shared(p, {0, 1, 2}, {2, 1, 0})) << "the same three";
}

TEST(TriangleContact, EqualsWholeNumbersOnSmallLattices) {
    std::mt19937_64 random(7);
    std::size_t met = 0;
    for (int i = 0; i < 200000; ++i) {
        const std::int64_t size = i % 2 == 0 ? 3 : 9;  // a coarse lattice touches often
        WholeTriangle s, t;
        for (WholeTriangle* w : {&s, &t}) {
            for (Whole& p : *w) {
                for (std::int64_t& x : p) x = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(size));
            }
        }
        if (!has_area(s) || !has_area(t)) continue;
        const bool expected = reference_one_way(s, t) || reference_one_way(t, s);
        met += expected ? 1 : 0;
        // The same by floats of another scale, whose differences are not so round.
        const double unit = 1.0 / 1024.0 + 0x1p-20;
        const Vec3 origin(3.0, -1.0, 0.5);
        const CornersOfOne a{place(s[0], unit, origin), place(s[1], unit, origin), place(s[2], unit, origin)};
        const CornersOfOne b{place(t[0], unit, origin), place(t[1], unit, origin), place(t[2], unit, origin)};
        ASSERT_EQ(triangles_meet(a, b), expected) << i;
        ASSERT_EQ(triangles_meet(b, a), expected) << i;
    }
    EXPECT_GT(met, 20000u);
}

}  // namespace burin::geometry::test

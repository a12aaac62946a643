// SPDX-License-Identifier: MIT
// The exact capsule kernel against a 128-bit predicate of its own, and against scanning every depth.
#include "shaders/shared/capsule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/compute/effort.hpp"

namespace burin::shared {
namespace {

using compute::test::Random;
using compute::test::repeated;
__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;

// A capsule seen from a ray along z through (0, 0), so that the case is given by start and segment alone.
struct Case {
    std::array<std::int64_t, 3> start{}, along{};
    std::int64_t radius2 = 0;
};

Capsule capsule_of(const Case& c) {
    Capsule k{};
    k.radius2 = c.radius2;
    k.start_x = static_cast<int>(c.start[0]);
    k.start_y = static_cast<int>(c.start[1]);
    k.start_z = static_cast<int>(c.start[2]);
    k.along_x = static_cast<int>(c.along[0]);
    k.along_y = static_cast<int>(c.along[1]);
    k.along_z = static_cast<int>(c.along[2]);
    return k;
}

RaySpan span_of(const Case& c) { return capsule_span(capsule_from_ray(capsule_of(c), 2, 0, 0)); }

// Written from the definition, in 128 bits: is the ray's point at depth z in the closed capsule?
bool inside_capsule(const Case& c, std::int64_t z) {
    Int128 to_point2 = 0, length2 = 0, along_dot = 0, to_end2 = 0;
    const std::array<std::int64_t, 3> p{0, 0, z};
    for (std::size_t a = 0; a < 3; ++a) {
        const Int128 q = p[a] - c.start[a], e = c.along[a];
        to_point2 += q * q;
        length2 += e * e;
        along_dot += q * e;
        to_end2 += (q - e) * (q - e);
    }
    if (along_dot <= 0) return to_point2 <= c.radius2;
    if (along_dot >= length2) return to_end2 <= c.radius2;
    return to_point2 * length2 - along_dot * along_dot <= c.radius2 * length2;
}

// Depths next to which the distance to the segment must be smallest: beside the two ends, where the ray is nearest to
// the axis, and where it passes the end planes.
std::vector<std::int64_t> nearest_depths(const Case& c) {
    std::vector<long double> depths{static_cast<long double>(c.start[2]),
                                    static_cast<long double>(c.start[2] + c.along[2])};
    const long double ex = c.along[0], ey = c.along[1], ez = c.along[2];
    const long double across2 = ex * ex + ey * ey;
    const long double dot = -static_cast<long double>(c.start[0]) * ex - static_cast<long double>(c.start[1]) * ey;
    if (across2 > 0) depths.push_back(c.start[2] + dot * ez / across2);
    if (ez != 0) {
        depths.push_back(c.start[2] - dot / ez);
        depths.push_back(c.start[2] + (across2 + ez * ez - dot) / ez);
    }
    std::vector<std::int64_t> whole;
    for (const long double d : depths) {
        if (std::abs(d) > 0x1p28L) continue;  // farther than any capsule in range
        for (std::int64_t by = -2; by <= 2; ++by) whole.push_back(std::llround(d) + by);
    }
    return whole;
}

// Empty when the span is right.
std::string disagreement(const Case& c) {
    const RaySpan span = span_of(c);
    std::string what;
    if (span.lo <= span.hi) {
        if (!inside_capsule(c, span.lo)) what += " lo outside";
        if (!inside_capsule(c, span.hi)) what += " hi outside";
        if (inside_capsule(c, span.lo - 1)) what += " lo not the first";
        if (inside_capsule(c, span.hi + 1)) what += " hi not the last";
    } else {
        for (const std::int64_t z : nearest_depths(c)) {
            if (inside_capsule(c, z)) what = " missed depth " + std::to_string(z);
        }
    }
    if (what.empty()) return what;
    for (const auto& v : {c.start, c.along}) {
        for (const std::int64_t x : v) what += " " + std::to_string(x);
    }
    return what + " r2 " + std::to_string(c.radius2) + " span " + std::to_string(span.lo) + ".." +
           std::to_string(span.hi);
}

constexpr int kStartBits = 25, kAlongBits = 25, kRadiusBits = 24;

// Any capsule of the documented range, with segments across, along or almost along the ray more often than by chance.
Case any_case(Random& random) {
    Case c;
    for (auto& e : c.along)
        e = random.chance(0.2) ? 0 : random.chance(0.1) ? random.whole(-2, 2) : random.any_size(kAlongBits);
    const std::int64_t radius = std::abs(random.any_size(kRadiusBits));
    c.radius2 = std::max<std::int64_t>(radius * radius + (random.chance(0.5) ? random.whole(-radius, radius) : 0), 0);
    for (auto& s : c.start) s = random.any_size(kStartBits);
    return c;
}

// The ray passes the capsule at very nearly its radius: beside the cylinder, an end ball, or past an end.
Case grazing_case(Random& random) {
    Case c = any_case(random);
    const double f = random.chance(0.3) ? static_cast<double>(random.whole(0, 1)) : random.between(-0.1, 1.1);
    // Perpendicular to the axis in the plane across the ray, or anywhere around an end.
    double nx = static_cast<double>(-c.along[1]), ny = static_cast<double>(c.along[0]);
    if (random.chance(0.5) || (nx == 0 && ny == 0)) {
        const double angle = random.between(0, 6.28318530717958648);
        nx = std::cos(angle);
        ny = std::sin(angle);
    }
    const double length = std::hypot(nx, ny), side = random.chance(0.5) ? 1 : -1;
    const double distance = std::sqrt(static_cast<double>(c.radius2)) + static_cast<double>(random.whole(-2, 2));
    c.start[0] = std::llround(-f * static_cast<double>(c.along[0]) + side * distance * nx / length);
    c.start[1] = std::llround(-f * static_cast<double>(c.along[1]) + side * distance * ny / length);
    return c;
}

}  // namespace

TEST(Capsule, SpanEqualsScanningEveryDepthOfSmallCapsules) {
    Random random(1);
    int hits = 0;
    for (int i = 0; i < compute::test::repeated(60000); ++i) {
        Case c;
        const int size = random.small(0, 40);
        for (auto& s : c.start) s = random.whole(-size, size);
        for (auto& e : c.along) e = random.chance(0.3) ? 0 : random.whole(-size, size);
        c.radius2 = random.whole(0, size * size);
        const RaySpan span = span_of(c);
        for (std::int64_t z = -130; z <= 130; ++z) {
            ASSERT_EQ(span.lo <= z && z <= span.hi, inside_capsule(c, z)) << z << disagreement(c);
        }
        hits += span.lo <= span.hi ? 1 : 0;
    }
    EXPECT_GT(hits, compute::test::repeated(60000) / 10);
}

TEST(Capsule, SpanEqualsTheExactPredicateOnAMillionRays) {
    Random random(2);
    int hits = 0, misses = 0;
    for (int i = 0; i < compute::test::repeated(1000000); ++i) {
        const Case c = i % 2 == 0 ? any_case(random) : grazing_case(random);
        ASSERT_EQ(disagreement(c), "");
        const RaySpan span = span_of(c);
        ++(span.lo <= span.hi ? hits : misses);
    }
    EXPECT_GT(hits, compute::test::repeated(1000000) / 10);
    EXPECT_GT(misses, compute::test::repeated(1000000) / 10);
}

TEST(Capsule, SpanIsExactAtTheEndsOfTheRange) {
    constexpr std::int64_t kFar = std::int64_t{1} << 25, kLargest = std::int64_t{1} << 48;
    for (const std::int64_t sx : {-kFar, kFar, std::int64_t{0}})
        for (const std::int64_t ex : {-2 * kFar, -kFar, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, kFar})
            for (const std::int64_t sz : {-kFar, std::int64_t{0}, kFar})
                for (const std::int64_t ez : {-2 * kFar, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, kFar})
                    for (const std::int64_t r2 : {std::int64_t{0}, std::int64_t{1}, std::int64_t{1} << 24, kLargest}) {
                        ASSERT_EQ(disagreement({{sx, 0, sz}, {ex, 0, ez}, r2}), "");
                        ASSERT_EQ(disagreement({{sx, 1, sz}, {ex, -1, ez}, r2}), "");
                        ASSERT_EQ(disagreement({{sx, kFar, sz}, {ex, kFar, ez}, r2}), "");
                    }
}

// The end planes of a segment one unit off the perpendicular meet a ray behind its start 2^36 units away.
TEST(Capsule, StrokeAlmostAcrossARayTakesNothingBesideTheTool) {
    Random random(3);
    for (int i = 0; i < compute::test::repeated(200000); ++i) {
        Case c;
        c.along = {random.whole(1, std::int64_t{1} << 24), random.whole(-3, 3), random.whole(-3, 3)};
        const std::int64_t radius = random.whole(1, std::int64_t{1} << 20);
        c.radius2 = radius * radius;
        c.start = {random.whole(1, 2 * radius), random.whole(-radius, radius), random.whole(0, std::int64_t{1} << 24)};
        ASSERT_EQ(disagreement(c), "");
    }
}

TEST(Capsule, TangentRayTouchesInOneDepth) {
    const RaySpan beside_ball = span_of({{300, 400, 7000}, {0, 0, 0}, 250000});
    EXPECT_EQ(beside_ball.lo, 7000);
    EXPECT_EQ(beside_ball.hi, 7000);
    const RaySpan beside_cylinder = span_of({{-1000, 500, 7000}, {2000, 0, 0}, 250000});
    EXPECT_EQ(beside_cylinder.lo, 7000);
    EXPECT_EQ(beside_cylinder.hi, 7000);
    const RaySpan past = span_of({{-1000, 501, 7000}, {2000, 0, 0}, 250000});
    EXPECT_GT(past.lo, past.hi);
}

TEST(Capsule, SegmentAlongTheRayCoversFromBallToBall) {
    const RaySpan span = span_of({{30, 40, -100}, {0, 0, 1000}, 2500 + 144});
    EXPECT_EQ(span.lo, -112);
    EXPECT_EQ(span.hi, 912);
}

TEST(Capsule, RotatingTheAxesRotatesSpansAndNormalsToTheBit) {
    Random random(4);
    for (int i = 0; i < compute::test::repeated(100000); ++i) {
        const Case c = i % 2 == 0 ? any_case(random) : grazing_case(random);
        const Capsule k = capsule_of(c);
        // x -> y -> z -> x: the ray along z through (0, 0) becomes one along x, then along y.
        Capsule turned = k;
        turned.start_x = k.start_z, turned.start_y = k.start_x, turned.start_z = k.start_y;
        turned.along_x = k.along_z, turned.along_y = k.along_x, turned.along_z = k.along_y;
        const CapsuleRay a = capsule_from_ray(k, 2, 0, 0), b = capsule_from_ray(turned, 0, 0, 0);
        const RaySpan sa = capsule_span(a), sb = capsule_span(b);
        ASSERT_EQ(sa.lo, sb.lo);
        ASSERT_EQ(sa.hi, sb.hi);
        if (sa.lo > sa.hi || c.radius2 < 16) continue;  // on the axis itself there is no direction
        // The octahedral map is not symmetric in z, so the codes differ by its rounding; the directions agree.
        const Direction da = decode_normal(capsule_normal(a, 2, sa.lo, false)),
                        db = decode_normal(capsule_normal(b, 0, sb.lo, false));
        ASSERT_NEAR(da.x, db.y, 1.3e-4);
        ASSERT_NEAR(da.y, db.z, 1.3e-4);
        ASSERT_NEAR(da.z, db.x, 1.3e-4);
    }
}

TEST(Capsule, ReversedSegmentCoversTheSame) {
    Random random(5);
    for (int i = 0; i < compute::test::repeated(100000); ++i) {
        const Case c = grazing_case(random);
        Case reversed = c;
        for (std::size_t a = 0; a < 3; ++a) {
            reversed.start[a] = c.start[a] + c.along[a];
            reversed.along[a] = -c.along[a];
        }
        const RaySpan one = span_of(c), other = span_of(reversed);
        ASSERT_EQ(one.lo > one.hi, other.lo > other.hi) << disagreement(c) << disagreement(reversed);
        if (one.lo > one.hi) continue;
        ASSERT_EQ(one.lo, other.lo);
        ASSERT_EQ(one.hi, other.hi);
    }
}

// The direction from the ray's point to the nearest point of the axis, in long double. The kernel places that point on
// a grid of 2^-20 of the segment, so the error is the code's own (6.5e-5) plus that step as seen from the radius.
TEST(Capsule, NormalPointsAtTheAxis) {
    Random random(6);
    double worst = 0;
    int measured = 0;
    for (int i = 0; i < compute::test::repeated(400000); ++i) {
        const Case c = any_case(random);
        const CapsuleRay ray = capsule_from_ray(capsule_of(c), 2, 0, 0);
        const RaySpan span = capsule_span(ray);
        if (span.lo > span.hi) continue;
        for (const int depth : {span.lo, span.hi}) {
            const std::array<long double, 3> q{-static_cast<long double>(c.start[0]),
                                               -static_cast<long double>(c.start[1]),
                                               static_cast<long double>(depth - c.start[2])};
            long double dot = 0, length2 = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                dot += q[a] * static_cast<long double>(c.along[a]);
                length2 += static_cast<long double>(c.along[a]) * static_cast<long double>(c.along[a]);
            }
            const long double share = length2 > 0 ? std::clamp(dot / length2, 0.0L, 1.0L) : 0.0L;
            std::array<long double, 3> n{};
            long double distance2 = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                n[a] = share * static_cast<long double>(c.along[a]) - q[a];
                distance2 += n[a] * n[a];
            }
            const long double distance = std::sqrt(distance2);
            if (distance < 1) continue;  // no direction to speak of
            const Direction got = decode_normal(capsule_normal(ray, 2, depth, false));
            const long double cx = got.y * n[2] - got.z * n[1], cy = got.z * n[0] - got.x * n[2],
                              cz = got.x * n[1] - got.y * n[0];
            const auto angle = static_cast<double>(
                std::atan2(std::sqrt(cx * cx + cy * cy + cz * cz), got.x * n[0] + got.y * n[1] + got.z * n[2]));
            const auto step = static_cast<double>(std::sqrt(length2) / distance) * 0x1p-20;
            ASSERT_LE(angle, 6.5e-5 + 1.01 * step) << disagreement(c);
            worst = std::max(worst, angle - step);
            ++measured;
        }
    }
    RecordProperty("worst_angle_rad", std::to_string(worst));
    EXPECT_GT(measured, 1000);
}

TEST(WholeNumbers, WideProductEqualsTheCompilers) {
    Random random(7);
    for (int i = 0; i < compute::test::repeated(500000); ++i) {
        const std::uint64_t a = random.bits() >> random.whole(0, 63), b = random.bits() >> random.whole(0, 63);
        const Wide w = multiply_wide(a, b);
        const Uint128 expected = static_cast<Uint128>(a) * b;
        ASSERT_EQ(w.high, static_cast<std::uint64_t>(expected >> 64));
        ASSERT_EQ(w.low, static_cast<std::uint64_t>(expected));
    }
    const Wide largest = multiply_wide(~std::uint64_t{0}, ~std::uint64_t{0});
    EXPECT_EQ(largest.high, ~std::uint64_t{0} - 1);
    EXPECT_EQ(largest.low, 1u);
}

TEST(WholeNumbers, SquareRootIsTheLargestThatFits) {
    Random random(8);
    const auto check = [](std::int64_t k) {
        const std::int64_t root = whole_sqrt(k);
        ASSERT_TRUE(static_cast<Int128>(root) * root <= k && static_cast<Int128>(root + 1) * (root + 1) > k) << k;
    };
    for (std::int64_t k = 0; k < 5000; ++k) check(k);
    for (int i = 0; i < compute::test::repeated(300000); ++i) {
        const std::int64_t root = random.whole(0, (std::int64_t{1} << random.whole(1, 31)) - 1);
        check(root * root);
        if (root > 0) check(root * root - 1);
        check(std::abs(random.any_size(61)));
    }
    check((std::int64_t{1} << 62) - 1);
}

TEST(WholeNumbers, DivisionRoundsDown) {
    Random random(9);
    for (int i = 0; i < compute::test::repeated(200000); ++i) {
        const std::int64_t a = random.any_size(60);
        std::int64_t b = random.any_size(30);
        if (b == 0) b = 1;
        const std::int64_t q = divide_down(a, b);
        const Int128 rest = static_cast<Int128>(a) - static_cast<Int128>(q) * b;
        ASSERT_TRUE(rest == 0 || (rest > 0) == (b > 0));
        ASSERT_LT(rest < 0 ? -rest : rest, b < 0 ? -b : b);
    }
}

}  // namespace burin::shared

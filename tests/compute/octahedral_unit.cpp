// SPDX-License-Identifier: MIT
#include "shaders/shared/octahedral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/compute/effort.hpp"

namespace burin::shared {
namespace {

using compute::test::Random;
using compute::test::repeated;

double angle_between(const IntVector& v, const Direction& d) {
    const double x = static_cast<double>(v.x), y = static_cast<double>(v.y), z = static_cast<double>(v.z);
    const double cx = y * d.z - z * d.y, cy = z * d.x - x * d.z, cz = x * d.y - y * d.x;
    return std::atan2(std::sqrt(cx * cx + cy * cy + cz * cz), x * d.x + y * d.y + z * d.z);
}

IntVector any_vector(Random& random) {
    const int bits = random.small(2, 46);
    if (random.chance(0.7)) return {random.any_size(bits), random.any_size(bits), random.any_size(bits)};
    const std::int64_t limit = std::int64_t{1} << bits;
    return {random.whole(-limit, limit), random.whole(-limit, limit), random.whole(-limit, limit)};
}

}  // namespace

TEST(OctahedralNormal, StaysWithinItsAngle) {
    Random random(1);
    double worst = 0;
    for (int i = 0; i < compute::test::repeated(2000000); ++i) {
        const IntVector v = any_vector(random);
        if (v.x == 0 && v.y == 0 && v.z == 0) continue;
        worst = std::max(worst, angle_between(v, decode_normal(encode_normal(v))));
    }
    RecordProperty("worst_angle_rad", std::to_string(worst * 1e6) + "e-6");
    EXPECT_LE(worst, 6.5e-5);
    EXPECT_GE(worst, 2e-5);  // else the angle is not measured
}

TEST(OctahedralNormal, KeepsTheAxesExactly) {
    for (const std::int64_t length : {std::int64_t{1}, std::int64_t{77}, std::int64_t{1} << 46}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const std::int64_t sign : {1, -1}) {
                std::int64_t v[3] = {0, 0, 0};
                v[axis] = sign * length;
                const Direction d = decode_normal(encode_normal({v[0], v[1], v[2]}));
                EXPECT_EQ(d.x, axis == 0 ? static_cast<float>(sign) : 0.0f);
                EXPECT_EQ(d.y, axis == 1 ? static_cast<float>(sign) : 0.0f);
                EXPECT_EQ(d.z, axis == 2 ? static_cast<float>(sign) : 0.0f);
            }
        }
    }
}

TEST(OctahedralNormal, MirroredVectorsGiveMirroredDirections) {
    Random random(2);
    for (int i = 0; i < compute::test::repeated(300000); ++i) {
        const IntVector v = any_vector(random);
        const Direction d = decode_normal(encode_normal(v));
        const Direction x = decode_normal(encode_normal({-v.x, v.y, v.z}));
        const Direction y = decode_normal(encode_normal({v.x, -v.y, v.z}));
        ASSERT_TRUE(v.x == 0 || (x.x == -d.x && x.y == d.y && x.z == d.z)) << v.x << ' ' << v.y << ' ' << v.z;
        ASSERT_TRUE(v.y == 0 || (y.x == d.x && y.y == -d.y && y.z == d.z)) << v.x << ' ' << v.y << ' ' << v.z;
    }
}

TEST(OctahedralNormal, EveryCodeDecodesToAUnitVector) {
    Random random(3);
    for (int i = 0; i < compute::test::repeated(300000); ++i) {
        const Direction d = decode_normal(static_cast<uint>(random.bits()));
        ASSERT_NEAR(d.x * d.x + d.y * d.y + d.z * d.z, 1.0f, 1e-6f);
    }
}

TEST(OctahedralNormal, ZeroVectorPointsUpAlongZ) {
    const Direction d = decode_normal(encode_normal({0, 0, 0}));
    EXPECT_EQ(d.x, 0.0f);
    EXPECT_EQ(d.y, 0.0f);
    EXPECT_EQ(d.z, 1.0f);
}

TEST(OctahedralNormal, OppositeOfOppositeIsTheSameCode) {
    Random random(4);
    for (int i = 0; i < compute::test::repeated(2000000); ++i) {
        const IntVector v = any_vector(random);
        const uint code = encode_normal(v), opposite = opposite_normal(code);
        ASSERT_EQ(opposite_normal(opposite), code) << v.x << ' ' << v.y << ' ' << v.z;
        const Direction d = decode_normal(code), o = decode_normal(opposite);
        ASSERT_LE(std::abs(o.x + d.x) + std::abs(o.y + d.y) + std::abs(o.z + d.z), 1e-6f);
        const IntVector turned{-v.x, -v.y, -v.z};
        const bool zero = v.x == 0 && v.y == 0 && v.z == 0;
        ASSERT_TRUE(v.z == 0 || opposite == encode_normal(turned)) << v.x << ' ' << v.y << ' ' << v.z;
        ASSERT_TRUE(zero || angle_between(turned, o) <= 6.5e-5);
    }
}

// The border of the square, where two codes stand for one direction, and the equator.
TEST(OctahedralNormal, OppositesOfDirectionsWithZerosComeBack) {
    Random random(5);
    for (int i = 0; i < compute::test::repeated(300000); ++i) {
        std::int64_t part[3] = {random.any_size(40), random.any_size(40), random.any_size(40)};
        part[random.small(0, 2)] = 0;
        if (random.chance(0.3)) part[random.small(0, 2)] = 0;
        const uint code = encode_normal({part[0], part[1], part[2]});
        ASSERT_EQ(opposite_normal(opposite_normal(code)), code) << part[0] << ' ' << part[1] << ' ' << part[2];
    }
}

}  // namespace burin::shared

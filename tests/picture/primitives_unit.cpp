// SPDX-License-Identifier: MIT
#include "picture/primitives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shaders/shared/octahedral.h"

namespace burin::picture {

namespace {

Vec3 position(const Primitives& p, std::uint32_t i) {
    const shared::SurfaceVertex& v = p.vertices[p.indices[i]];
    return {v.x, v.y, v.z};
}

Vec3 normal(const Primitives& p, std::uint32_t i) {
    const shared::Direction d = shared::decode_normal(p.vertices[p.indices[i]].normal);
    return {d.x, d.y, d.z};
}

// By the divergence theorem; positive when triangles wind counter-clockwise seen from outside.
double volume(const Primitives& p, const PrimitiveRange& range) {
    double sum = 0.0;
    for (std::uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
        sum += glm::dot(position(p, i), glm::cross(position(p, i + 1), position(p, i + 2))) / 6.0;
    }
    return sum;
}

}  // namespace

TEST(Primitives, HaveTheVolumesOfTheirShapes) {
    const Primitives p = make_primitives();
    EXPECT_NEAR(volume(p, p.balls.back()), 4.0 / 3.0 * std::numbers::pi, 0.01);
    EXPECT_NEAR(volume(p, p.cube), 1.0, 1e-6);
    // Its foot is open, and stands in the plane y = -1: a third of pi is missing from the integral.
    EXPECT_NEAR(volume(p, p.plinth), 2.0 / 3.0 * std::numbers::pi, 0.02);
    EXPECT_GT(volume(p, p.stylus), 0.0);
    // Open at z = 1: a third of pi is missing.
    EXPECT_NEAR(volume(p, p.rod), 2.0 / 3.0 * std::numbers::pi, 0.02);
    EXPECT_NEAR(volume(p, p.cone), std::numbers::pi / 3.0, 0.01);
    EXPECT_NEAR(volume(p, p.ring), 2.0 * std::numbers::pi * std::numbers::pi * kRingThickness * kRingThickness, 0.005);
}

TEST(Primitives, HaveNormalsOnTheSideThatTheTrianglesFace) {
    const Primitives p = make_primitives();
    for (const PrimitiveRange& range : {p.balls[0], p.balls[1], p.balls[2], p.balls[3], p.cube, p.stylus, p.rod, p.cone,
                                        p.ring, p.plinth, p.screen_quad}) {
        ASSERT_GT(range.index_count, 0u);
        for (std::uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
            const Vec3 a = position(p, i);
            const Vec3 faces = glm::cross(position(p, i + 1) - a, position(p, i + 2) - a);
            if (glm::length(faces) < 1e-9) continue;  // at the poles
            const Vec3 mean = normal(p, i) + normal(p, i + 1) + normal(p, i + 2);
            EXPECT_GT(glm::dot(faces, mean), 0.0) << "at index " << i;
        }
    }
}

}  // namespace burin::picture

// SPDX-License-Identifier: MIT
// The balls in which tools that are no balls smooth fill them.
#include "compute/tools/smooth_cover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/compute/effort.hpp"

namespace burin::compute::test {
namespace {

bool is_covered(const SmoothCover& cover, const Vec3& p) {
    for (const Vec3& middle : cover.middles_m)
        if (glm::length(p - middle) <= cover.radius_m) return true;
    return false;
}

}  // namespace

TEST(SmoothCover, OfABallIsTheBall) {
    const SmoothCover cover = smooth_cover(BallTool{0.7});
    ASSERT_EQ(cover.middles_m.size(), 1u);
    EXPECT_EQ(cover.middles_m[0], Vec3(0.0));
    EXPECT_EQ(cover.radius_m, 0.7);
}

// All of a mill but its rim, all of a box but its edges, is in a ball; and no ball stands far out of the tool.
TEST(SmoothCover, FillsToolsOfAnyProportions) {
    Random random(3);
    for (int i = 0; i < 300; ++i) {
        const double radius = std::pow(10.0, random.between(-1.0, 1.0)),
                     length = std::pow(10.0, random.between(-1.0, 1.0));
        const SmoothCover cover = smooth_cover(CylinderTool{radius, length});
        ASSERT_LE(cover.middles_m.size(), static_cast<std::size_t>(kMostSmoothBalls));
        ASSERT_FALSE(cover.middles_m.empty());
        for (int k = 0; k < 100; ++k) {
            const double angle = random.between(0.0, 6.2831853),
                         out = 0.8 * radius * std::sqrt(random.between(0.0, 1.0));
            const double height = length * random.between(0.1, 0.9);
            ASSERT_TRUE(is_covered(cover, {out * std::cos(angle), height, out * std::sin(angle)}))
                << radius << " " << length;
        }
        for (const Vec3& middle : cover.middles_m) {
            EXPECT_LE(std::hypot(middle.x, middle.z), radius);
            EXPECT_GE(middle.y, 0.0);
            EXPECT_LE(middle.y, length);
        }
        const double x = std::pow(10.0, random.between(-1.0, 1.0));
        const SmoothCover box = smooth_cover(BoxTool{{x, radius, length}});
        ASSERT_LE(box.middles_m.size(), static_cast<std::size_t>(kMostSmoothBalls));
        for (int k = 0; k < 100; ++k) {
            const double a = random.between(-0.7, 0.7), b = random.between(-0.7, 0.7), c = random.between(-0.7, 0.7);
            ASSERT_TRUE(is_covered(box, {a * x, b * radius, c * length})) << x << " " << radius << " " << length;
        }
    }
}

TEST(SmoothCover, OfAMeshWithoutThicknessEnds) {
    auto flat = std::make_shared<geometry::TriangleMesh>();
    flat->positions_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    flat->triangles = {{0, 1, 2}, {0, 2, 1}};
    const SmoothCover cover = smooth_cover(MeshTool{flat});
    EXPECT_LE(cover.middles_m.size(), static_cast<std::size_t>(kMostSmoothBalls));
    EXPECT_GT(cover.radius_m, 0.0);
}

}  // namespace burin::compute::test

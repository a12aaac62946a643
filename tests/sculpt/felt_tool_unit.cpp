// SPDX-License-Identifier: MIT
#include "sculpt/felt_tool.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "haptics/contact/separation.hpp"
#include "sculpt/tool_mesh.hpp"
#include "tests/compute/effort.hpp"

namespace burin::sculpt {
namespace {

double area_of(const haptics::ToolSurface& surface) {
    double sum_m2 = 0.0;
    for (std::uint32_t i = 0; i < surface.count; ++i) sum_m2 += static_cast<double>(surface.samples[i].area_m2);
    return sum_m2;
}

}  // namespace

TEST(FeltTool, ABallTouchesAsItIsInAnySize) {
    for (const double radius_m : {0.0, 1e-4, 0.003, 2.0}) {
        const FeltTool felt = felt_tool(compute::BallTool{radius_m});
        EXPECT_EQ(felt.probe.count, 1u);
        EXPECT_FALSE(felt.shape.touches());
        EXPECT_EQ(felt.probe.points[0].radius_m, radius_m);
        const double sphere_m2 = 4.0 * std::numbers::pi * radius_m * radius_m;
        EXPECT_NEAR(area_of(felt.surface), sphere_m2, 0.01 * sphere_m2);
        EXPECT_NEAR(felt.surface.size_m, radius_m, 1e-12);
    }
}

TEST(FeltTool, TheSamplesOfEachShapeHaveItsArea) {
    const double pi = std::numbers::pi;
    EXPECT_NEAR(area_of(felt_tool(compute::CylinderTool{0.002, 0.01}).surface), pi * (2 * 0.004 * 0.01 / 2 + 2 * 4e-6),
                0.01 * 1.5e-4);
    EXPECT_NEAR(area_of(felt_tool(compute::BoxTool{{0.002, 0.003, 0.004}}).surface), 8.0 * (6e-6 + 12e-6 + 8e-6), 1e-9);
    const double slant = std::hypot(0.003, 0.008);
    EXPECT_NEAR(area_of(felt_tool(compute::ConeTool{0.0, 0.003, 0.008}).surface), pi * (0.003 * slant + 9e-6),
                0.01 * 1.1e-4);
}

// What is felt of a tool, against the tool's own shape in closed form: the place of the felt surface farthest along a
// direction, and that of the tool.
TEST(FeltTool, IsFeltAsItIsToWithinATwentiethOfItsWidth) {
    const auto reaches = [](const haptics::ToolShape& shape, const Vec3& along) {
        double most = -HUGE_VAL;
        for (std::uint32_t i = 0; i < shape.piece_count; ++i)
            most = std::max(most, -haptics::lowest(shape, shape.pieces[i], -along));
        return most + shape.rounding_m;
    };
    const auto of_cylinder = [](double radius_m, double length_m, const Vec3& n) {
        return radius_m * std::hypot(n.x, n.z) + std::max(0.0, n.y * length_m);
    };
    compute::test::Random random(5);
    for (int i = 0; i < compute::test::repeated(32); ++i) {
        const double radius_m = random.between(0.001, 0.005), length_m = random.between(0.001, 0.02);
        const FeltTool mill = felt_tool(compute::CylinderTool{radius_m, length_m});
        const Vec3 half(random.between(0.0005, 0.005), random.between(0.0005, 0.005), random.between(0.0005, 0.005));
        const FeltTool box = felt_tool(compute::BoxTool{half});
        const double corner_m = random.between(0.1, 0.9) * radius_m;
        const FeltTool bull = felt_tool(compute::BullNoseTool{radius_m, corner_m, length_m + corner_m});
        const double tip_m = random.between(0.0, 0.5) * radius_m;
        const FeltTool cone = felt_tool(compute::ConeTool{tip_m, radius_m, length_m});
        for (int k = 0; k < 200; ++k) {
            const Vec3 n = glm::normalize(Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
            const double width_m = std::min(2.0 * radius_m, length_m);
            EXPECT_NEAR(reaches(mill.shape, n), of_cylinder(radius_m, length_m, n), 0.05 * width_m);
            EXPECT_NEAR(reaches(box.shape, n), glm::dot(glm::abs(n), half), 0.1 * std::min({half.x, half.y, half.z}));
            const double across = std::hypot(n.x, n.z);
            const double nose = std::max({(radius_m - corner_m) * across - corner_m * -n.y + corner_m,
                                          radius_m * across + n.y * (length_m + corner_m)});
            EXPECT_NEAR(reaches(bull.shape, n), n.y > 0.0 ? radius_m * across + n.y * (length_m + corner_m) : nose,
                        0.05 * std::min(2.0 * radius_m, length_m + corner_m));
            const double pointed = std::max(tip_m * across, radius_m * across + n.y * length_m);
            EXPECT_NEAR(reaches(cone.shape, n), pointed, std::max(0.05 * width_m, cone.differs_m));
        }
        EXPECT_LE(mill.differs_m, 0.05 * std::min(2.0 * radius_m, length_m));
        EXPECT_LE(box.differs_m, 0.1 * std::min({half.x, half.y, half.z}));
    }
}

TEST(ToolMesh, ReachesAsFarAsTheShapeAndIsAsWide) {
    EXPECT_DOUBLE_EQ(size_of(compute::BullNoseTool{0.005, 0.001, 0.02}), 0.005);
    EXPECT_DOUBLE_EQ(size_of(compute::CylinderTool{0.005, 0.002}), 0.001);
    EXPECT_DOUBLE_EQ(reach_of(compute::BallTool{0.007}), 0.007);
    for (const compute::ToolShape& shape : {compute::ToolShape(compute::ConeTool{0.001, 0.004, 0.01}),
                                            compute::ToolShape(compute::BoxTool{Vec3(0.003)})}) {
        double farthest = 0.0;
        for (const Vec3& p : mesh_of(shape).positions_m) farthest = std::max(farthest, glm::length(p));
        EXPECT_LE(farthest, reach_of(shape) * (1.0 + 1e-12));
        EXPECT_GT(farthest, 0.9 * reach_of(shape));
    }
}

}  // namespace burin::sculpt

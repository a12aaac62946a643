// SPDX-License-Identifier: MIT
#include "toolbox/felt_tool.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "toolbox/tool_mesh.hpp"

namespace burin::toolbox {
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

}  // namespace burin::toolbox

// SPDX-License-Identifier: MIT
// The distance of a tool's convex piece from a triangle, against alternating projections onto both, which know no
// simplex.
#include "haptics/contact/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "haptics/contact/tool_sides.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/turned_tools.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::haptics {
namespace {

using compute::test::Random;

Vec3 any_place(Random& random, double most) {
    return {random.between(-most, most), random.between(-most, most), random.between(-most, most)};
}

// What a separation promises: the plane is between both, and its gap is the distance.
void check(const test::KnownTool& tool, Random& random, int& apart, int& together) {
    const ToolShape& shape = tool.shape;
    const double size = std::pow(10.0, random.between(-2.0, 0.5));
    const Vec3 middle = any_place(random, 1.5);
    const geometry::Triangle t{middle + any_place(random, size), middle + any_place(random, size),
                               middle + any_place(random, size)};
    if (geometry::is_degenerate(t)) return;
    const Vec3 at = any_place(random, 0.2);
    const geometry::Triangle moved{t.a - at, t.b - at, t.c - at};
    const double distance = test::distance_by_projections(moved, tool.onto_hull);
    constexpr double kTolerance = 1e-6;
    const Separation found = separation(shape, shape.pieces[0], t, {at, -middle, HUGE_VAL, kTolerance});
    if (found.overlaps) {
        ++together;
        ASSERT_LT(distance, 1e-3);  // projections onto what just touches converge slowly
        return;
    }
    ++apart;
    ASSERT_LE(found.gap_m, distance + 1e-9);
    ASSERT_GE(found.gap_m, distance - 1e-4 * (1.0 + distance)) << found.supports;
    ASSERT_NEAR(glm::length(found.normal), 1.0, 1e-12);
    const double lowest_of_piece = lowest(shape, shape.pieces[0], found.normal) + glm::dot(found.normal, at);
    for (const Vec3& corner : {t.a, t.b, t.c})
        ASSERT_GE(lowest_of_piece - glm::dot(found.normal, corner), found.gap_m - 1e-12);
}

}  // namespace

TEST(Separation, IsTheDistanceOfABoxFromATriangle) {
    Random random(1);
    int apart = 0, together = 0;
    for (int i = 0; i < compute::test::repeated(20'000); ++i) {
        const Vec3 half(random.between(0.05, 0.5), random.between(0.05, 0.5), random.between(0.05, 0.5));
        check(test::box_tool(half), random, apart, together);
        if (HasFatalFailure()) FAIL() << i;
    }
    EXPECT_GT(apart, compute::test::repeated(20'000) / 4);
    EXPECT_GT(together, compute::test::repeated(20'000) / 50);
}

TEST(Separation, IsTheDistanceOfACylinderFromATriangle) {
    Random random(2);
    int apart = 0, together = 0;
    for (int i = 0; i < compute::test::repeated(20'000); ++i) {
        check(test::cylinder_tool(random.between(0.05, 0.5), random.between(0.1, 1.0)), random, apart, together);
        if (HasFatalFailure()) FAIL() << i;
    }
    EXPECT_GT(apart, compute::test::repeated(20'000) / 4);
    EXPECT_GT(together, compute::test::repeated(20'000) / 50);
}

// No side tells more than there is, neither where the tool is nor after a straight way.
TEST(Separation, IsNeverLessThanWhatASideOfTheToolTells) {
    Random random(3);
    int told = 0, exact = 0, apart = 0;
    const std::vector<compute::ToolShape> tools{compute::CylinderTool{0.3, 0.9}, compute::ConeTool{0.1, 0.5, 1.2},
                                                compute::ConeTool{0.4, 0.1, 0.5}, compute::BullNoseTool{0.5, 0.2, 1.0},
                                                compute::BoxTool{{0.2, 0.3, 0.5}}};
    std::vector<ToolShape> shapes;
    for (const compute::ToolShape& tool : tools) shapes.push_back(toolbox::felt_tool(tool).shape);
    for (int i = 0; i < compute::test::repeated(40'000); ++i) {
        const ToolShape& shape = shapes[static_cast<std::size_t>(i) % shapes.size()];
        ASSERT_GT(shape.side_count, 0u);
        const double size = std::pow(10.0, random.between(-2.0, 0.5));
        const Vec3 middle = any_place(random, 1.5), at = any_place(random, 0.2);
        // Each third is one place, as a vertex of a fine surface is.
        const auto corner = [&] { return i % 3 == 0 ? middle : middle + any_place(random, size); };
        const geometry::Triangle t{corner(), corner(), corner()};
        const SideGap side = side_gap(shape, t, at);
        ASSERT_GE(side.gap_m, side.plane_gap_m - 1e-12);
        const Vec3 step = any_place(random, 0.3);
        for (const Vec3& way : {Vec3(0.0), step}) {
            const Separation found =
                separation(shape, shape.pieces[0], t, {at + way, at + way - middle, HUGE_VAL, 1e-6});
            const double gap = found.overlaps ? 0.0 : found.gap_m;
            const double bound = way == Vec3(0.0) ? side.gap_m : side.plane_gap_m - glm::dot(side.normal, way);
            ASSERT_LE(bound, gap + 2e-6) << i;
            if (way != Vec3(0.0) || !(gap > 0.0)) continue;
            ++apart;
            told += bound > 0.0 ? 1 : 0;
            exact += bound > gap - 1e-5 ? 1 : 0;
        }
    }
    EXPECT_GT(told, apart * 9 / 10);
    EXPECT_GT(exact, apart / 5);
}

}  // namespace burin::haptics

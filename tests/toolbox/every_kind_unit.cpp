// SPDX-License-Identifier: MIT
// Each kind of tool: what is drawn of it, what is felt of it and the numbers that stand for it are of one shape. The
// kinds come from the table, so that a new one is judged here with its row alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_health.hpp"
#include "haptics/contact/separation.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/session_tools.hpp"
#include "toolbox/felt_tool.hpp"
#include "toolbox/tool_kinds.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::toolbox {
namespace {

struct KindExample {
    std::string name;
    compute::ToolShape shape;
};

// One tool of each kind in each of two sizes, a hundred times apart. A kind of a file is a bar of six sides: convex,
// as all kinds are that have sizes.
std::vector<KindExample> example_of_each_kind() {
    std::vector<KindExample> all;
    for (const ToolDescriptor& kind : tool_kinds())
        for (const double width_m : {0.0005, 0.05}) {
            const std::string name = std::string(kind.name) + " of " + std::to_string(width_m) + " m";
            if (!kind.on_panel()) {
                all.push_back({name, compute::MeshTool{std::make_shared<geometry::TriangleMesh>(
                                         haptics::test::six_sided_bar(width_m, 4.0 * width_m))}});
                continue;
            }
            ToolSpec tool{kind.kind, {}, {}};
            for (std::size_t i = 0; i < kind.used_sizes().size(); ++i) tool.sizes_m[i] = width_m * kind.proportions[i];
            const auto shape = make_shape(tool);
            EXPECT_TRUE(shape) << kind.name;
            if (shape) all.push_back({name, *shape});
        }
    return all;
}

// How far a mesh of flats in 32 parts around lies inside the round shape that it stands for, of its radius: 0.5 %.
const double kChord = 1.0 - std::cos(std::numbers::pi / 32.0);

double reach_along(const geometry::TriangleMesh& mesh, const Vec3& along) {
    double most = -HUGE_VAL;
    for (const Vec3& p : mesh.positions_m) most = std::max(most, glm::dot(p, along));
    return most;
}

double felt_reach_along(const FeltTool& felt, const Vec3& along) {
    if (!felt.shape.touches()) return felt.probe.points[0].radius_m;
    double most = -HUGE_VAL;
    for (std::uint32_t i = 0; i < felt.shape.piece_count; ++i)
        most = std::max(most, -haptics::lowest(felt.shape, felt.shape.pieces[i], -along));
    return most + felt.shape.rounding_m;
}

}  // namespace

TEST(EveryKindOfTool, HasBoundsThatJustHoldWhatIsDrawnAndMeasured) {
    for (const auto& [name, shape] : example_of_each_kind()) {
        const Box bounds = bounds_of(shape);
        const double rounding_m = 1e-12 * glm::length(bounds.extent());  // of sines and cosines
        for (const geometry::TriangleMesh& mesh : {drawing_of(shape), mesh_of(shape)}) {
            ASSERT_FALSE(mesh.triangles.empty()) << name;
            for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
                EXPECT_NEAR(reach_along(mesh, along), glm::dot(along, bounds.hi), rounding_m) << name;
                EXPECT_NEAR(-reach_along(mesh, -along), glm::dot(along, bounds.lo), rounding_m) << name;
            }
            for (const Vec3& p : mesh.positions_m) ASSERT_LE(glm::length(p), reach_of(shape) + rounding_m) << name;
        }
    }
}

TEST(EveryKindOfTool, IsDrawnAndFeltWithTheSameVolumeOnItsOuterSide) {
    for (const auto& [name, shape] : example_of_each_kind()) {
        const double drawn_m3 = geometry::examine(drawing_of(shape)).signed_volume_m3;
        const double felt_m3 = geometry::examine(mesh_of(shape)).signed_volume_m3;
        EXPECT_GT(drawn_m3, 0.0) << name << " is turned inside out";
        // The areas of polygons of 48 and 32 sides in one circle differ by 0.4 %; a ball's heights are the same.
        EXPECT_NEAR(felt_m3, drawn_m3, 0.004 * drawn_m3) << name;
    }
}

// A twentieth of the width is the promise of what is felt (FeltShape.IsFeltAsItIsToWithinATwentiethOfItsWidth); a sharp
// tip loses what its rounding takes, which `differs_m` says and a fifth of the width bounds.
TEST(EveryKindOfTool, IsFeltWhereItIsDrawn) {
    compute::test::Random random(11);
    for (const auto& [name, shape] : example_of_each_kind()) {
        const FeltTool felt = felt_tool(shape);
        const geometry::TriangleMesh drawn = drawing_of(shape);
        const double width_m = 2.0 * size_of(shape), chord_m = kChord * reach_of(shape);
        const double tip_m = std::max(0.05 * width_m, felt.differs_m);
        EXPECT_LE(felt.differs_m, 0.2 * width_m) << name;
        for (int k = 0; k < 500; ++k) {
            const Vec3 n = glm::normalize(Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
            EXPECT_NEAR(felt_reach_along(felt, n), reach_along(drawn, n), tip_m + chord_m) << name;
        }
        EXPECT_GT(felt.surface.count, 0u) << name << " does not cut";
        if (!felt.shape.touches()) continue;
        for (const Vec3& p : drawn.positions_m) {
            double nearest_m = HUGE_VAL;
            for (std::uint32_t i = 0; i < felt.shape.piece_count; ++i) {
                const haptics::Separation found =
                    haptics::separation(felt.shape, felt.shape.pieces[i], {p, p, p},
                                        {Vec3(0.0), felt.shape.inside_m - p, HUGE_VAL, 1e-6 * width_m});
                ASSERT_FALSE(found.overlaps) << name << ": a drawn corner lies in the hull, below the rounding";
                nearest_m = std::min(nearest_m, found.gap_m - felt.shape.rounding_m);
            }
            EXPECT_LE(std::abs(nearest_m), tip_m + chord_m) << name;
        }
    }
}

TEST(EveryKindOfTool, IsFeltWithinItsBoundsAndWithoutALostCorner) {
    for (const auto& [name, shape] : example_of_each_kind()) {
        const FeltTool felt = felt_tool(shape);
        if (!felt.shape.touches()) {
            EXPECT_EQ(felt.probe.count, 1u) << name << " is felt as nothing";
            continue;
        }
        const Box bounds = bounds_of(shape);
        EXPECT_TRUE(glm::all(glm::greaterThan(felt.shape.bounds.lo, bounds.lo))) << name;
        EXPECT_TRUE(glm::all(glm::lessThan(felt.shape.bounds.hi, bounds.hi))) << name;
        EXPECT_LT(felt.shape.reach_m, reach_of(shape)) << name;
        ASSERT_LE(felt.shape.piece_count, haptics::ToolShape::kMostPieces) << name;
        std::uint32_t corners = 0;
        for (std::uint32_t i = 0; i < felt.shape.piece_count; ++i) {
            EXPECT_EQ(felt.shape.pieces[i].first, corners) << name;
            corners += felt.shape.pieces[i].count;
        }
        // A hull of more corners is thinned (tool_shape.hpp): none of these needs to be.
        EXPECT_LT(corners, haptics::ToolShape::kMostCorners) << name;
    }
}

}  // namespace burin::toolbox

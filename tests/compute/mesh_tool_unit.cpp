// SPDX-License-Identifier: MIT
// Mesh tools against closed forms of the same shapes, against dense stamps, and against scan conversion.
#include "compute/tools/mesh_tool.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "compute/engine/engine.hpp"
#include "compute/rays/scan_convert.hpp"
#include "compute/rays/set_algebra.hpp"
#include "compute/tools/apply.hpp"
#include "compute/tools/tool_spans.hpp"
#include "tests/compute/test_meshes.hpp"
#include "tests/compute/tool_reference.hpp"

namespace burin::compute::test {
namespace {

using RaysByNumber = std::map<std::uint32_t, std::vector<shared::DexelEnd>>;

WorkerPool& tool_pool() {
    static WorkerPool two(2);
    return two;
}

MeshTool tool_of(geometry::TriangleMesh mesh) {
    auto prepared = prepare_mesh_tool(std::make_shared<geometry::TriangleMesh>(std::move(mesh)));
    EXPECT_TRUE(prepared) << prepared.error().line();
    return prepared ? *prepared : MeshTool{};
}

RaysByNumber spans(const Solid& solid, const ToolSweep& sweep) {
    RaysByNumber rays;
    const auto batch = tool_spans(solid, sweep, tool_pool());
    EXPECT_TRUE(batch) << batch.error().line();
    if (!batch) return rays;
    for (const RayBatch::Ray& ray : batch->rays) {
        const auto ends = batch->ends_of(ray);
        rays[ray.code].assign(ends.begin(), ends.end());
    }
    return rays;
}

double length_of(RayEnds ends) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ends.size(); i += 2) sum += depth_of(ends[i + 1]) - depth_of(ends[i]);
    return sum;
}

double length_of(const RaysByNumber& rays) {
    double sum = 0.0;
    for (const auto& [code, ends] : rays) sum += length_of(ends);
    return sum;
}

// What of `a` is not in `b`, all rays together.
double rest_of(const RaysByNumber& a, const RaysByNumber& b) {
    double sum = 0.0;
    for (const auto& [code, ends] : a) {
        const auto found = b.find(code);
        std::vector<shared::DexelEnd> rest;
        append_difference(ends, found == b.end() ? RayEnds{} : RayEnds(found->second), rest);
        sum += length_of(rest);
    }
    return sum;
}

void expect_alike(const RaysByNumber& a, const RaysByNumber& b, double share) {
    ASSERT_GT(length_of(a), 0.0);
    EXPECT_LE(rest_of(a, b), share * length_of(a));
    EXPECT_LE(rest_of(b, a), share * length_of(a));
}

ToolSweep any_sweep(Random& random, ToolShape shape, bool turns) {
    const auto anywhere = [&] {
        return Vec3(random.between(0.2, 0.8), random.between(0.2, 0.8), random.between(0.2, 0.8));
    };
    ToolSweep sweep{std::move(shape), {anywhere(), any_orientation(random)}, {}};
    sweep.end = {random.chance(0.2) ? sweep.start.position_m : anywhere(),
                 turns ? any_orientation(random) : sweep.start.orientation};
    return sweep;
}

// Two boxes that overlap, with a notch between them: what a sweep fills of the notch depends on its direction.
struct Angle {
    geometry::TriangleMesh mesh = joined(box_mesh(Vec3(-0.15, -0.05, -0.05), Vec3(0.15, 0.05, 0.05), 2),
                                         box_mesh(Vec3(-0.15, -0.05, -0.05), Vec3(-0.05, 0.2, 0.05), 2));
    BoxTool foot{Vec3(0.15, 0.05, 0.05)}, leg{Vec3(0.05, 0.125, 0.05)};
    Vec3 leg_middle{-0.1, 0.075, 0.0};
};

}  // namespace

TEST(MeshTool, ABoxMeshSweepsWhatABoxSweeps) {
    const Solid solid = *make_block(Vec3(1), 64, {"cube", {}});
    Random random(1);
    for (int i = 0; i < repeated(40); ++i) {
        const Vec3 half(random.between(0.02, 0.2), random.between(0.02, 0.2), random.between(0.02, 0.2));
        const ToolSweep box = any_sweep(random, BoxTool{half}, i % 4 == 3);
        ToolSweep mesh = box;
        mesh.shape = tool_of(box_mesh(-half, half, random.small(1, 4)));
        // Corners are rounded to whole units: of a box some thousands of units wide, a part in a thousand at most.
        expect_alike(spans(solid, box), spans(solid, mesh), 2e-3);
    }
}

TEST(MeshTool, AHollowShapeSweepsTheUnionOfItsParts) {
    const Solid solid = *make_block(Vec3(1), 64, {"cube", {}});
    Random random(2);
    const Angle angle;
    const MeshTool tool = tool_of(angle.mesh);
    for (int i = 0; i < repeated(30); ++i) {
        const ToolSweep mesh = any_sweep(random, tool, false);
        ToolSweep foot = mesh, leg = mesh;
        foot.shape = angle.foot;
        leg.shape = angle.leg;
        for (Pose* pose : {&leg.start, &leg.end}) pose->position_m = *pose * angle.leg_middle;
        RaysByNumber both = spans(solid, foot);
        for (const auto& [code, ends] : spans(solid, leg)) {
            std::vector<shared::DexelEnd> united;
            append_union(both[code], ends, united);
            both[code] = united;
        }
        expect_alike(both, spans(solid, mesh), 2e-3);
    }
}

TEST(MeshTool, ASweepHoldsEveryStampOnItsWay) {
    const Solid solid = *make_block(Vec3(1), 48, {"cube", {}});
    Random random(3);
    const MeshTool tool = tool_of(Angle{}.mesh);
    for (int i = 0; i < repeated(12); ++i) {
        ToolSweep sweep = any_sweep(random, tool, i % 2 == 1);
        sweep.tolerance_cells = 0.05;
        const RaysByNumber swept = spans(solid, sweep);
        for (int k = 0; k <= 8; ++k) {
            ToolSweep stamp = sweep;
            stamp.start = stamp.end = pose_at(sweep, k / 8.0);
            const RaysByNumber stamped = spans(solid, stamp);
            // Turning, the surface may lie 0.05 cells inside; on a tool five cells thick that is a few hundredths.
            EXPECT_LE(rest_of(stamped, swept), (i % 2 == 1 ? 0.03 : 1e-3) * length_of(stamped));
        }
    }
}

TEST(MeshTool, APrismOfManySidesIsACylinder) {
    const Solid solid = *make_block(Vec3(1), 48, {"cube", {}});
    Random random(4);
    // The prism's axis is z; the cylinder's is y.
    geometry::TriangleMesh prism = prism_mesh(360, 0.1, 0.3);
    for (Vec3& p : prism.positions_m) p = {p.y, p.z, p.x};
    const MeshTool tool = tool_of(prism);
    for (int i = 0; i < repeated(12); ++i) {
        const ToolSweep cylinder = any_sweep(random, CylinderTool{0.1, 0.3}, false);
        ToolSweep mesh = cylinder;
        mesh.shape = tool;
        expect_alike(spans(solid, cylinder), spans(solid, mesh), 1e-3);
    }
}

TEST(MeshTool, AMeshTakesItsOwnScanConversionAwayToTheBit) {
    Random random(5);
    for (int i = 0; i < repeated(12); ++i) {
        geometry::TriangleMesh mesh = i % 2 == 0
                                          ? transformed(ball_mesh(0.5, 3), any_orientation(random), Vec3(0.1, 7, -2))
                                          : transformed(Angle{}.mesh, any_orientation(random), Vec3(-3, 0.2, 0));
        auto converted = scan_convert(mesh, random.small(16, 64), tool_pool());
        ASSERT_TRUE(converted) << converted.error().line();
        const auto engine = make_cpu_engine(std::move(converted->solid), tool_pool());
        const ToolSweep sweep{tool_of(mesh), {}, {}};
        ASSERT_TRUE(engine->carve({&sweep, 1}));
        for (const DexelSet& set : engine->solid().sets) {
            for (std::size_t r = 0; r < set.ray_count(); ++r) ASSERT_TRUE(set.ends(r).empty());
        }
    }
}

TEST(MeshTool, ManyMovesInBatchesCoverTheSame) {
    const Solid solid = *make_block(Vec3(1), 32, {"cube", {}});
    Random random(7);
    const MeshTool tool = tool_of(Angle{}.mesh);
    for (int i = 0; i < 6; ++i) {
        const auto moves =
            straight_moves(solid.lattice, any_sweep(random, tool, true), *extent_of(tool, solid.lattice.unit_m()));
        ASSERT_TRUE(moves);
        const auto at_once = mesh_spans(solid.lattice, tool, *moves, 0, tool_pool());
        const auto in_three = mesh_spans(solid.lattice, tool, *moves, 0, tool_pool(),
                                         (moves->size() + 2) / 3 * tool.mesh->triangles.size());
        ASSERT_TRUE(at_once && in_three);
        ASSERT_EQ(at_once->rays.size(), in_three->rays.size());
        for (std::size_t r = 0; r < at_once->rays.size(); ++r) {
            ASSERT_EQ(at_once->rays[r].code, in_three->rays[r].code);
            const auto a = at_once->ends_of(at_once->rays[r]), b = in_three->ends_of(in_three->rays[r]);
            ASSERT_EQ(a.size(), b.size());
            for (std::size_t e = 0; e < a.size(); ++e) ASSERT_EQ(depth_of(a[e]), depth_of(b[e]));
        }
    }
}

TEST(MeshTool, UnpreparedMeshesDoTheSame) {
    const Solid solid = *make_block(Vec3(1), 32, {"cube", {}});
    Random random(6);
    ToolSweep sweep = any_sweep(random, tool_of(Angle{}.mesh), true);
    const auto prepared = tool_spans(solid, sweep, tool_pool());
    std::get<MeshTool>(sweep.shape).edges = nullptr;
    const auto unprepared = tool_spans(solid, sweep, tool_pool());
    ASSERT_TRUE(prepared && unprepared);
    EXPECT_TRUE(same_ends(prepared->ends, unprepared->ends));
}

TEST(MeshTool, RefusesMeshesThatAreNoTools) {
    const auto refusal = [](geometry::TriangleMesh mesh) {
        const auto prepared = prepare_mesh_tool(std::make_shared<geometry::TriangleMesh>(std::move(mesh)));
        return prepared ? std::string() : prepared.error().line();
    };
    const geometry::TriangleMesh good = box_mesh(Vec3(0), Vec3(1), 2);
    EXPECT_EQ(refusal(good), "");
    geometry::TriangleMesh open = good;
    open.triangles.pop_back();
    EXPECT_NE(refusal(open).find("holes"), std::string::npos);
    geometry::TriangleMesh mixed = good;
    std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
    EXPECT_NE(refusal(mixed).find("outwards"), std::string::npos);
    EXPECT_NE(refusal(inverted(good)).find("inside out"), std::string::npos);
    geometry::TriangleMesh nan = good;
    nan.positions_m[2].z = NAN;
    EXPECT_NE(refusal(nan).find("finite"), std::string::npos);
    geometry::TriangleMesh dangling = good;
    dangling.triangles[0][0] = 1000;
    EXPECT_NE(refusal(dangling).find("does not exist"), std::string::npos);
    EXPECT_NE(refusal(geometry::TriangleMesh{}).find("no triangles"), std::string::npos);
    geometry::TriangleMesh stray = good;  // harmless, and not posed
    stray.positions_m.push_back(Vec3(1e300));
    EXPECT_EQ(refusal(stray), "");
    EXPECT_EQ(tool_of(stray).mesh->positions_m.size(), good.positions_m.size());
    geometry::TriangleMesh huge = good;
    for (Vec3& p : huge.positions_m) p *= 1e4;
    const ToolSweep sweep{tool_of(huge), {}, {}};
    EXPECT_FALSE(check_sweep(*make_block(Vec3(1), 32, {"cube", {}}), sweep));
}

}  // namespace burin::compute::test

// SPDX-License-Identifier: MIT
// Laws that hold for every tool, pose, motion and operation.
#include "compute/tools/apply.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/scan_convert.hpp"
#include "compute/rays/set_algebra.hpp"
#include "compute/tools/mesh_tool.hpp"
#include "tests/compute/mesh_topology.hpp"
#include "tests/compute/test_meshes.hpp"
#include "tests/compute/tool_reference.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::compute::test {
namespace {

WorkerPool& pool() {
    static WorkerPool two(2);
    return two;
}

// As many as property_cases.hpp says, and the same ones every time unless it says otherwise.
template <typename Law>
void for_random_cases(Law law) {
    const burin::test::PropertyCases cases = burin::test::property_cases();
    const std::uint64_t first = cases.seed * 1'000'000;
    for (std::uint64_t i = 0; i < cases.count && !testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE("case " + std::to_string(first + i));
        law(Random(first + i));
    }
}

Solid start_solid(int resolution) {
    Solid solid = *make_block(Vec3(1), resolution, {"block", {}});
    for (const char* name : {"cut", "filled", "painted"}) solid.materials.push_back({name, {}});
    return solid;
}

const MeshTool& star() {
    static const MeshTool tool = *prepare_mesh_tool(std::make_shared<geometry::TriangleMesh>(
        joined(ball_mesh(0.15, 2), box_mesh(Vec3(-0.3, -0.03, -0.04), Vec3(0.3, 0.02, 0.03), 2))));
    return tool;
}

// Sizes from far below a cell to several times the block; places in and around it; sometimes aligned with nodes, where
// faces coincide and rays are tangent.
ToolSweep any_sweep(Random& random, const Lattice& lattice, Operation operation) {
    ToolSweep sweep;
    const double size = random.chance(0.1) ? 0.01 * lattice.spacing_m : random.chance(0.1) ? 3.0 : 0.3;
    sweep.shape = random.chance(0.15) ? ToolShape(star()) : any_shape(random, 0.1 * size, size);
    const auto anywhere = [&] {
        const Vec3 p(random.between(-0.2, 1.2), random.between(-0.2, 1.2), random.between(-0.2, 1.2));
        if (!random.chance(0.3)) return p;
        return lattice.object_from_units(glm::round(lattice.units_from_object(p) / 4096.0) * 4096.0);
    };
    sweep.start = {anywhere(), random.chance(0.3) ? Quat(1, 0, 0, 0) : any_orientation(random)};
    sweep.end = {random.chance(0.3) ? sweep.start.position_m : anywhere(),
                 random.chance(0.7) ? sweep.start.orientation : any_orientation(random)};
    if (size > 1.0) sweep.end.orientation = sweep.start.orientation;  // turning that is another test's
    sweep.tolerance_cells = 0.5;
    sweep.operation = operation;
    sweep.material = static_cast<std::uint8_t>(1 + static_cast<int>(operation));
    return sweep;
}

// Calls f(held, place) for every ray.
template <typename F>
void for_each_ray(const Solid& solid, F f) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int v = 0; v < solid.lattice.rays_v(axis); ++v) {
            for (int u = 0; u < solid.lattice.rays_u(axis); ++u) {
                f(RayEnds(solid.sets[static_cast<std::size_t>(axis)].ends(u, v)), RayPlace{axis, u, v});
            }
        }
    }
}

RayEnds ends_of(const Solid& solid, const RayPlace& place) {
    return solid.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
}

bool covers(RayEnds whole, RayEnds part) {
    std::vector<shared::DexelEnd> rest;
    append_difference(part, whole, rest);
    return rest.empty();
}

CarveStats must_apply(CarvingEngine& engine, std::span<const ToolSweep> sweeps) {
    const auto stats = engine.carve(sweeps);
    EXPECT_TRUE(stats.has_value()) << stats.error().line();
    return stats.value_or(CarveStats{});
}

}  // namespace

TEST(Apply, KeepsTheSolidWellFormedAndItsVolumeOnTheRightSide) {
    for_random_cases([](Random random) {
        const auto engine = make_cpu_engine(start_solid(random.small(16, 40)), pool());
        for (int i = 0; i < 2; ++i) {
            const auto operation = static_cast<Operation>(random.small(0, 2));
            const ToolSweep sweep = any_sweep(random, engine->solid().lattice, operation);
            const Solid before = engine->solid();
            (void)engine->take_changes();
            const CarveStats stats = must_apply(*engine, {&sweep, 1});
            const Solid& after = engine->solid();
            ASSERT_TRUE(well_formed(after));
            std::uint64_t changed = 0;
            for_each_ray(before, [&](RayEnds was, const RayPlace& place) {
                const RayEnds is = ends_of(after, place);
                changed += same_ends(was, is) ? 0u : 1u;
                ASSERT_TRUE(operation != Operation::cut || covers(was, is));
                ASSERT_TRUE(operation != Operation::fill || covers(is, was));
                if (operation != Operation::paint) return;
                ASSERT_TRUE(was.size() == is.size());
                for (std::size_t e = 0; e < was.size(); ++e) {
                    ASSERT_TRUE(depth_of(was[e]) == depth_of(is[e]) && was[e].normal == is[e].normal);
                }
            });
            ASSERT_TRUE(stats.rays_changed == changed && stats.rays_touched >= changed);
            ASSERT_TRUE(engine->take_changes().rays.size() >= changed);
            must_apply(*engine, {&sweep, 1});
            ASSERT_TRUE(engine->solid().same_content(after));  // the same again does nothing
        }
    });
}

TEST(Apply, CutThenRefilledAtTheSamePlaceComesBackToTheBit) {
    for_random_cases([](Random random) {
        const auto engine = make_cpu_engine(start_solid(random.small(16, 40)), pool());
        ToolSweep cut = any_sweep(random, engine->solid().lattice, Operation::cut), fill = cut;
        fill.operation = Operation::fill;
        fill.material = 2;
        const Solid start = engine->solid();
        must_apply(*engine, {&cut, 1});
        const Solid carved = engine->solid();
        must_apply(*engine, {&fill, 1});
        for_each_ray(engine->solid(), [&](RayEnds held, const RayPlace& place) {
            ASSERT_TRUE(covers(held, ends_of(start, place)));  // nothing of the block is missing again
        });
        const Solid filled = engine->solid();
        must_apply(*engine, {&cut, 1});
        // The same depths as before; where a face of the block had coincided with the tool's, the tool's is there now.
        for_each_ray(engine->solid(), [&](RayEnds held, const RayPlace& place) {
            ASSERT_TRUE(covers(held, ends_of(carved, place)) && covers(ends_of(carved, place), held));
        });
        const Solid again = engine->solid();
        must_apply(*engine, {&fill, 1});
        ASSERT_TRUE(engine->solid().same_content(filled));
        must_apply(*engine, {&cut, 1});
        ASSERT_TRUE(engine->solid().same_content(again));
    });
}

TEST(Apply, OrderOfDisjointStrokesIsIrrelevantToTheBit) {
    for_random_cases([](Random random) {
        const Solid start = start_solid(random.small(24, 48));
        // One in each half, at least a cell apart.
        std::vector<ToolSweep> sweeps;
        for (const double middle : {0.25, 0.75}) {
            ToolSweep sweep = any_sweep(random, start.lattice, static_cast<Operation>(random.small(0, 2)));
            sweep.shape = any_shape(random, 0.02, 0.08);
            for (Pose* pose : {&sweep.start, &sweep.end}) {
                pose->position_m = Vec3(middle + random.between(-0.02, 0.02), random.unit(), random.unit());
            }
            sweeps.push_back(sweep);
        }
        const auto one = make_cpu_engine(start, pool()), other = make_cpu_engine(start, pool());
        must_apply(*one, sweeps);
        std::swap(sweeps[0], sweeps[1]);
        must_apply(*other, sweeps);
        ASSERT_TRUE(one->solid().same_content(other->solid()));
    });
}

TEST(Apply, ManySweepsAtOnceAreThemOneAfterTheOtherOnAnyNumberOfThreads) {
    for_random_cases([](Random random) {
        const Solid start = start_solid(random.small(16, 32));
        std::vector<ToolSweep> sweeps;
        for (int i = 0; i < 4; ++i) {
            sweeps.push_back(any_sweep(random, start.lattice, static_cast<Operation>(random.small(0, 2))));
        }
        WorkerPool five(5);
        const auto all = make_cpu_engine(start, five), each = make_cpu_engine(start, pool());
        const auto stats = all->carve(sweeps);
        ASSERT_TRUE(stats.has_value());
        CarveStats sum;
        for (const ToolSweep& sweep : sweeps) sum += must_apply(*each, {&sweep, 1});
        ASSERT_TRUE(all->solid().same_content(each->solid()));
    });
}

// A quarter turn about z takes node (i, j, k) to (C - j, i, k): x rays become y rays, y rays become x rays upside down.
TEST(Apply, AQuarterTurnCommutesWithCarving) {
    for_random_cases([](Random random) {
        const Solid start = start_solid(random.small(16, 40));
        const int cells = start.lattice.cells[0], deepest = cells * 4096;
        const Quat quarter(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
        const Pose turn{Vec3(1, 0, 0), quarter};  // the block onto itself
        ToolSweep sweep = any_sweep(random, start.lattice, random.chance(0.5) ? Operation::cut : Operation::fill);
        // Not with faces along the rays, which rounding may put on either side of them.
        if (sweep.start.orientation == Quat(1, 0, 0, 0)) sweep.start.orientation = sweep.end.orientation;
        if (sweep.start.orientation == Quat(1, 0, 0, 0)) return;
        ToolSweep turned = sweep;
        for (Pose* pose : {&turned.start, &turned.end}) *pose = {turn * pose->position_m, quarter * pose->orientation};
        const auto straight = make_cpu_engine(start, pool()), around = make_cpu_engine(start, pool());
        must_apply(*straight, {&sweep, 1});
        must_apply(*around, {&turned, 1});
        int different = 0;
        for_each_ray(straight->solid(), [&](RayEnds held, const RayPlace& p) {
            const RayPlace to = p.axis == 0   ? RayPlace{1, p.v, cells - p.u}
                                : p.axis == 1 ? RayPlace{0, p.v, p.u}
                                              : RayPlace{2, cells - p.v, p.u};
            const RayEnds other = ends_of(around->solid(), to);
            // Rounding in the turned pose moves a border by far less than a unit, so an end by one unit at most; a ray
            // that the tool just touches may be hit on one side only.
            if (held.size() != other.size()) {
                ++different;
                return;
            }
            for (std::size_t e = 0; e < held.size(); ++e) {
                const int depth = p.axis == 1 ? deepest - depth_of(held[held.size() - 1 - e]) : depth_of(held[e]);
                if (std::abs(depth - depth_of(other[e])) > 2) ++different;
            }
        });
        const int rounded_corners = std::holds_alternative<MeshTool>(sweep.shape) ? 20 : 0;
        ASSERT_TRUE(different <= 2 + rounded_corners);
    });
}

TEST(Apply, RefusesTheWholeRunWhenOneSweepCannotBe) {
    const auto engine = make_cpu_engine(start_solid(24), pool());
    const Solid before = engine->solid();
    Random random(1);
    const ToolSweep good = any_sweep(random, before.lattice, Operation::cut);
    std::vector<ToolSweep> bad(6, good);
    bad[0].shape = BallTool{-1};
    bad[1].shape = CylinderTool{0.1, 0};
    bad[2].start.position_m.x = NAN;
    bad[3].operation = Operation::smooth;
    bad[3].shape = BoxTool{Vec3(1e3)};  // farther across than smoothing goes
    bad[4].operation = Operation::smooth;
    bad[4].shape = BallTool{0.1};
    bad[4].smooth_strength = 1.5;
    bad[5].material = 77;
    for (const ToolSweep& sweep : bad) {
        const auto result = engine->carve(std::vector{good, sweep});
        ASSERT_FALSE(result.has_value());
        EXPECT_FALSE(result.error().remedy.empty());
        EXPECT_TRUE(engine->solid().same_content(before));
    }
    EXPECT_TRUE(engine->take_changes().empty());
    EXPECT_TRUE(engine->carve(std::span<const ToolSweep>{}).has_value());
}

// Filled up to where the lattice ends, the solid is still closed there: its outermost nodes stay empty.
TEST(Apply, WhatIsFilledBeyondTheLatticeClosesAtItsBorder) {
    const Solid start = start_solid(20);
    for (const ToolShape& shape : {ToolShape(BallTool{0.4}), ToolShape(CylinderTool{0.3, 0.9}),
                                   ToolShape(BoxTool{Vec3(0.3)}), ToolShape(star())}) {
        const auto engine = make_cpu_engine(start, pool());
        for (const Vec3 corner : {Vec3(0.0), Vec3(1.0), Vec3(0.0, 1.0, 0.5), Vec3(1.0, 0.5, 0.0)}) {
            ToolSweep sweep;
            sweep.shape = shape;
            sweep.start = sweep.end = {corner, Quat(1, 0, 0, 0)};
            sweep.operation = Operation::fill;
            ASSERT_TRUE(engine->carve(std::span(&sweep, 1)).has_value());
        }
        ASSERT_TRUE(well_formed(engine->solid()));
        Surface surface(start.lattice);
        surface.mesh_all(engine->solid(), pool());
        EXPECT_EQ(topology_of(surface.welded()), MeshTopology{}) << shape.index();
    }
}

// There the tool's own surface lies outside, so the end faces along its ray: downwards where material begins, upwards
// where it ends. A ball is filled by the engine, a box by the host.
TEST(Apply, WhatIsFilledBeyondTheLatticeFacesOutwardsAtItsBorder) {
    const Solid start = start_solid(20);
    for (const ToolShape& shape : {ToolShape(BallTool{0.4}), ToolShape(BoxTool{Vec3(0.3)})}) {
        const auto engine = make_cpu_engine(start, pool());
        for (const Vec3 corner : {Vec3(0.0), Vec3(1.0)}) {
            ToolSweep sweep;
            sweep.shape = shape;
            sweep.start = sweep.end = {corner, Quat(1, 0, 0, 0)};
            sweep.operation = Operation::fill;
            ASSERT_TRUE(engine->carve(std::span(&sweep, 1)).has_value());
        }
        for (int axis = 0; axis < 3; ++axis) {
            const DexelSet& set = engine->solid().sets[static_cast<std::size_t>(axis)];
            const int last = start.lattice.cells[static_cast<std::size_t>(axis)] * shared::kUnitsPerCell - 1;
            std::size_t lower = 0, upper = 0;
            for (std::size_t ray = 0; ray < set.ray_count(); ++ray) {
                for (std::size_t i = 0; i < set.ends(ray).size(); ++i) {
                    const shared::DexelEnd& end = set.ends(ray)[i];
                    if (depth_of(end) != 1 && depth_of(end) != last) continue;
                    const bool begins = i % 2 == 0;
                    (begins ? lower : upper) += 1;
                    const shared::Direction normal = shared::decode_normal(end.normal);
                    const float along = axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z;
                    ASSERT_EQ(along, begins ? -1.0f : 1.0f) << "tool " << shape.index() << " axis " << axis;
                }
            }
            EXPECT_GT(lower, 0u) << "tool " << shape.index() << " axis " << axis;
            EXPECT_GT(upper, 0u) << "tool " << shape.index() << " axis " << axis;
        }
    }
}

}  // namespace burin::compute::test

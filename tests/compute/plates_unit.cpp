// SPDX-License-Identifier: MIT
// Two hundred thin plates across every ray: none may get lost through cutting, filling, undoing, meshing and export.
#include <gtest/gtest.h>

#include <filesystem>

#include "compute/engine/history.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/repair/slivers.hpp"
#include "compute/tools/apply.hpp"
#include "geometry/files/mesh_export.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {
namespace {

constexpr int kPlates = 200;

// A bar along z, one metre long, of which cuts by a flat box leave plates of the given share of their pitch.
std::unique_ptr<CarvingEngine> plates(int resolution, double plate_share, WorkerPool& pool, History& history) {
    const double width = 6.0 / resolution, pitch = 1.0 / kPlates;
    auto engine = make_cpu_engine(*make_block(Vec3(width, width, 1.0), resolution, {"plates", {180, 180, 180}}), pool);
    std::vector<ToolSweep> slots;
    for (int i = 0; i < kPlates - 1; ++i) {
        ToolSweep slot;
        slot.shape = BoxTool{Vec3(width, width, 0.5 * (1.0 - plate_share) * pitch)};
        slot.start.position_m = slot.end.position_m = Vec3(width / 2, width / 2, (i + 1) * pitch);
        slots.push_back(slot);
    }
    EXPECT_TRUE(engine->carve(slots).has_value());
    history.record(engine->take_changes());
    history.end_stroke();
    return engine;
}

// Rays along z through the bar, with how many intervals they hold.
void expect_plates(const Solid& solid, std::size_t expected) {
    std::size_t rays = 0;
    for (std::size_t r = 0; r < solid.sets[2].ray_count(); ++r) {
        const auto ends = solid.sets[2].ends(r);
        if (ends.empty()) continue;
        ASSERT_EQ(ends.size(), 2 * expected) << "ray " << r;
        ++rays;
    }
    EXPECT_GE(rays, 25u);
    EXPECT_TRUE(well_formed(solid));
}

std::size_t shells_of_exported(const Surface& surface, const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
    const geometry::TriangleMesh mesh = surface.welded();
    EXPECT_TRUE(geometry::export_mesh(mesh, path).has_value());
    auto read = geometry::import_mesh(path);
    EXPECT_TRUE(read.has_value());
    std::filesystem::remove(path);
    if (!read) return 0;
    geometry::weld_vertices(read->mesh);
    const geometry::MeshHealth health = geometry::examine(read->mesh);
    EXPECT_EQ(health.boundary_edges, 0u);
    EXPECT_EQ(health.nonmanifold_edges, 0u);
    EXPECT_EQ(health.misoriented_edges, 0u);
    return health.shells;
}

}  // namespace

// Plates and gaps of two and a half cells: the mesh shows every one.
TEST(Plates, AllTwoHundredComeThroughCutFillUndoMeshAndExport) {
    WorkerPool pool(2);
    History history;
    const auto engine = plates(1000, 0.5, pool, history);
    expect_plates(engine->solid(), kPlates);
    Surface surface(engine->solid().lattice);
    surface.mesh_all(engine->solid(), pool);
    EXPECT_EQ(shells_of_exported(surface, "plates.stl"), static_cast<std::size_t>(kPlates));
    EXPECT_EQ(shells_of_exported(surface, "plates.ply"), static_cast<std::size_t>(kPlates));
    const Solid before = engine->solid();

    // A hole bored lengthwise through all of them; then filled again; then both undone.
    const Vec3 middle(0.003, 0.003, 0.0);
    const BallSweep bore{middle - Vec3(0, 0, 0.1), middle + Vec3(0, 0, 1.1), 0.0011, 0};
    ASSERT_TRUE(engine->carve(std::span(&bore, 1)).has_value());
    Changes changes = engine->take_changes();
    surface.update(engine->solid(), changes, pool);
    history.record(changes);
    history.end_stroke();
    EXPECT_EQ(shells_of_exported(surface, "bored.ply"), static_cast<std::size_t>(kPlates));

    BallSweep rod = bore;
    rod.operation = Operation::fill;
    ASSERT_TRUE(engine->carve(std::span(&rod, 1)).has_value());
    changes = engine->take_changes();
    surface.update(engine->solid(), changes, pool);
    history.record(changes);
    history.end_stroke();
    EXPECT_EQ(shells_of_exported(surface, "strung.ply"), 1u) << "the rod joins all plates";

    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(history.undo(*engine).has_value());
        surface.update(engine->solid(), engine->take_changes(), pool);
    }
    EXPECT_TRUE(engine->solid().same_content(before));
    EXPECT_EQ(shells_of_exported(surface, "again.ply"), static_cast<std::size_t>(kPlates));
}

// Plates far thinner than a cell: no mesh of this resolution can show them, but the solid keeps each, and says so.
TEST(Plates, ThinnerThanACellTheyAreKeptAndNamed) {
    WorkerPool pool(2);
    History history;
    const auto engine = plates(40, 0.3, pool, history);
    expect_plates(engine->solid(), kPlates);
    const Solid before = engine->solid();
    const SliverReport slivers = find_slivers(engine->solid(), pool);
    EXPECT_GT(slivers.solid[2], 25u * 100u);
    const BallSweep bore{Vec3(0.07, 0.07, -0.1), Vec3(0.07, 0.07, 1.1), 0.03, 0};
    for (const Operation operation : {Operation::cut, Operation::fill}) {
        BallSweep sweep = bore;
        sweep.operation = operation;
        ASSERT_TRUE(engine->carve(std::span(&sweep, 1)).has_value());
        history.record(engine->take_changes());
        history.end_stroke();
    }
    ASSERT_TRUE(history.undo(*engine).has_value());
    ASSERT_TRUE(history.undo(*engine).has_value());
    EXPECT_TRUE(engine->solid().same_content(before));
    ASSERT_TRUE(history.undo(*engine).has_value());
    expect_plates(engine->solid(), 1);
    ASSERT_TRUE(history.redo(*engine).has_value());
    expect_plates(engine->solid(), kPlates);
}

}  // namespace burin::compute::test

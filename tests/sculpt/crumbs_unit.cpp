// SPDX-License-Identifier: MIT
#include "geometry/mesh/crumbs.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/mesh/mesh_health.hpp"
#include "sculpt/finishing.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"

namespace burin::sculpt {
namespace {

// Adds a cube; inward: a hollow.
void add_cube(geometry::TriangleMesh& mesh, const Vec3& lo, double side, bool inward = false) {
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    for (unsigned i = 0; i < 8; ++i) mesh.positions_m.push_back(lo + side * Vec3(i & 1u, i >> 1 & 1u, i >> 2 & 1u));
    constexpr std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : kFaces) {
        for (const auto& t : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
            const std::array<std::uint32_t, 3> out{first + t[0], first + t[1], first + t[2]};
            mesh.triangles.push_back(inward ? std::array{out[0], out[2], out[1]} : out);
        }
    }
    mesh.colours.resize(mesh.positions_m.size(), {static_cast<std::uint8_t>(first), 2, 3});
}

// A part of 50 mm with a bubble, and crumbs of 0.2, 0.4 and 0.6 mm, the second of them hollow; in millimetres.
geometry::TriangleMesh part_with_crumbs() {
    geometry::TriangleMesh mesh;
    add_cube(mesh, Vec3(60.0, 0.0, 0.0), 0.2);
    add_cube(mesh, Vec3(0.0), 50.0);
    add_cube(mesh, Vec3(10.0), 0.3, true);
    add_cube(mesh, Vec3(70.0, 0.0, 0.0), 0.4);
    add_cube(mesh, Vec3(70.1, 0.1, 0.1), 0.1, true);
    add_cube(mesh, Vec3(80.0, 0.0, 0.0), 0.6);
    return mesh;
}

std::size_t shells_in(const geometry::TriangleMesh& mesh) { return geometry::examine(mesh).shells; }

}  // namespace

// A painted part was exported to .stl and came back grey, without a word.
TEST(ExportedColours, AreToldWhereTheFormatKeepsNone) {
    const geometry::TriangleMesh painted = part_with_crumbs();
    geometry::TriangleMesh plain = painted;
    plain.colours.assign(plain.positions_m.size(), {1, 2, 3});
    EXPECT_TRUE(loses_colours(painted, "part.stl"));
    EXPECT_FALSE(loses_colours(painted, "part.ply"));
    EXPECT_FALSE(loses_colours(plain, "part.stl"));
    plain.triangle_materials.assign(plain.triangles.size(), 0);
    EXPECT_FALSE(loses_colours(plain, "part.STL"));
    plain.triangle_materials.back() = 1;
    EXPECT_TRUE(loses_colours(plain, "part.STL"));
}

TEST(Crumbs, BelowASizeAreDroppedAndCountedWithTheirHollows) {
    geometry::TriangleMesh mesh = part_with_crumbs();
    ASSERT_EQ(shells_in(mesh), 6u);
    const geometry::DroppedCrumbs dropped = geometry::drop_crumbs(mesh, LengthUnit::mm, 0.0005);
    EXPECT_EQ(dropped.count, 2u);
    EXPECT_EQ(in_words(dropped), "dropped 2 crumbs smaller than 0.5 mm");
    const geometry::MeshHealth left = geometry::examine(mesh);
    EXPECT_EQ(left.shells, 3u) << "the part, its bubble, and the crumb of 0.6 mm";
    EXPECT_TRUE(left.closed && left.manifold());
    EXPECT_EQ(left.unused_vertices, 0u);
    EXPECT_NEAR(left.signed_volume_m3, 50.0 * 50.0 * 50.0 - 0.3 * 0.3 * 0.3 + 0.6 * 0.6 * 0.6, 1e-6);
    EXPECT_EQ(mesh.colours.size(), mesh.positions_m.size());
    EXPECT_EQ(mesh.colours.front()[0], 8) << "colours stay with their vertices";
}

TEST(Crumbs, AreAllKeptWhereTheSizeIsZero) {
    geometry::TriangleMesh mesh = part_with_crumbs();
    EXPECT_EQ(geometry::drop_crumbs(mesh, LengthUnit::mm, 0.0).count, 0u);
    EXPECT_EQ(shells_in(mesh), 6u);
    EXPECT_EQ(geometry::in_words({0, 0.0005}), "");
}

TEST(Crumbs, TheLargestShellIsNeverOneOfThem) {
    geometry::TriangleMesh mesh = part_with_crumbs();
    EXPECT_EQ(geometry::drop_crumbs(mesh, LengthUnit::mm, 10.0).count, 3u);
    EXPECT_EQ(shells_in(mesh), 2u) << "the part and its bubble";
    geometry::TriangleMesh alone;
    add_cube(alone, Vec3(0.0), 0.1);
    EXPECT_EQ(geometry::drop_crumbs(alone, LengthUnit::mm, 10.0).count, 0u);
    EXPECT_EQ(shells_in(alone), 1u);
    geometry::TriangleMesh nothing;
    EXPECT_EQ(geometry::drop_crumbs(nothing, LengthUnit::mm, 10.0).count, 0u);
}

TEST(Crumbs, FarFromTheOriginKeepTheirSign) {
    geometry::TriangleMesh mesh;
    add_cube(mesh, Vec3(1e6), 50.0);
    add_cube(mesh, Vec3(1e6 + 10.0), 0.25, true);
    add_cube(mesh, Vec3(1e6 + 60.0), 0.25);
    EXPECT_EQ(geometry::drop_crumbs(mesh, LengthUnit::mm, 0.001).count, 1u);
    EXPECT_EQ(shells_in(mesh), 2u);
}

TEST(Crumbs, OfASizeThatIsNoneAreRefused) {
    for (const double wrong :
         {-1e-3, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        EXPECT_FALSE(geometry::check_crumbs(wrong)) << wrong;
    EXPECT_TRUE(geometry::check_crumbs(0.0) && geometry::check_crumbs(5e-4) && geometry::check_crumbs(std::nullopt));
}

// A ball of about a cell's radius is left in the air beside a block, as carving leaves them.
TEST(Crumbs, OfACarvedSolidLeaveItsFinishedMesh) {
    WorkerPool pool(1);
    auto block = load_workpiece({.source = "block:0.02,0.02,0.02", .resolution = 40, .room = 0.2}, pool);
    ASSERT_TRUE(block);
    const double cell_m = block->solid.lattice.spacing_m;
    Sculpture carving(compute::make_cpu_engine(std::move(block->solid), pool), pool);
    compute::ToolSweep bead;
    bead.shape = compute::BallTool{0.95 * cell_m};
    bead.operation = compute::Operation::fill;
    bead.start.position_m = bead.end.position_m = Vec3(0.01, 0.0225, 0.01);
    ASSERT_TRUE(carving.update(std::span(&bead, 1)));
    const auto finish = [&](double crumbs_m) {
        return finish_mesh(carving.surface(), carving.engine().solid(), LengthUnit::mm, {}, crumbs_m, pool).value();
    };
    const FinishedMesh all = finish(0.0), rest = finish(geometry::kCrumbCells * cell_m);
    EXPECT_EQ(shells_in(all.mesh), 2u);
    EXPECT_EQ(all.crumbs.count, 0u);
    EXPECT_EQ(shells_in(rest.mesh), 1u);
    EXPECT_EQ(rest.crumbs.count, 1u);
}

}  // namespace burin::sculpt

// SPDX-License-Identifier: MIT
#include "compute/rays/room.hpp"

#include <gtest/gtest.h>

#include "compute/mesher/surface.hpp"

namespace burin::compute {
namespace {

geometry::TriangleMesh mesh_of(const Solid& solid) {
    WorkerPool pool(1);
    Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    return surface.welded();
}

}  // namespace

TEST(Room, LeavesNodesMaterialAndMeshWhereTheyAre) {
    const Solid ball = *make_ball(0.03, 40, {"skin"});
    for (const int cells : {1, 7, 40}) {
        const auto roomy = with_room(ball, cells);
        ASSERT_TRUE(roomy) << roomy.error().line();
        EXPECT_TRUE(well_formed(*roomy));
        EXPECT_EQ(roomy->lattice.cells[0], ball.lattice.cells[0] + 2 * cells);
        EXPECT_EQ(roomy->lattice.spacing_m, ball.lattice.spacing_m);
        // Every ray that was there has the same ends, from where it begins now; the others are empty.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const DexelSet &before = ball.sets.at(axis), &after = roomy->sets.at(axis);
            EXPECT_EQ(after.end_count(), before.end_count());
            for (int v = 0; v < before.rays_v(); ++v) {
                for (int u = 0; u < before.rays_u(); ++u) {
                    const auto was = before.ends(u, v), is = after.ends(u + cells, v + cells);
                    ASSERT_EQ(is.size(), was.size());
                    for (std::size_t i = 0; i < was.size(); ++i) {
                        EXPECT_EQ(shared::depth_of(is[i]), shared::depth_of(was[i]) + cells * shared::kUnitsPerCell);
                        EXPECT_EQ(is[i].normal, was[i].normal);
                        EXPECT_EQ(shared::material_of(is[i]), shared::material_of(was[i]));
                    }
                }
            }
        }
        const auto old_mesh = mesh_of(ball), new_mesh = mesh_of(*roomy);
        ASSERT_EQ(new_mesh.positions_m.size(), old_mesh.positions_m.size());
        EXPECT_EQ(new_mesh.triangles.size(), old_mesh.triangles.size());
        Box before, after;
        for (const Vec3& p : old_mesh.positions_m) before.include(p);
        for (const Vec3& p : new_mesh.positions_m) after.include(p);
        EXPECT_LT(glm::length(after.lo - before.lo) + glm::length(after.hi - before.hi), 1e-4 * ball.lattice.spacing_m);
    }
    EXPECT_TRUE(with_room(ball, 0)->same_content(ball));
}

TEST(Room, ReachesAsFarAsDepthsHaveNumbers) {
    const Solid ball = *make_ball(0.03, 40, {"skin"});
    const int most = most_room_cells(ball.lattice);
    EXPECT_LE(ball.lattice.cells[0] + 2 * most, shared::kMaxCells);
    EXPECT_GT(ball.lattice.cells[0] + 2 * (most + 1), shared::kMaxCells);
}

}  // namespace burin::compute

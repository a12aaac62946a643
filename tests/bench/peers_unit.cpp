// SPDX-License-Identifier: MIT
// The peers do the same work: they carve the scene that is measured. Where they are not built in, they say so.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/measure/surface_errors.hpp"
#include "bench/peers/peers.hpp"

namespace burin::bench {
namespace {

#define BURIN_NEEDS_PEERS() \
    if (!has_peers()) GTEST_SKIP() << "built without OpenVDB and CGAL (scripts/setup --peers, -DBURIN_WITH_PEERS=ON)"

const int kResolution = 48;

CarveScene short_peer_scene() { return beginning_of(stroke_1000_scene(), 25, 400); }

compute::Lattice unit_lattice() { return *compute::lattice_around({Vec3(0.0), Vec3(1.0)}, kResolution); }

}  // namespace

TEST(Peers, SayHowToGetThemWhereTheyAreNotBuilt) {
    if (has_peers()) GTEST_SKIP() << "they are built in";
    const auto vdb = run_openvdb(short_peer_scene(), unit_lattice(), 1, VdbMethod::csg_difference);
    const auto cgal = run_cgal(short_peer_scene(), 2);
    const auto pairs = count_self_intersections_with_cgal({});
    for (const std::string& line : {vdb.error().line(), cgal.error().line(), pairs.error().line()}) {
        EXPECT_NE(line.find("scripts/setup --peers"), std::string::npos) << line;
        EXPECT_NE(line.find("BURIN_WITH_PEERS"), std::string::npos) << line;
    }
}

TEST(Peers, OpenVdbCarvesTheSameSolidEitherWay) {
    BURIN_NEEDS_PEERS();
    const CarveScene scene = short_peer_scene();
    for (const VdbMethod method : {VdbMethod::csg_difference, VdbMethod::leaf_brush}) {
        const auto run = run_openvdb(scene, unit_lattice(), 2, method);
        ASSERT_TRUE(run.has_value());
        EXPECT_EQ(run->update_ms.size(), scene.sweeps.size());
        const SurfaceErrors e = measure(run->mesh, scene, 1.0 / kResolution);
        EXPECT_EQ(e.bad_edges, 0u) << run->method;
        // Level sets round the cube's twelve edges off, each by less than half a cell squared.
        EXPECT_LT(std::abs(e.volume_over_removed) * scene.removed_m3, 12 * 0.5 / (kResolution * kResolution));
        EXPECT_LT(e.cut_m.rms * kResolution, 0.15) << run->method;  // a twentieth of a cell, as at any resolution
        for (const double triangles : run->triangles_remeshed) EXPECT_GT(triangles, 0.0);
    }
}

TEST(Peers, CgalCarvesTheSameSolid) {
    BURIN_NEEDS_PEERS();
    const CarveScene scene = beginning_of(stroke_1000_scene(), 4, 1000);
    const auto run = run_cgal(scene, 2);
    ASSERT_TRUE(run.has_value());
    const SurfaceErrors e = measure(run->mesh, scene, 0.01);
    EXPECT_EQ(e.bad_edges, 0u);
    // A ball of 320 triangles is up to 1.5 % smaller than the sphere, 4 % in volume.
    EXPECT_GT(e.volume_over_removed, 0.0);
    EXPECT_LT(e.volume_over_removed, 0.08);
    EXPECT_LT(e.cut_m.max, 0.02 * 0.06);
}

TEST(Peers, CgalCountsTrianglesThatCross) {
    BURIN_NEEDS_PEERS();
    geometry::TriangleMesh two;
    two.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}};
    two.triangles = {{0, 1, 2}, {3, 4, 5}};
    EXPECT_EQ(count_self_intersections_with_cgal(two).value(), 1u);
    for (std::size_t i = 3; i < 6; ++i) two.positions_m[i].z += 5.0;
    EXPECT_EQ(count_self_intersections_with_cgal(two).value(), 0u);
}

}  // namespace burin::bench

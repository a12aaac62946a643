// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

TEST(CloseHoles, ClosesWhateverTrianglesAreTakenFromATorus) {
    EXPECT_TRUE(rc::check([] {
        TriangleMesh mesh = torus(9, 7, 1.0, 0.4);
        const auto keep = *rc::gen::container<std::vector<bool>>(mesh.triangles.size(), rc::gen::arbitrary<bool>());
        std::size_t at = 0;
        std::erase_if(mesh.triangles, [&](const auto&) { return !keep[at++]; });
        RC_PRE(!mesh.triangles.empty());
        const std::size_t before = mesh.triangles.size();
        const auto kept = mesh.triangles;
        const ClosingReport report = close_holes(mesh);
        const MeshHealth health = examine(mesh);
        RC_ASSERT(health.closed);
        RC_ASSERT(health.nonmanifold_edges == 0u);
        RC_ASSERT(mesh.triangles.size() == before + report.triangles_added);
        RC_ASSERT(std::equal(kept.begin(), kept.end(), mesh.triangles.begin()));  // nothing was dropped or moved
    }));
}

TEST(CloseHoles, ClosesAnySoupOfTriangles) {
    EXPECT_TRUE(rc::check([] {
        TriangleMesh mesh;
        for (int i = 0; i < 9; ++i) mesh.positions_m.emplace_back(i % 3, i / 3, i * i % 5);
        mesh.triangles = *rc::gen::container<std::vector<std::array<std::uint32_t, 3>>>(
            rc::gen::container<std::array<std::uint32_t, 3>>(rc::gen::inRange<std::uint32_t>(0, 9)));
        const bool has_edges = examine(mesh).edges > 0;
        close_holes(mesh);
        RC_ASSERT(examine(mesh).closed == (has_edges && examine(mesh).edges > 0));
        RC_ASSERT(examine(mesh).holes == 0u);
    }));
}

TEST(OrientOutward, UndoesAnyTurningOfTriangles) {
    EXPECT_TRUE(rc::check([] {
        TriangleMesh mesh = torus(9, 7, 1.0, 0.4);
        const auto good = mesh.triangles;
        const auto turn = *rc::gen::container<std::vector<bool>>(mesh.triangles.size(), rc::gen::arbitrary<bool>());
        for (std::size_t t = 0; t < turn.size(); ++t) {
            if (turn[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        }
        RC_ASSERT(orient_outward(mesh).conflicts == 0u);
        RC_ASSERT(mesh.triangles == good);
    }));
}

}  // namespace
}  // namespace burin::geometry::test

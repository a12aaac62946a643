// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/mesh/mesh_health.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

TEST(MeshHealth, FindsNothingWrongWithACube) {
    const MeshHealth health = examine(cube());
    EXPECT_TRUE(geometry::complaints(health).empty());
    EXPECT_TRUE(health.closed && health.consistently_oriented && health.manifold() && !health.inside_out());
    EXPECT_DOUBLE_EQ(health.signed_volume_m3, 1.0);
    EXPECT_DOUBLE_EQ(health.area_m2, 6.0);
    EXPECT_EQ(health.edges, 18u);  // Euler: V - E + F = 8 - 18 + 12 = 2
    EXPECT_EQ(health.shells, 1u);
    EXPECT_EQ(health.bounds_m.lo, Vec3(0.0));
    EXPECT_EQ(health.bounds_m.hi, Vec3(1.0));
}

TEST(MeshHealth, MeasuresATorus) {
    const MeshHealth health = examine(torus(200, 100, 0.1, 0.03));
    EXPECT_EQ(health.vertices + health.triangles, health.edges);  // Euler characteristic 0
    EXPECT_NEAR(health.signed_volume_m3, 2 * std::pow(std::numbers::pi, 2) * 0.1 * 0.03 * 0.03,
                3e-3 * 1.8e-3);  // chords: 1e-3
    EXPECT_TRUE(health.closed && health.manifold());
}

TEST(MeshHealth, KeepsTheVolumesDigitsFarFromTheOrigin) {
    geometry::TriangleMesh mesh = cube();
    for (Vec3& p : mesh.positions_m) p += Vec3(1e6, -2e6, 3e6);
    EXPECT_NEAR(geometry::examine(mesh).signed_volume_m3, 1.0, 1e-8);
}

TEST(MeshHealth, CountsTheEdgesAndLoopsOfHoles) {
    geometry::TriangleMesh mesh = cube();
    mesh.triangles.erase(mesh.triangles.begin() + 11);
    mesh.triangles.erase(mesh.triangles.begin());  // opposite corners: the holes do not touch
    const MeshHealth health = examine(mesh);
    EXPECT_EQ(health.boundary_edges, 6u);
    EXPECT_EQ(health.holes, 2u);
    EXPECT_FALSE(health.closed);
    EXPECT_EQ(geometry::complaints(health).at(0), "6 edges have only one triangle (2 holes)");
}

TEST(MeshHealth, SeparatesHolesThatTouchInAVertex) {
    geometry::TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
    const MeshHealth health = examine(mesh);
    EXPECT_EQ(health.holes, 2u);
    EXPECT_EQ(health.nonmanifold_vertices, 1u);
    EXPECT_EQ(health.shells, 2u);
}

TEST(MeshHealth, CountsFansOfThreeAndMoreTriangles) {
    geometry::TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const MeshHealth health = examine(mesh);
    EXPECT_EQ(health.nonmanifold_edges, 1u);
    EXPECT_EQ(health.boundary_edges, 6u);
    EXPECT_EQ(health.misoriented_edges, 0u);  // up, down, and one left over
    EXPECT_EQ(health.shells, 1u);
    mesh.triangles[1] = {0, 1, 3};
    EXPECT_EQ(geometry::examine(mesh).misoriented_edges, 1u);
}

TEST(MeshHealth, CallsTwoCubesThatShareAnEdgeClosedButNotManifold) {
    geometry::TriangleMesh mesh = cube();
    std::array<std::uint32_t, 8> other{};
    for (std::uint32_t i = 0; i < 8; ++i) {
        const Vec3 p = mesh.positions_m[i] + Vec3(1, 1, 0);
        other[i] = p.x == 1 && p.y == 1 ? 3 + 4 * (i >> 2 & 1u) : static_cast<std::uint32_t>(mesh.positions_m.size());
        if (other[i] == mesh.positions_m.size()) mesh.positions_m.push_back(p);
    }
    for (const auto& t : cube().triangles) mesh.triangles.push_back({other[t[0]], other[t[1]], other[t[2]]});
    const MeshHealth health = examine(mesh);
    EXPECT_TRUE(health.closed && health.consistently_oriented);
    EXPECT_EQ(health.nonmanifold_edges, 1u);
    EXPECT_EQ(health.shells, 1u);
    EXPECT_DOUBLE_EQ(health.signed_volume_m3, 2.0);
}

TEST(MeshHealth, CountsATurnedTriangleByItsThreeEdges) {
    geometry::TriangleMesh mesh = cube();
    std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
    const MeshHealth health = examine(mesh);
    EXPECT_EQ(health.misoriented_edges, 3u);
    EXPECT_TRUE(health.closed);
    EXPECT_FALSE(health.consistently_oriented);
}

TEST(MeshHealth, SeesThatAMeshIsInsideOut) {
    geometry::TriangleMesh mesh = cube();
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    EXPECT_TRUE(geometry::examine(mesh).inside_out());
    EXPECT_EQ(geometry::complaints(geometry::examine(mesh)).at(0), "the surface is inside out");
}

TEST(MeshHealth, CountsDegenerateAndDuplicateTrianglesAndUnusedVertices) {
    geometry::TriangleMesh mesh = tetrahedron();
    mesh.positions_m.emplace_back(0.1, 0, 0);  // 4: on the edge 0 1
    mesh.positions_m.emplace_back(7, 7, 7);    // 5: unused
    mesh.triangles.push_back({0, 1, 4});       // without area
    mesh.triangles.push_back({2, 2, 3});       // an index twice
    mesh.triangles.push_back({3, 2, 1});       // the last face again, turned
    const MeshHealth health = examine(mesh);
    EXPECT_EQ(health.degenerate_triangles, 2u);
    EXPECT_EQ(health.duplicate_triangles, 1u);
    EXPECT_EQ(health.unused_vertices, 1u);
    EXPECT_EQ(health.bounds_m.hi, Vec3(1.0));
}

TEST(MeshHealth, CountsEachRepetitionOfATriangleOnce) {
    geometry::TriangleMesh mesh = tetrahedron();
    for (const std::array<std::uint32_t, 3> t :
         {std::array<std::uint32_t, 3>{3, 1, 2}, {2, 1, 3}, {1, 0, 2}, {1, 1, 0}, {1, 0, 1}}) {
        mesh.triangles.push_back(t);
    }
    EXPECT_EQ(geometry::examine(mesh).duplicate_triangles, 4u);  // twice 1 2 3, once 0 1 2, once 0 1 1
    EXPECT_EQ(geometry::examine(mesh).nonmanifold_edges, 5u);    // all but 0 3
}

TEST(MeshHealth, OfAnEmptyMeshIsNotSound) {
    const MeshHealth health = examine({});
    EXPECT_FALSE(health.closed);
    EXPECT_EQ(geometry::complaints(health), std::vector<std::string>{"there are no triangles"});
}

}  // namespace
}  // namespace burin::geometry::test

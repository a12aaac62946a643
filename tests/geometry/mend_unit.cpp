// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

// An open cylinder around +Y, closed below by a fan, of height 1 and radius 1: one hole of n edges.
TriangleMesh bucket(std::uint32_t n) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n;
        mesh.positions_m.emplace_back(std::cos(a), 0.0, -std::sin(a));
        mesh.positions_m.emplace_back(std::cos(a), 1.0, -std::sin(a));
    }
    mesh.positions_m.emplace_back(0.0);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}, {b, a, 2 * n}});
    }
    return mesh;
}

double disc_area(std::uint32_t n) { return 0.5 * n * std::sin(2 * std::numbers::pi / n); }

TEST(CloseHoles, FillsAFlatRimWithItsOwnAreaWhateverTheMethod) {
    for (const std::uint32_t n : {3u, 4u, 5u, 64u, 300u, 301u, 1000u}) {
        TriangleMesh mesh = bucket(n);
        ASSERT_EQ(examine(mesh).holes, 1u);
        const ClosingReport report = close_holes(mesh);
        ASSERT_EQ(report.holes.size(), 1u);
        EXPECT_EQ(report.holes[0].edges, n);
        EXPECT_EQ(report.holes[0].filling, n <= kLeastAreaEdges ? HoleFilling::least_area : HoleFilling::flat);
        EXPECT_NEAR(report.holes[0].perimeter_m, 2 * n * std::sin(std::numbers::pi / n), 1e-9);
        EXPECT_NEAR(report.holes[0].area_added_m2, disc_area(n), 1e-9);
        const MeshHealth health = examine(mesh);
        EXPECT_TRUE(health.closed && health.consistently_oriented && health.manifold()) << n;
        EXPECT_NEAR(health.signed_volume_m3, disc_area(n), 1e-9);
    }
}

TEST(CloseHoles, FindsTheLeastAreaOverABentRim) {
    // Two faces of a unit cube's corner are missing: the fill over the bent rim of 6 edges.
    TriangleMesh mesh = cube();
    const double before = examine(mesh).area_m2;
    mesh.triangles.resize(8);  // keeps -z, +z, -y, +y
    const ClosingReport report = close_holes(mesh);
    EXPECT_EQ(report.holes.size(), 2u);  // x = 0 and x = 1
    EXPECT_NEAR(examine(mesh).area_m2, before, 1e-12);
    EXPECT_DOUBLE_EQ(examine(mesh).signed_volume_m3, 1.0);
}

TEST(CloseHoles, NeverUsesAnEdgeThatTheMeshHasAlready) {
    // The rim of two triangles that share an edge: both diagonals of its loop of 4 exist or would, if the shared edge
    // were taken, have four uses.
    TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    close_holes(mesh);
    const MeshHealth health = examine(mesh);
    EXPECT_TRUE(health.closed && health.manifold() && health.consistently_oriented);
    EXPECT_EQ(health.triangles, 4u);  // over the other diagonal
}

TEST(CloseHoles, FansFromANewVertexWhereEveryDiagonalIsTaken) {
    // A loop 0 1 2 3 whose two diagonals are edges of flaps elsewhere.
    TriangleMesh mesh = bucket(4);
    const auto top = [](std::uint32_t i) { return 2 * i + 1; };
    mesh.positions_m.emplace_back(0, 5, 0);
    mesh.positions_m.emplace_back(0, 6, 0);
    const std::uint32_t tip = 9, peak = 10;
    mesh.triangles.push_back({top(0), top(2), tip});
    mesh.triangles.push_back({top(2), top(0), tip});
    mesh.triangles.push_back({top(1), top(3), peak});
    mesh.triangles.push_back({top(3), top(1), peak});
    mesh.colours.assign(mesh.positions_m.size(), {7, 8, 9});
    const ClosingReport report = close_holes(mesh);
    ASSERT_EQ(report.holes.size(), 1u);
    ASSERT_EQ(mesh.colours.size(), mesh.positions_m.size());
    EXPECT_EQ(mesh.colours.back(), mesh.colours.front()) << "a colour of the rim";
    EXPECT_EQ(report.holes[0].filling, HoleFilling::centre_fan);
    EXPECT_EQ(report.vertices_added, 1u);
    EXPECT_TRUE(examine(mesh).closed);
    EXPECT_EQ(examine(mesh).nonmanifold_edges, 0u);
}

TEST(CloseHoles, ClosesLoopsThatTouchInAVertex) {
    TriangleMesh mesh = cube();
    // Two triangles of different faces that share only the vertex 1.
    std::erase(mesh.triangles, std::array<std::uint32_t, 3>{0, 2, 1});
    std::erase(mesh.triangles, std::array<std::uint32_t, 3>{1, 5, 4});
    ASSERT_EQ(examine(mesh).boundary_edges, 6u);
    const ClosingReport report = close_holes(mesh);
    EXPECT_EQ(report.triangles_added, 2u);
    EXPECT_TRUE(examine(mesh).closed && examine(mesh).manifold());
    EXPECT_DOUBLE_EQ(examine(mesh).signed_volume_m3, 1.0);
}

TEST(CloseHoles, ClosesAFanOfThreeTrianglesOnOneEdge) {
    TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    close_holes(mesh);
    EXPECT_TRUE(examine(mesh).closed);
}

TEST(CloseHoles, PaintsTheFillingLikeItsRim) {
    TriangleMesh mesh = cube();
    mesh.materials = {{"a", {1, 1, 1}}, {"b", {2, 2, 2}}};
    mesh.triangle_materials.assign(12, 1);
    mesh.triangle_materials[11] = 0;
    mesh.triangles.erase(mesh.triangles.begin());
    mesh.triangle_materials.erase(mesh.triangle_materials.begin());
    close_holes(mesh);
    ASSERT_EQ(mesh.triangle_materials.size(), mesh.triangles.size());
    EXPECT_EQ(mesh.triangle_materials.back(), 1);
}

// One triangle of the rim, whichever it is, was turned round: the filling agrees with all the others.
TEST(CloseHoles, OrientsTheFillingLikeMostTrianglesAroundTheHole) {
    constexpr std::uint32_t kEdges = 5;
    for (std::uint32_t turned = 0; turned < kEdges; ++turned) {
        TriangleMesh mesh = bucket(kEdges);
        auto& t = mesh.triangles[3 * turned + 1];  // of the wall's two, the one along the upper rim
        std::swap(t[1], t[2]);
        close_holes(mesh);
        std::swap(t[1], t[2]);
        const MeshHealth health = examine(mesh);
        EXPECT_TRUE(health.closed && health.consistently_oriented) << "triangle " << turned;
        EXPECT_NEAR(health.signed_volume_m3, disc_area(kEdges), 1e-12) << "triangle " << turned;
    }
}

TEST(CloseHoles, DoesNothingToAClosedMesh) {
    TriangleMesh mesh = torus(12, 8, 1.0, 0.3);
    const auto before = mesh.triangles;
    EXPECT_TRUE(close_holes(mesh).holes.empty());
    EXPECT_EQ(mesh.triangles, before);
}

TEST(WeldVertices, JoinsTheFacesOfAMeshWithSeams) {
    TriangleMesh seamed;
    for (const auto& t : cube().triangles) {
        const auto first = static_cast<std::uint32_t>(seamed.positions_m.size());
        for (const std::uint32_t v : t) seamed.positions_m.push_back(cube().positions_m[v]);
        seamed.triangles.push_back({first, first + 1, first + 2});
    }
    EXPECT_EQ(examine(seamed).boundary_edges, 36u);
    EXPECT_EQ(weld_vertices(seamed).vertices_merged, 28u);
    EXPECT_TRUE(examine(seamed).closed);
    EXPECT_DOUBLE_EQ(examine(seamed).signed_volume_m3, 1.0);
}

TEST(WeldVertices, KeepsTheColourOfTheFirstOfThem) {
    TriangleMesh mesh;
    mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    mesh.colours = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}};
    mesh.triangles = {{0, 1, 3}, {2, 4, 3}};
    EXPECT_EQ(weld_vertices(mesh).vertices_merged, 2u);
    const std::vector<std::array<std::uint8_t, 3>> kept{{1, 1, 1}, {2, 2, 2}, {4, 4, 4}};
    EXPECT_EQ(mesh.colours, kept);
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 1, 2}};
    EXPECT_EQ(mesh.triangles, triangles);
}

TEST(OrientOutward, TurnsAMeshThatIsInsideOut) {
    TriangleMesh mesh = torus(12, 8, 1.0, 0.3);
    const auto good = mesh.triangles;
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    const OrientationReport report = orient_outward(mesh);
    EXPECT_EQ(report.triangles_turned, good.size());
    EXPECT_EQ(report.patches_turned, 1u);
    EXPECT_EQ(mesh.triangles, good);
}

TEST(OrientOutward, TurnsOnlyTheOneOfTwoPartsThatIsInsideOut) {
    TriangleMesh mesh = cube();
    for (Vec3 p : cube().positions_m) mesh.positions_m.push_back(p * 3.0 + Vec3(5, 0, 0));
    for (auto t : cube().triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    for (std::size_t t = 0; t < 12; ++t) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    EXPECT_EQ(orient_outward(mesh).triangles_turned, 12u);
    EXPECT_NEAR(examine(mesh).signed_volume_m3, 28.0, 1e-12);
}

// A flat sheet has no volume that could tell its sides apart: the most triangles do, also where the search begins at
// another.
TEST(OrientOutward, TurnsTheFewAndNotTheManyOfAnOpenPatch) {
    TriangleMesh sheet;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) sheet.positions_m.emplace_back(x, y, 0);
    }
    for (std::uint32_t y = 0; y < 3; ++y) {
        for (std::uint32_t x = 0; x < 3; ++x) {
            const std::uint32_t a = 4 * y + x;
            sheet.triangles.insert(sheet.triangles.end(), {{a, a + 1, a + 5}, {a, a + 5, a + 4}});
        }
    }
    const auto good = sheet.triangles;
    for (const std::size_t turned : {0u, 7u, 17u}) {
        TriangleMesh mesh = sheet;
        std::swap(mesh.triangles[turned][1], mesh.triangles[turned][2]);
        EXPECT_EQ(orient_outward(mesh).triangles_turned, 1u) << turned;
        EXPECT_EQ(mesh.triangles, good) << turned;
    }
}

TEST(OrientOutward, LeavesAnOpenPatchBesideALargerBodyAsItIs) {
    for (const bool inside_out : {false, true}) {
        TriangleMesh mesh = cube();
        for (const Vec3& p : bucket(8).positions_m) mesh.positions_m.push_back(0.05 * p + Vec3(3, 0, 0));
        for (auto t : bucket(8).triangles) {
            if (inside_out) std::swap(t[1], t[2]);
            mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
        }
        const OrientationReport report = orient_outward(mesh);
        EXPECT_EQ(report.triangles_turned, 0u);
        EXPECT_EQ(report.patches, 2u);
        EXPECT_EQ(report.patches_turned, 0u);
    }
}

TEST(OrientOutward, LeavesACavityACavity) {
    TriangleMesh mesh = cube();
    for (Vec3 p : cube().positions_m) mesh.positions_m.push_back(p * 0.5 + Vec3(0.25));
    for (auto t : cube().triangles) mesh.triangles.push_back({t[0] + 8, t[2] + 8, t[1] + 8});
    EXPECT_EQ(orient_outward(mesh).triangles_turned, 0u);
    EXPECT_NEAR(examine(mesh).signed_volume_m3, 0.875, 1e-12);
}

TEST(OrientOutward, ReportsThatAMoebiusBandHasNoTwoSides) {
    TriangleMesh mesh;
    constexpr std::uint32_t kSteps = 12;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
        const double a = 2 * std::numbers::pi * i / kSteps;
        for (const double s : {-0.2, 0.2}) {
            const double r = 1 + s * std::cos(a / 2);
            mesh.positions_m.emplace_back(r * std::cos(a), r * std::sin(a), s * std::sin(a / 2));
        }
    }
    for (std::uint32_t i = 0; i < kSteps; ++i) {
        const bool seam = i + 1 == kSteps;
        const std::uint32_t a = 2 * i, b = a + 1, c = seam ? 1 : a + 2, d = seam ? 0 : a + 3;
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
    }
    EXPECT_GE(orient_outward(mesh).conflicts, 1u);
    EXPECT_EQ(mesh.triangles.size(), 2 * kSteps);
    close_holes(mesh);
    EXPECT_TRUE(examine(mesh).closed);
}

}  // namespace
}  // namespace burin::geometry::test

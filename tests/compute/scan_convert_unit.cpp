// SPDX-License-Identifier: MIT
#include "compute/rays/scan_convert.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "compute/mesher/surface.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/mesh_topology.hpp"
#include "tests/compute/test_meshes.hpp"

namespace burin::compute::test {
namespace {

WorkerPool& scan_pool() {
    static WorkerPool two(2);
    return two;
}

ScanConversion converted(const geometry::TriangleMesh& mesh, int resolution) {
    auto result = scan_convert(mesh, resolution, scan_pool());
    EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().line());
    return result ? std::move(*result) : ScanConversion{};
}

// The material along the rays of one axis, m^3.
double ray_volume(const Solid& solid, std::size_t axis) {
    double units = 0;
    const DexelSet& set = solid.sets[axis];
    for (std::size_t r = 0; r < set.ray_count(); ++r) {
        const auto ends = set.ends(r);
        for (std::size_t i = 0; i < ends.size(); i += 2) units += depth_of(ends[i + 1]) - depth_of(ends[i]);
    }
    return units * solid.lattice.unit_m() * solid.lattice.spacing_m * solid.lattice.spacing_m;
}

double mesh_volume(const Solid& solid) {
    Surface surface(solid.lattice);
    surface.mesh_all(solid, scan_pool());
    EXPECT_EQ(topology_of(surface.welded()), MeshTopology{});
    return surface.volume_m3();
}

// Summing rays is a midpoint rule across the silhouette: wrong by at most half a cell along the faces that lie along
// the rays, hence by h/2 times the area.
void expect_matched(const ScanConversion& c, double volume, double area, const std::string& what) {
    ASSERT_EQ(c.unmatched_rays, 0u) << what;
    ASSERT_TRUE(well_formed(c.solid)) << what;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(ray_volume(c.solid, axis), volume, 0.5 * area * c.solid.lattice.spacing_m)
            << what << " axis " << axis;
    }
}

Quat random_turn(Random& random) {
    return glm::normalize(
        Quat(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
}

std::string scan_refusal(const geometry::TriangleMesh& mesh, int resolution = 32) {
    const auto result = scan_convert(mesh, resolution, scan_pool());
    return result ? "" : result.error().line();
}

}  // namespace

TEST(ScanConvert, RandomTurnsOfBoxesAndPrismsAlwaysHaveMatchedEnds) {
    Random random(1);
    for (int i = 0; i < repeated(300); ++i) {
        geometry::TriangleMesh mesh = i % 3 == 0
                                          ? box_mesh(Vec3(-0.3, -0.2, -0.4), Vec3(0.3, 0.4, 0.5), random.small(1, 6))
                                      : i % 3 == 1 ? prism_mesh(random.small(3, 12), 0.4, 0.7)
                                                   : ball_mesh(0.5, 2);
        // A third unturned, a third by quarter turns about random axes, the rest anyhow.
        if (i % 9 >= 6)
            mesh = transformed(mesh, glm::angleAxis(std::numbers::pi / 4 * random.small(0, 7), Vec3(0, 0, 1)));
        if (i % 9 < 3) mesh = transformed(mesh, random_turn(random));
        const auto c = converted(mesh, random.small(16, 60));
        ASSERT_NO_FATAL_FAILURE(expect_matched(c, volume_of(mesh), area_of(mesh), std::to_string(i)));
        EXPECT_FALSE(c.by_parity);
    }
}

// Rays run exactly through vertices, along edges and within faces.
TEST(ScanConvert, FacesEdgesAndVerticesOnRaysAreCountedOnce) {
    Random random(2);
    for (int i = 0; i < repeated(100); ++i) {
        const int resolution = 64;
        // Learn where the nodes are, then put the inner mesh on them.
        const geometry::TriangleMesh frame = box_mesh(Vec3(0), Vec3(1));
        const Lattice lattice = converted(frame, resolution).solid.lattice;
        const auto node = [&](int x, int y, int z) { return lattice.object_from_units(Vec3(x, y, z) * 4096.0); };
        const int lo[3] = {random.small(3, 10), random.small(3, 10), random.small(3, 10)};
        const int n = random.small(1, 4);
        const Vec3 from = node(lo[0], lo[1], lo[2]);
        const Vec3 to =
            node(lo[0] + n * random.small(1, 3), lo[1] + n * random.small(1, 3), lo[2] + n * random.small(1, 3));
        // As a cavity of the frame, so that its faces stay inside the lattice; half of them skewed by whole cells.
        geometry::TriangleMesh inner = box_mesh(from, to, n);
        if (i % 2 == 1) {
            for (Vec3& p : inner.positions_m) {
                p.x += std::round((p.y - from.y) / lattice.spacing_m) * lattice.spacing_m;
                p.z += std::round((p.x - from.x) / lattice.spacing_m / 2) * lattice.spacing_m;
            }
        }
        const geometry::TriangleMesh mesh = joined(frame, inverted(inner));
        const auto c = converted(mesh, resolution);
        ASSERT_EQ(c.solid.lattice, lattice);
        ASSERT_NO_FATAL_FAILURE(expect_matched(c, volume_of(mesh), area_of(mesh), std::to_string(i)));
        // On nodes half-open intervals and the moved ray agree: unskewed boxes hold exactly their share of nodes.
        if (i % 2 == 0) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double frame_volume = ray_volume(converted(frame, resolution).solid, axis);
                EXPECT_NEAR(frame_volume - ray_volume(c.solid, axis), volume_of(inner),
                            1e-3 * lattice.spacing_m * area_of(inner));
            }
        }
    }
}

TEST(ScanConvert, OverlappingAndTouchingShellsUnite) {
    const double s = 0.5;
    const geometry::TriangleMesh a = box_mesh(Vec3(0), Vec3(s)),
                                 overlapping = box_mesh(Vec3(s / 2, 0, 0), Vec3(1, s, s)),
                                 touching = box_mesh(Vec3(s, 0, 0), Vec3(2 * s, s, s));
    for (const geometry::TriangleMesh& b : {overlapping, touching}) {
        const geometry::TriangleMesh mesh = joined(a, b);
        const auto c = converted(mesh, 40);
        expect_matched(c, 1 * s * s, area_of(mesh), "union");
        EXPECT_NEAR(mesh_volume(c.solid), s * s, 1e-3);
        // Along x nothing of the inner walls is left.
        for (std::size_t r = 0; r < c.solid.sets[0].ray_count(); ++r) EXPECT_LE(c.solid.sets[0].ends(r).size(), 2u);
    }
}

TEST(ScanConvert, CavitiesStayAndShellsInThemToo) {
    const geometry::TriangleMesh mesh = joined(
        joined(box_mesh(Vec3(0), Vec3(1)), inverted(box_mesh(Vec3(0.2), Vec3(0.8)))), box_mesh(Vec3(0.4), Vec3(0.6)));
    const auto c = converted(mesh, 50);
    expect_matched(c, 1 - 0.216 + 0.008, area_of(mesh), "nested");
    EXPECT_NEAR(mesh_volume(c.solid), 0.792, 2e-3);
}

TEST(ScanConvert, EvenNonManifoldEdgesAreAccepted) {
    // Two cubes that share an edge: four triangles at it, two each way.
    geometry::TriangleMesh mesh = joined(box_mesh(Vec3(0), Vec3(1)), box_mesh(Vec3(1, 1, 0), Vec3(2, 2, 1)));
    for (auto& t : mesh.triangles) {
        for (std::uint32_t& i : t) {
            for (std::uint32_t k = 0; k < i; ++k) {
                if (mesh.positions_m[k] == mesh.positions_m[i]) i = k;
            }
        }
    }
    ASSERT_EQ(topology_of(mesh).non_manifold_edges, 1u);
    const auto c = converted(mesh, 48);
    EXPECT_FALSE(c.by_parity);
    expect_matched(c, 2.0, area_of(mesh), "shared edge");
}

TEST(ScanConvert, MixedOrientationIsDecidedByParityAndSaid) {
    geometry::TriangleMesh mesh = box_mesh(Vec3(0), Vec3(1), 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
    const auto c = converted(mesh, 33);
    EXPECT_TRUE(c.by_parity);
    expect_matched(c, 1.0, 6.0, "mixed");
}

TEST(ScanConvert, BallMeshMatchesTheExactBallWithinItsFacets) {
    const geometry::TriangleMesh mesh = ball_mesh(0.5, 5);
    const auto c = converted(mesh, 64);
    const auto exact = make_ball(0.5, 64, {"ball", {}});
    ASSERT_TRUE(exact.has_value());
    ASSERT_EQ(c.solid.lattice, exact->lattice);
    double sagitta = 0;  // how far the facets lie inside the sphere at most
    for (const auto& t : mesh.triangles) {
        const Vec3& p = mesh.positions_m[t[0]];
        const Vec3 n = glm::cross(mesh.positions_m[t[1]] - p, mesh.positions_m[t[2]] - p);
        sagitta = std::max(sagitta, 0.5 - glm::dot(p, glm::normalize(n)));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t r = 0; r < exact->sets[axis].ray_count(); ++r) {
            const auto of_mesh = c.solid.sets[axis].ends(r), of_ball = exact->sets[axis].ends(r);
            if (of_mesh.empty()) continue;
            ASSERT_EQ(of_mesh.size(), of_ball.size());
            const double half = 0.5 * (depth_of(of_ball[1]) - depth_of(of_ball[0])) * exact->lattice.unit_m();
            for (std::size_t i = 0; i < 2; ++i) {
                const double inward =
                    (i == 0 ? 1 : -1) * (depth_of(of_mesh[i]) - depth_of(of_ball[i])) * exact->lattice.unit_m();
                ASSERT_GE(inward, -2 * exact->lattice.unit_m());
                // A radial sagitta is longer along a slanting ray.
                ASSERT_LE(inward, sagitta * 0.5 / std::max(half - inward, 1e-3) + 2 * exact->lattice.unit_m());
            }
        }
    }
    EXPECT_NEAR(mesh_volume(c.solid), volume_of(mesh), 2e-4);
}

TEST(ScanConvert, ThreadsDoNotChangeTheSolid) {
    WorkerPool one(1), five(5);
    Random random(3);
    const geometry::TriangleMesh mesh =
        joined(transformed(ball_mesh(0.5, 4), random_turn(random)), box_mesh(Vec3(0), Vec3(0.6), 4));
    const auto a = scan_convert(mesh, 48, one), b = scan_convert(mesh, 48, scan_pool()),
               c = scan_convert(mesh, 48, five);
    ASSERT_TRUE(a && b && c);
    EXPECT_TRUE(a->solid.same_content(b->solid));
    EXPECT_TRUE(a->solid.same_content(c->solid));
    EXPECT_EQ(a->crossings, c->crossings);
}

TEST(ScanConvert, MaterialsAndNormalsComeFromTheTriangles) {
    geometry::TriangleMesh mesh = box_mesh(Vec3(0), Vec3(1));
    mesh.materials = {{"low", {1, 2, 3}}, {"high", {4, 5, 6}}};
    for (const auto& t : mesh.triangles) {
        const bool top = mesh.positions_m[t[0]].z + mesh.positions_m[t[1]].z + mesh.positions_m[t[2]].z > 2.5;
        mesh.triangle_materials.push_back(top ? 1 : 0);
    }
    const auto c = converted(mesh, 20);
    int rays = 0;
    for (std::size_t r = 0; r < c.solid.sets[2].ray_count(); ++r) {
        const auto ends = c.solid.sets[2].ends(r);
        if (ends.empty()) continue;
        ++rays;
        EXPECT_EQ(material_of(ends[0]), 0u);
        EXPECT_EQ(material_of(ends[1]), 1u);
        EXPECT_EQ(ends[0].normal, c.solid.sets[2].ends(r)[0].normal);
        EXPECT_NE(ends[0].normal, ends[1].normal);
    }
    EXPECT_EQ(rays, 20 * 20);
    EXPECT_EQ(c.solid.materials.size(), 2u);
}

TEST(ScanConvert, NormalsOfATinyMeshAreTheLargeOnes) {
    const geometry::TriangleMesh large = ball_mesh(1.0, 3);
    geometry::TriangleMesh tiny = large;
    for (Vec3& p : tiny.positions_m) p *= 0x1p-29;  // 4 nm: areas squared underflow nothing
    const auto a = converted(large, 32), b = converted(tiny, 32);
    EXPECT_TRUE(a.solid.sets[0].same_content(b.solid.sets[0]));
    EXPECT_TRUE(a.solid.sets[2].same_content(b.solid.sets[2]));
}

TEST(ScanConvert, RefusesWhatHasNoInside) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    geometry::TriangleMesh open = box_mesh(Vec3(0), Vec3(1), 2);
    open.triangles.pop_back();
    EXPECT_NE(scan_refusal(open).find("holes"), std::string::npos);
    geometry::TriangleMesh not_finite = box_mesh(Vec3(0), Vec3(1));
    not_finite.positions_m[3].y = nan;
    EXPECT_NE(scan_refusal(not_finite).find("not finite"), std::string::npos);
    EXPECT_NE(scan_refusal(geometry::TriangleMesh{}).find("no triangles"), std::string::npos);
    EXPECT_NE(scan_refusal(box_mesh(Vec3(0), Vec3(1)), 8).find("16 to 2048"), std::string::npos);
    EXPECT_NE(scan_refusal(inverted(box_mesh(Vec3(0), Vec3(1)))).find("encloses no material"), std::string::npos);
    geometry::TriangleMesh flat = box_mesh(Vec3(0), Vec3(1, 1, 0));
    EXPECT_NE(scan_refusal(flat), "");
    geometry::TriangleMesh dangling = box_mesh(Vec3(0), Vec3(1));
    dangling.triangles[0][1] = 1000;
    EXPECT_NE(scan_refusal(dangling).find("does not exist"), std::string::npos);
    geometry::TriangleMesh unknown = box_mesh(Vec3(0), Vec3(1));
    unknown.triangle_materials.assign(unknown.triangles.size(), 3);
    EXPECT_NE(scan_refusal(unknown).find("material 3"), std::string::npos);
    unknown.triangle_materials.assign(5, 0);
    EXPECT_NE(scan_refusal(unknown).find("some triangles"), std::string::npos);
}

TEST(ScanConvert, OnAGivenLatticeItIsTheSameAndMustFit) {
    const geometry::TriangleMesh mesh = box_mesh(Vec3(0), Vec3(1), 2);
    const auto alone = converted(mesh, 32);
    const auto onto = scan_convert_onto(mesh, alone.solid.lattice, scan_pool());
    ASSERT_TRUE(onto);
    EXPECT_TRUE(onto->solid.same_content(alone.solid));
    const auto outside =
        scan_convert_onto(transformed(mesh, Quat(1, 0, 0, 0), Vec3(0.5, 0, 0)), alone.solid.lattice, scan_pool());
    ASSERT_FALSE(outside);
    EXPECT_NE(outside.error().line().find("lattice"), std::string::npos);
}

TEST(ScanConvert, AStrayVertexDoesNotStretchTheLattice) {
    geometry::TriangleMesh mesh = box_mesh(Vec3(0), Vec3(1));
    const Lattice alone = converted(mesh, 32).solid.lattice;
    mesh.positions_m.push_back(Vec3(1e6));
    EXPECT_EQ(converted(mesh, 32).solid.lattice, alone);
}

}  // namespace burin::compute::test

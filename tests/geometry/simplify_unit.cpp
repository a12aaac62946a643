// SPDX-License-Identifier: MIT
// Simplification against brute force: the distance both ways by dense samples and every triangle, on shapes of known
// form.
#include "geometry/mesh/simplify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/mesh/mesh_health.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

// A cube's surface of n x n squares a face; vertices shared.
TriangleMesh fine_cube(int n) {
    TriangleMesh mesh;
    std::vector<int> index(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), -1);
    const auto vertex = [&](int x, int y, int z) {
        int& i = index[static_cast<std::size_t>((z * (n + 1) + y) * (n + 1) + x)];
        if (i < 0) {
            i = static_cast<int>(mesh.positions_m.size());
            mesh.positions_m.push_back(Vec3(x, y, z) / static_cast<double>(n));
        }
        return static_cast<std::uint32_t>(i);
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            for (int v = 0; v < n; ++v) {
                for (int u = 0; u < n; ++u) {
                    const auto at = [&](int du, int dv) {
                        std::array<int, 3> p{};
                        p[static_cast<std::size_t>(axis)] = side * n;
                        p[static_cast<std::size_t>((axis + 1) % 3)] = u + du;
                        p[static_cast<std::size_t>((axis + 2) % 3)] = v + dv;
                        return vertex(p[0], p[1], p[2]);
                    };
                    const std::uint32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                    if (side == 1) {
                        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
                    } else {
                        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
                    }
                }
            }
        }
    }
    return mesh;
}

double distance_to(const TriangleMesh& mesh, const Vec3& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 at = nearest_point({mesh.positions_m[a], mesh.positions_m[b], mesh.positions_m[c]}, p);
        nearest = std::min(nearest, glm::length(at - p));
    }
    return nearest;
}

// One-sided, from a grid of samples on each triangle: never above the true distance.
double sampled_distance(const TriangleMesh& from, const TriangleMesh& to, int samples) {
    double farthest = 0.0;
    for (const auto& [a, b, c] : from.triangles) {
        for (int i = 0; i <= samples; ++i) {
            for (int j = 0; i + j <= samples; ++j) {
                const double s = static_cast<double>(i) / samples, t = static_cast<double>(j) / samples;
                const Vec3 p = from.positions_m[a] * (1.0 - s - t) + from.positions_m[b] * s + from.positions_m[c] * t;
                farthest = std::max(farthest, distance_to(to, p));
            }
        }
    }
    return farthest;
}

Simplified simplified(const TriangleMesh& mesh, double bound_m) {
    SimplifyOptions options;
    options.bound_m = bound_m;
    Result<Simplified> result = simplify(mesh, options);
    EXPECT_TRUE(result.has_value());
    return result ? std::move(*result) : Simplified{};
}

void expect_sound(const TriangleMesh& mesh) {
    const MeshHealth health = examine(mesh);
    EXPECT_TRUE(health.closed && health.consistently_oriented && health.manifold());
    EXPECT_EQ(health.unused_vertices, 0u);
    EXPECT_EQ(health.degenerate_triangles, 0u);
}

}  // namespace

TEST(Simplify, AFlatCubeComesDownToTwelveTriangles) {
    const Simplified result = simplified(fine_cube(12), 1e-6);
    EXPECT_EQ(result.mesh.triangles.size(), 12u);
    EXPECT_EQ(result.mesh.positions_m.size(), 8u);
    expect_sound(result.mesh);
    EXPECT_NEAR(examine(result.mesh).signed_volume_m3, 1.0, 1e-12);
    EXPECT_LE(result.error_m, 1e-6);
}

TEST(Simplify, NeverExceedsTheBoundByBruteForceBothWays) {
    const TriangleMesh first = torus(32, 16, 1.0, 0.3);
    std::size_t fewer_than = first.triangles.size();
    for (const double bound_m : {0.005, 0.02, 0.06}) {
        const Simplified result = simplified(first, bound_m);
        expect_sound(result.mesh);
        EXPECT_EQ(examine(result.mesh).shells, 1u);
        const double there_m = sampled_distance(first, result.mesh, 2),
                     back_m = sampled_distance(result.mesh, first, 8);
        EXPECT_LE(there_m, bound_m);
        EXPECT_LE(back_m, bound_m);
        // The measured error is a bound on what samples find, and says more than the bound that was asked.
        EXPECT_LE(std::max(there_m, back_m), result.error_m);
        EXPECT_LE(result.error_m, bound_m);
        EXPECT_LT(result.mesh.triangles.size(), fewer_than);
        fewer_than = result.mesh.triangles.size();
    }
    EXPECT_LT(fewer_than, first.triangles.size() / 3);  // so coarse a torus has no more to give within its bound
}

TEST(Simplify, VerticesThatRemainAreTheInputsToTheBit) {
    const TriangleMesh first = torus(24, 12, 1.0, 0.3);
    const Simplified result = simplified(first, 0.05);
    ASSERT_EQ(result.first_vertex.size(), result.mesh.positions_m.size());
    for (std::size_t v = 0; v < result.first_vertex.size(); ++v) {
        EXPECT_EQ(result.mesh.positions_m[v], first.positions_m[result.first_vertex[v]]);
    }
}

TEST(Simplify, KeptVerticesStay) {
    TriangleMesh mesh = fine_cube(6);
    SimplifyOptions options;
    options.bound_m = 0.01;
    for (std::uint32_t v = 0; v < mesh.positions_m.size(); v += 7) options.keep.push_back(v);
    const Result<Simplified> result = simplify(mesh, options);
    ASSERT_TRUE(result.has_value());
    for (const std::uint32_t v : options.keep) {
        EXPECT_NE(std::ranges::find(result->first_vertex, v), result->first_vertex.end()) << v;
    }
}

TEST(Simplify, AColourBorderKeepsItsPlace) {
    TriangleMesh mesh = fine_cube(20);
    for (const Vec3& p : mesh.positions_m) {
        const bool red = p.x < 0.52 - 0.1 * p.y;
        mesh.colours.push_back(red ? std::array<std::uint8_t, 3>{200, 0, 0} : std::array<std::uint8_t, 3>{0, 0, 200});
    }
    const Simplified result = simplified(mesh, 0.01);
    expect_sound(result.mesh);
    EXPECT_LT(result.mesh.triangles.size(), mesh.triangles.size() / 2);
    // Away from the border, nothing of the other colour: at every sample the colours of both meshes agree.
    for (const auto& [a, b, c] : result.mesh.triangles) {
        for (const auto& [s, t] : {std::pair{0.33, 0.33}, {0.8, 0.1}, {0.1, 0.8}, {0.1, 0.1}}) {
            const double r = 1.0 - s - t;
            const Vec3 p =
                result.mesh.positions_m[a] * r + result.mesh.positions_m[b] * s + result.mesh.positions_m[c] * t;
            const double red =
                result.mesh.colours[a][0] * r + result.mesh.colours[b][0] * s + result.mesh.colours[c][0] * t;
            const double past_border = p.x - (0.52 - 0.1 * p.y);
            if (past_border < -0.07) {
                EXPECT_GE(red, 200.0 - 13.0);
            }
            if (past_border > 0.07) {
                EXPECT_LE(red, 13.0);
            }
        }
    }
}

TEST(Simplify, ABorderOfMaterialsKeepsItsPlace) {
    TriangleMesh mesh = fine_cube(10);
    mesh.materials = {{"left", {}}, {"right", {}}};
    for (const auto& [a, b, c] : mesh.triangles) {
        const double x = (mesh.positions_m[a].x + mesh.positions_m[b].x + mesh.positions_m[c].x) / 3.0;
        mesh.triangle_materials.push_back(x < 0.4 ? 0 : 1);
    }
    const Simplified result = simplified(mesh, 0.001);
    expect_sound(result.mesh);
    ASSERT_EQ(result.mesh.triangle_materials.size(), result.mesh.triangles.size());
    EXPECT_LT(result.mesh.triangles.size(), 60u);
    double left_m2 = 0.0;
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
        const auto [a, b, c] = result.mesh.triangles[t];
        const Vec3 &p = result.mesh.positions_m[a], &q = result.mesh.positions_m[b], &r = result.mesh.positions_m[c];
        if (result.mesh.triangle_materials[t] == 0) left_m2 += glm::length(glm::cross(q - p, r - p)) / 2.0;
    }
    EXPECT_NEAR(left_m2, 1.0 + 4 * 0.4, 0.01);
}

TEST(Simplify, OpenBordersAndEmptyMeshesPass) {
    TriangleMesh open = fine_cube(6);
    open.triangles.resize(open.triangles.size() - 72);  // without its last face
    const MeshHealth before = examine(open);
    const Simplified result = simplified(open, 0.01);
    const MeshHealth after = examine(result.mesh);
    EXPECT_EQ(after.boundary_edges, before.boundary_edges);
    EXPECT_LT(after.triangles, before.triangles);
    EXPECT_TRUE(simplified(TriangleMesh{}, 0.01).mesh.triangles.empty());
    TriangleMesh folded = cube();
    folded.triangles.push_back({0, 0, 1});
    EXPECT_EQ(simplified(folded, 0.01).mesh.triangles.size(), 12u);
}

TEST(Simplify, RefusesWhatIsNoDistance) {
    for (const double bound_m : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        SimplifyOptions options;
        options.bound_m = bound_m;
        const auto result = simplify(cube(), options);
        ASSERT_FALSE(result.has_value());
        EXPECT_NE(result.error().line().find("metres, above zero"), std::string::npos) << result.error().line();
    }
}

TEST(SurfaceDistance, EqualsKnownDistances) {
    TriangleMesh far = fine_cube(3);
    for (Vec3& p : far.positions_m) p.x += 0.25;
    const TriangleMesh near = cube();
    const TriangleTree tree(near.positions_m, near.triangles);
    const SurfaceDistance d = distance_from(far.positions_m, far.triangles, near, tree, 1e-3);
    // The near face of the moved cube lies inside, 0.25 from the face it left; its middle is nowhere closer.
    EXPECT_GE(d.largest_m, 0.25);
    EXPECT_LE(d.largest_m, 0.25 + 1e-3);
    const SurfaceDistance none = distance_from(near.positions_m, near.triangles, near, tree, 1e-3);
    EXPECT_LE(none.largest_m, 1e-12);
}

}  // namespace burin::geometry::test

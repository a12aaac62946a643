// SPDX-License-Identifier: MIT
// The measures on meshes whose errors are known.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/measure/lost_intervals.hpp"
#include "bench/measure/point_distances.hpp"
#include "bench/measure/surface_errors.hpp"
#include "tests/compute/effort.hpp"

namespace burin::bench {
namespace {

using compute::test::Random;
using compute::test::repeated;

// The unit cube's faces as cells x cells squares, two triangles each; welded.
geometry::TriangleMesh cube_mesh(int cells) {
    geometry::TriangleMesh mesh;
    std::vector<std::uint32_t> index(static_cast<std::size_t>((cells + 1) * (cells + 1) * (cells + 1)), 0xffffffffu);
    const auto vertex = [&](const std::array<int, 3>& p) {
        auto& at = index[static_cast<std::size_t>((p[2] * (cells + 1) + p[1]) * (cells + 1) + p[0])];
        if (at == 0xffffffffu) {
            at = static_cast<std::uint32_t>(mesh.positions_m.size());
            mesh.positions_m.push_back(Vec3(p[0], p[1], p[2]) / static_cast<double>(cells));
        }
        return at;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {0, cells}) {
            for (int v = 0; v < cells; ++v) {
                for (int u = 0; u < cells; ++u) {
                    const auto at = [&](int du, int dv) {
                        std::array<int, 3> p{};
                        p[axis] = side;
                        p[(axis + 1) % 3] = u + du;
                        p[(axis + 2) % 3] = v + dv;
                        return vertex(p);
                    };
                    std::array<std::uint32_t, 4> q{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
                    if (side == 0) std::swap(q[1], q[3]);
                    mesh.triangles.push_back({q[0], q[1], q[2]});
                    mesh.triangles.push_back({q[0], q[2], q[3]});
                }
            }
        }
    }
    return mesh;
}

void move(geometry::TriangleMesh& mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions_m) p += by;
}

// Nothing is cut; the removed volume is a number to divide by.
const CarveScene kUntouched{"untouched", {}, 0.1};

}  // namespace

TEST(PointDistances, OfATriangleAreToItsNearestPart) {
    const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
    EXPECT_DOUBLE_EQ(point_triangle_distance({0.5, 0.5, -3}, a, b, c), 3.0);                           // above
    EXPECT_DOUBLE_EQ(point_triangle_distance({1, -2, 0}, a, b, c), 2.0);                               // an edge
    EXPECT_DOUBLE_EQ(point_triangle_distance({2, 2, 0}, a, b, c), std::sqrt(2.0));                     // the long edge
    EXPECT_DOUBLE_EQ(point_triangle_distance({-3, -4, 0}, a, b, c), 5.0);                              // a corner
    EXPECT_DOUBLE_EQ(point_triangle_distance({0, 3, 4}, Vec3(0), Vec3(1, 0, 0), Vec3(2, 0, 0)), 5.0);  // without area
}

TEST(PointDistances, EqualTheLeastOverAllTriangles) {
    Random random(1);
    geometry::TriangleMesh mesh;
    for (int i = 0; i < 300; ++i) {
        const Vec3 at(random.unit(), random.unit(), random.unit());
        for (int k = 0; k < 3; ++k) {
            const double size = random.chance(0.1) ? 0.5 : 0.05;
            mesh.positions_m.push_back(at + size * Vec3(random.unit(), random.unit(), random.unit()));
        }
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    std::vector<Vec3> points;
    for (int i = 0; i < repeated(800); ++i) {
        points.emplace_back(random.between(-1, 2), random.between(-1, 2), random.between(-1, 2));
    }
    const auto distances = distances_to_mesh(points, mesh, 0.01);
    for (std::size_t i = 0; i < points.size(); ++i) {
        double least = 1e9;
        for (const auto& [a, b, c] : mesh.triangles) {
            least = std::min(least, point_triangle_distance(points[i], mesh.positions_m[a], mesh.positions_m[b],
                                                            mesh.positions_m[c]));
        }
        EXPECT_EQ(distances[i], least);
    }
    EXPECT_TRUE(std::isinf(distances_to_mesh({Vec3(0.0)}, {}, 0.1).front()));
}

TEST(SurfaceErrors, AreNoneForTheExactCube) {
    const SurfaceErrors e = measure(cube_mesh(10), kUntouched, 0.1);
    EXPECT_EQ(e.triangles, 1200u);
    EXPECT_EQ(e.bad_edges, 0u);
    EXPECT_NEAR(e.volume_over_removed, 1.0, 1e-12);  // 0.1 too much, over 0.1
    EXPECT_NEAR(e.surface_m.max, 0.0, 1e-15);
    EXPECT_EQ(e.cut_m.samples, 0u);
    EXPECT_GT(e.edge_m.samples, 10000u);
    EXPECT_NEAR(e.edge_m.max, 0.0, 1e-15);
    EXPECT_EQ(e.corner_m.samples, 8u);
}

TEST(SurfaceErrors, SeeHowFarAMeshWasMoved) {
    geometry::TriangleMesh mesh = cube_mesh(10);
    constexpr double kBy = 0.003;
    move(mesh, {kBy, 0, 0});
    const SurfaceErrors e = measure(mesh, kUntouched, 0.1);
    EXPECT_NEAR(e.surface_m.max, kBy, 1e-15);
    EXPECT_NEAR(e.corner_m.max, kBy,
                1e-12);  // corners at x = 0 are that far outside, those at x = 1 are on a side face
    EXPECT_NEAR(e.corner_m.rms, kBy * std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(e.edge_m.max, kBy, 1e-12);
    EXPECT_NEAR(e.volume_over_removed, 1.0, 1e-9);
}

TEST(SurfaceErrors, SeeARoundedEdgeAndAHole) {
    geometry::TriangleMesh mesh = cube_mesh(50);
    constexpr double kIn = 0.002;
    for (Vec3& p : mesh.positions_m) {
        if (p.x == 0.0 && p.y == 0.0) p += Vec3(kIn, kIn, 0.0);
    }
    const SurfaceErrors rounded = measure(mesh, kUntouched, 0.02);
    EXPECT_NEAR(rounded.edge_m.max, kIn * std::sqrt(2.0), 1e-9);
    EXPECT_EQ(rounded.bad_edges, 0u);
    mesh.triangles.pop_back();
    EXPECT_EQ(measure(mesh, kUntouched, 0.02).bad_edges, 3u);
    mesh.triangles.push_back({0, 1, 2});
    EXPECT_GT(measure(mesh, kUntouched, 0.02).bad_edges, 3u);
}

TEST(SurfaceErrors, OfTheCutRegionAreThoseNearTheTool) {
    const Vec3 inside(0.5, 0.5, 0.985);
    const CarveScene scene{"dent", {{inside, inside, 0.03, 0}}, 0.1};  // which the mesh does not have
    const SurfaceErrors e = measure(cube_mesh(100), scene, 0.01);
    EXPECT_NEAR(e.cut_m.max, 0.015, 1e-3);  // above the ball's middle, which is 0.015 deep: its surface is as far away
    EXPECT_GT(e.cut_m.samples, 100u);
    EXPECT_LT(e.cut_m.samples, e.surface_m.samples / 20);
    EXPECT_GT(e.cut_m.rms, e.surface_m.rms);
    EXPECT_NEAR(e.rim_m.max, 0.0, 1e-12);  // the rim lies in the face, and the face is there
}

TEST(Intervals, OfTheUntouchedCubeAreAllThere) {
    const compute::Solid cube = *compute::make_block(Vec3(1.0), 32, {"cube", {}});
    const IntervalCheck check = check_intervals(cube, kUntouched, 500);
    EXPECT_EQ(check.rays, 1500u);
    EXPECT_EQ(check.lost, 0u);
    EXPECT_EQ(check.extra, 0u);
}

TEST(Intervals, ThatWereTakenAwayOrLeftAreFound) {
    compute::Solid cube = *compute::make_block(Vec3(1.0), 32, {"cube", {}});
    const CarveScene ball = ball_scene();
    const IntervalCheck uncut = check_intervals(cube, ball, 2000);
    EXPECT_EQ(uncut.lost, 0u);
    EXPECT_GT(uncut.extra, 100u);  // the ball is still there
    for (int u = 0; u < cube.lattice.rays_u(1); ++u) {
        for (int v = 0; v < cube.lattice.rays_v(1); ++v) cube.sets[1].replace(u, v, {});
    }
    const IntervalCheck emptied = check_intervals(cube, kUntouched, 2000);
    EXPECT_GT(emptied.lost, 1500u);  // every ray along y that meets the cube has lost its material
    EXPECT_LE(emptied.lost, 2000u);
    EXPECT_EQ(emptied.extra, 0u);
}

TEST(Intervals, OfAMeshAreComparedWithTheSolidBeforeTheFirstCut) {
    CarveScene scene = ball_scene();
    scene.workpiece_scene = cube_mesh(1);
    WorkerPool pool(1);
    const auto uncut = uncut_solid(scene, 32, pool);
    ASSERT_TRUE(uncut.has_value());
    const IntervalCheck not_cut = check_intervals(*uncut, scene, 1000, 1, &*uncut);
    EXPECT_EQ(not_cut.lost, 0u);
    EXPECT_GT(not_cut.extra, 50u);  // the ball is still there
    compute::Solid emptied = *uncut;
    for (int u = 0; u < emptied.lattice.rays_u(1); ++u) {
        for (int v = 0; v < emptied.lattice.rays_v(1); ++v) emptied.sets[1].replace(u, v, {});
    }
    EXPECT_GT(check_intervals(emptied, scene, 1000, 1, &*uncut).lost, 500u);
}

TEST(Intervals, OfATurnedCubeAreAllThereAndNoneOfAnUnturned) {
    const CarveScene scene = turned(kUntouched);
    WorkerPool pool(1);
    const auto cube = uncut_solid(scene, 32, pool);
    ASSERT_TRUE(cube.has_value());
    const IntervalCheck check = check_intervals(*cube, scene, 1000);
    EXPECT_EQ(check.lost, 0u);
    EXPECT_EQ(check.extra, 0u);
    const IntervalCheck other = check_intervals(*cube, kUntouched, 1000);
    EXPECT_GT(other.lost, 100u);
    EXPECT_GT(other.extra, 100u);
}

TEST(Intervals, ThreeUnitsTooShortAreFoundAndTwoAreRounding) {
    const auto with_ends_moved = [](int by_units) {
        compute::Solid cube = *compute::make_block(Vec3(1.0), 32, {"cube", {}});
        for (int u = 0; u < cube.lattice.rays_u(0); ++u) {
            for (int v = 0; v < cube.lattice.rays_v(0); ++v) {
                for (shared::DexelEnd& end :
                     cube.sets[0].ends_to_change(u, v).first(cube.sets[0].ends(u, v).size() / 2)) {
                    end.depth_material += static_cast<std::uint32_t>(by_units);
                }
            }
        }
        return check_intervals(cube, kUntouched, 1000).lost;
    };
    EXPECT_EQ(with_ends_moved(1), 0u);
    EXPECT_GT(with_ends_moved(4), 500u);
}

}  // namespace burin::bench

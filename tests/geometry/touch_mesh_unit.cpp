// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_mesh.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>
#include <tuple>

#include "base/newest_slot.hpp"
#include "geometry/contact/touch_facet.hpp"
#include "tests/geometry/touch_samples.hpp"

namespace burin::geometry::test {
namespace {

LocalSurface surface_of(TouchMesh& mesh, std::uint8_t material = 0) {
    LocalSurface surface;
    surface.meshes.push_back({mesh.snapshot(), material});
    return surface;
}

TouchMesh made(const TriangleMesh& mesh) { return std::move(TouchMesh::create(mesh).value()); }

TEST(TouchMesh, RefusesWhatIsNoMeshAndSaysWhy) {
    const TriangleMesh good = cube(1.0);
    EXPECT_EQ(TouchMesh::create({}).error().what, "there is no triangle");
    TriangleMesh bad = good;
    bad.triangles[3][1] = 8;
    EXPECT_EQ(TouchMesh::create(bad).error().what, "triangle 3 names vertex 8 of 8");
    for (const double x : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, 2e8}) {
        bad = good;
        bad.positions_m[5].y = x;
        EXPECT_EQ(TouchMesh::create(bad).error().what, "position 5 is not finite, or more than 1e8 m from the middle");
    }
}

TEST(TouchMesh, RefusesEditsThatNameWhatIsNotThereAndChangesNothing) {
    TouchMesh mesh = made(cube(1.0));
    const auto before = mesh.snapshot();
    const std::vector<std::uint32_t> eight{8}, twice{2, 2}, two{2}, twelve{12};
    const std::vector<Vec3> origin{Vec3(0.0)}, nowhere{Vec3(0.0, std::nan(""), 0.0)};
    EXPECT_EQ(mesh.move_vertices(eight, origin).error().what, "there is no vertex 8 of 8");
    EXPECT_EQ(mesh.move_vertices(two, {}).error().what, "1 vertices and 0 positions");
    EXPECT_FALSE(mesh.move_vertices(two, nowhere).has_value());
    EXPECT_EQ(mesh.move_all(origin).error().what, "1 positions for 8 vertices");
    EXPECT_EQ(mesh.replace(twelve, {}, {}).error().what, "there is no triangle 12");
    EXPECT_EQ(mesh.replace(twice, {}, {}).error().what, "a triangle is to be removed twice");
    const std::vector<VertexTriple> far{{0, 1, 9}};
    EXPECT_EQ(mesh.replace(two, far, origin).error().what, "triangle 0 names vertex 9 of 9");
    EXPECT_FALSE(mesh.replace(two, far, nowhere).has_value());
    EXPECT_EQ(mesh.snapshot(), before);
    ASSERT_TRUE(mesh.replace(two, {}, {}).has_value());
    EXPECT_EQ(mesh.replace(two, {}, {}).error().what, "there is no triangle 2");
}

TEST(TouchMesh, KeepsEveryTriangleUnderItsNumber) {
    const TriangleMesh source = ball(12, 0.05, Vec3(3.0, -2.0, 1.0));
    TouchMesh mesh = made(source);
    const auto snapshot = mesh.snapshot();
    ASSERT_EQ(snapshot->triangles(), source.triangles.size());
    std::set<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < snapshot->triangles(); ++i) {
        const Triangle t = snapshot->triangle(i);
        const VertexTriple& of_source = source.triangles[snapshot->mesh_triangle(i)];
        EXPECT_LT(glm::length(t.a + snapshot->origin_object - source.positions_m[of_source[0]]), 1e-8);
        EXPECT_LT(glm::length(t.b + snapshot->origin_object - source.positions_m[of_source[1]]), 1e-8);
        EXPECT_LT(glm::length(t.c + snapshot->origin_object - source.positions_m[of_source[2]]), 1e-8);
        seen.insert(snapshot->mesh_triangle(i));
    }
    EXPECT_EQ(seen.size(), source.triangles.size());
}

TEST(TouchFacet, WeighsEachCornerAsMaxDoes) {
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i) {
        const std::array<Vec3, 3> p{random_vector(random, 0.01), random_vector(random, 0.01),
                                    random_vector(random, 1.0)};
        const TouchFacet facet({p[0], p[1], p[2]}, 7);
        double edges_m = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 next = p[(k + 1) % 3] - p[k], before = p[(k + 2) % 3] - p[k];
            const Vec3 expected = glm::cross(next, before) / (glm::dot(next, next) * glm::dot(before, before));
            EXPECT_LT(glm::length(facet.weight[k] * facet.cross - expected), 1e-9 * glm::length(expected));
            edges_m += glm::length(next);
        }
        EXPECT_NEAR(facet.edge_sum_m, edges_m, 1e-6 * edges_m);
        EXPECT_EQ(facet.slot, 7u);
    }
}

TEST(TouchFacet, HasNoWeightWhereItHasNoAngleAndNoEdgesWithoutAnArea) {
    const Vec3 a(0.0), b(1.0, 0.0, 0.0);
    for (const Vec3& c : {a, b, Vec3(0.3, 0.0, 0.0), Vec3(0.3, 1e-7, 0.0)}) {
        const TouchFacet facet({a, b, c}, 0);
        EXPECT_EQ(facet.weight[0], 0.0);
        EXPECT_EQ(facet.weight[1], 0.0);
        EXPECT_EQ(facet.edge_sum_m, 0.0f);
    }
    const TouchFacet needle({a, b, Vec3(1.0, 5e-7, 0.0)}, 0);  // its tip has no direction, its base has
    EXPECT_EQ(needle.weight[0], 0.0);
    EXPECT_GT(needle.weight[1], 0.0);
    EXPECT_GT(needle.weight[2], 0.0);
}

// More triangles than facets are kept at a time, moved from one end to the other.
TEST(TouchMesh, AllOfALargeMeshMovesAsOneMadeAnew) {
    TriangleMesh source = ball(56, 0.05);  // 37632 triangles
    TouchMesh mesh = made(source);
    std::ignore = mesh.snapshot();
    for (Vec3& p : source.positions_m) p *= Vec3(1.0, 1.25, 1.0);
    ASSERT_TRUE(mesh.move_all(source.positions_m).has_value());
    const auto moved = mesh.snapshot();
    ASSERT_EQ(moved->triangles(), source.triangles.size());
    for (std::uint32_t i = 0; i < moved->triangles(); ++i) {
        const Triangle t = moved->triangle(i);
        const Vec3 outward = glm::normalize(t.a / Vec3(1.0, 1.5625, 1.0));  // of an ellipsoid: its gradient
        EXPECT_LT(glm::length(Vec3(moved->corner_normals(i).normals[0]) - outward), 2e-3);
    }
}

TEST(TouchMesh, NormalsOfABallAreRadialAndOneAtEachVertexWhateverThePatch) {
    TouchMesh mesh = made(ball(24, 0.05));  // 6912 triangles in 27 patches or more
    const auto snapshot = mesh.snapshot();
    EXPECT_GE(mesh.patches_made(), 27u);
    std::map<std::array<double, 3>, std::array<float, 3>> normal_at;
    for (std::uint32_t i = 0; i < snapshot->triangles(); ++i) {
        const Triangle t = snapshot->triangle(i);
        const CornerNormals corners = snapshot->corner_normals(i);
        ASSERT_TRUE(corners.known);
        const std::array<Vec3, 3> at{t.a, t.b, t.c};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3f n = corners.normals[k];
            EXPECT_LT(glm::length(Vec3(n) - glm::normalize(at[k])), 2e-5);  // float positions, edges of 3 mm
            const std::array<float, 3> bits{n.x, n.y, n.z};
            const auto [known, is_new] = normal_at.try_emplace({at[k].x, at[k].y, at[k].z}, bits);
            EXPECT_EQ(known->second, bits);
        }
    }
}

TEST(TouchMesh, NormalsOfACubeStayThoseOfItsFaces) {
    TouchMesh mesh = made(cube(0.5));
    const auto snapshot = mesh.snapshot();
    for (std::uint32_t i = 0; i < 12; ++i) {
        const Triangle t = snapshot->triangle(i);
        const Vec3 face = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
        for (const Vec3f& n : snapshot->corner_normals(i).normals) EXPECT_LT(glm::length(Vec3(n) - face), 1e-6);
    }
}

// Two long strips that meet along a ridge, which turns by the angle.
TriangleMesh ridge(double angle_rad) {
    TriangleMesh mesh;
    for (int j = 0; j <= 10; ++j) {
        const double z = 0.1 * j, y = -std::sin(angle_rad / 2), x = std::cos(angle_rad / 2);
        mesh.positions_m.insert(mesh.positions_m.end(), {Vec3(-x, y, z), Vec3(0, 0, z), Vec3(x, y, z)});
    }
    for (std::uint32_t j = 0; j < 10; ++j)
        for (std::uint32_t i = 0; i < 2; ++i) {
            const std::uint32_t a = 3 * j + i, b = a + 1, c = a + 3, d = a + 4;
            mesh.triangles.push_back({a, c, d});
            mesh.triangles.push_back({a, d, b});
        }
    return mesh;
}

TEST(TouchMesh, AnEdgeIsSmoothBelowFortyDegreesAndSharpAbove) {
    for (const double degrees : {10.0, 38.0, 42.0, 90.0, 170.0}) {
        const double angle = degrees * 3.14159265358979 / 180.0;
        TouchMesh mesh = made(ridge(angle));
        const auto snapshot = mesh.snapshot();
        for (std::uint32_t i = 0; i < snapshot->triangles(); ++i) {
            const Triangle t = snapshot->triangle(i);
            const Vec3 face = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
            const CornerNormals corners = snapshot->corner_normals(i);
            const std::array<Vec3, 3> at{t.a, t.b, t.c};
            for (std::size_t k = 0; k < 3; ++k) {
                const bool on_ridge = std::abs(at[k].x) < 1e-9;
                const double turned = std::acos(std::min(1.0, glm::dot(face, Vec3(corners.normals[k]))));
                // On a smooth ridge the normal is between those of the sides, at an end not half way.
                if (on_ridge && degrees < 40.0) {
                    EXPECT_GT(turned, 0.2 * angle) << degrees;
                }
                if (!on_ridge || degrees > 40.0) {
                    EXPECT_LT(turned, 1e-3) << degrees;
                }
            }
        }
    }
}

TEST(TouchMesh, ASnapshotStaysAsItWasWhileTheMeshIsEdited) {
    TriangleMesh source = ball(8, 0.05);
    TouchMesh mesh = made(source);
    const auto before = mesh.snapshot();
    std::vector<Corners> kept;
    for (std::uint32_t i = 0; i < before->triangles(); ++i) kept.push_back(corners_of(before->triangle(i)));
    for (Vec3& p : source.positions_m) p *= 1.5;
    ASSERT_TRUE(mesh.move_all(source.positions_m).has_value());
    std::vector<std::uint32_t> half;
    for (std::uint32_t i = 0; i < source.triangles.size(); i += 2) half.push_back(i);
    ASSERT_TRUE(mesh.replace(half, {}, {}).has_value());
    const auto after = mesh.snapshot();
    EXPECT_EQ(after->triangles(), source.triangles.size() / 2);
    ASSERT_EQ(before->triangles(), kept.size());
    for (std::uint32_t i = 0; i < before->triangles(); ++i) EXPECT_EQ(corners_of(before->triangle(i)), kept[i]);
}

TEST(TouchMesh, ASmallEditMakesFewPatchesAnew) {
    TriangleMesh source = ball(24, 0.05);  // 6912 triangles, at least 27 patches
    TouchMesh mesh = made(source);
    const auto first = mesh.snapshot();
    const std::uint64_t before = mesh.patches_made();
    EXPECT_GE(before, 27u);
    const std::vector<std::uint32_t> one{100};
    const std::vector<Vec3> place{source.positions_m[100] * 1.01};
    ASSERT_TRUE(mesh.move_vertices(one, place).has_value());
    const auto second = mesh.snapshot();
    EXPECT_NE(second, first);
    EXPECT_LE(mesh.patches_made() - before, 8u);  // a vertex and its ring: the patches that meet there
    EXPECT_EQ(mesh.snapshot(), second);           // nothing has changed
}

TEST(TouchMesh, ATriangleWithoutAreaIsNotFoundUntilItHasOne) {
    TriangleMesh source = cube(0.5);
    source.positions_m.push_back(source.positions_m[0]);
    source.triangles.push_back({0, 1, 8});
    TouchMesh mesh = made(source);
    EXPECT_EQ(mesh.snapshot()->triangles(), 12u);
    const std::vector<std::uint32_t> last{8};
    const std::vector<Vec3> away{Vec3(2.0)};
    ASSERT_TRUE(mesh.move_vertices(last, away).has_value());
    EXPECT_EQ(mesh.snapshot()->triangles(), 13u);
}

TEST(TouchMesh, LosesItsLastTriangleAndGetsNewOnes) {
    TouchMesh mesh = made(cube(0.5));
    std::vector<std::uint32_t> all(12);
    for (std::uint32_t i = 0; i < 12; ++i) all[i] = i;
    ASSERT_TRUE(mesh.replace(all, {}, {}).has_value());
    LocalSurface surface = surface_of(mesh);
    EXPECT_EQ(surface.triangles(), 0u);
    EXPECT_EQ(surface.mean_edge_m(), 0.0);
    EXPECT_TRUE(bounds(surface).empty());
    EXPECT_TRUE(for_each_triangle_near(surface, Vec3(-1.0), Vec3(1.0), [](auto, const auto&) { return false; }));
    const std::vector<VertexTriple> one{{0, 1, 8}};
    const std::vector<Vec3> place{Vec3(0.0)};
    ASSERT_EQ(mesh.replace({}, one, place).value().size(), 1u);
    EXPECT_EQ(mesh.triangles(), 1u);
    surface = surface_of(mesh);
    EXPECT_EQ(surface.triangles(), 1u);
    EXPECT_FALSE(for_each_triangle_near(surface, Vec3(-1.0), Vec3(1.0), [](auto, const auto&) { return false; }));
}

TEST(TouchMesh, IsFoundInALocalSurfaceOfAnotherOrigin) {
    const Vec3 far(400.0, -300.0, 700.0);
    TouchMesh mesh = made(ball(6, 0.05, far));
    TouchMesh other = made(cube(0.5));
    LocalSurface surface = surface_of(other, 1);
    surface.meshes.push_back({mesh.snapshot(), 2});
    surface.meshes.push_back({nullptr, 3});
    surface.origin_object = far + Vec3(1.0, 2.0, 3.0);
    EXPECT_EQ(surface.triangles(), 12u + 432u);
    EXPECT_EQ(surface.material(11), 1);
    EXPECT_EQ(surface.material(12), 2);
    EXPECT_DOUBLE_EQ(surface.mean_edge_m(), mesh.snapshot()->mean_edge_m());
    const Vec3 top = far + Vec3(0.0, 0.05, 0.0) - surface.origin_object;
    std::set<std::uint32_t> found;
    Near near{top, top, 0.001};
    for_each_triangle_near(surface, near, [&](std::uint32_t id, const Triangle& t) {
        found.insert(id);
        const Triangle again = surface.triangle(id);
        EXPECT_EQ(t.a, again.a);
        EXPECT_EQ(t.b, again.b);
        EXPECT_EQ(t.c, again.c);
        const Vec3 outward = glm::normalize(t.a + surface.origin_object - far);
        EXPECT_LT(glm::length(Vec3(surface.corner_normals(id).normals[0]) - outward), 2e-5);
        return true;
    });
    EXPECT_GE(found.size(), 4u);
    EXPECT_LE(found.size(), 12u);
    EXPECT_GE(*found.begin(), 12u);
    const Box box = bounds(surface);
    EXPECT_LE(box.lo.x, -0.5 - surface.origin_object.x);
    EXPECT_GE(box.hi.z, far.z + 0.05 - surface.origin_object.z - 1e-6);
}

TEST(TouchMesh, ASearchEndsWhenItsLooksAreUsedUp) {
    TouchMesh mesh = made(ball(30, 0.05));
    const LocalSurface surface = surface_of(mesh);
    const auto go = [&](std::uint32_t looks) {
        Near near{Vec3(-0.06), Vec3(0.06), 0.0, looks};
        std::uint32_t found = 0;
        const bool all = for_each_triangle_near(surface, near, [&](auto, const auto&) { return ++found > 0; });
        EXPECT_EQ(all, found == surface.triangles());
        return std::pair(found, looks - near.looks_left);
    };
    const auto [all, looks] = go(UINT32_MAX);
    EXPECT_EQ(all, surface.triangles());
    for (const std::uint32_t allowed : {0u, 1u, 17u, looks - 1}) {
        const auto [found, used] = go(allowed);
        EXPECT_LT(found, all);
        EXPECT_EQ(used, allowed);
    }
    EXPECT_EQ(go(looks).first, all);
}

TEST(TouchMesh, APointOnALargeMeshCostsFewLooks) {
    TouchMesh mesh = made(ball(40, 0.05));  // 19200 triangles
    const LocalSurface surface = surface_of(mesh);
    std::mt19937 random(4);
    std::uint32_t most = 0, sum = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = 0.05 * glm::normalize(random_vector(random, 1.0));
        Near near{p, p, 1e-6};
        for_each_triangle_near(surface, near, [](auto, const auto&) { return true; });
        most = std::max(most, UINT32_MAX - near.looks_left);
        sum += UINT32_MAX - near.looks_left;
    }
    EXPECT_LE(sum, 500u * 16u);  // 3 levels of nodes, a patch and a leaf or two, some triangles
    EXPECT_LE(most, 80u);
}

// One thread edits and publishes, the other touches: each surface it sees must be of one piece.
TEST(TouchMesh, AReaderSeesWholeSnapshotsWhileTheMeshIsEdited) {
    constexpr std::uint64_t kPublications = 60;
    TriangleMesh source = ball(10, 1.0);
    TouchMesh mesh = made(source);
    const std::vector<Vec3> directions = source.positions_m;
    NewestSlot<LocalSurface> slot;
    std::atomic<bool> done{false};
    std::uint64_t seen = 0, newest = 0;
    std::thread reader([&] {
        std::mt19937 random(7);
        // relaxed: only ends the loop; what is read comes through the slot.
        while (!done.load(std::memory_order_relaxed) || newest != kPublications) {
            const LocalSurface& surface = slot.newest();
            if (surface.sequence == 0) continue;
            EXPECT_GE(surface.sequence, newest);
            newest = surface.sequence;
            const double radius = 1.0 + 0.01 * static_cast<double>(surface.sequence);
            const Vec3 p = radius * glm::normalize(random_vector(random, 1.0));
            Near near{p, p, 0.1 * radius};
            for_each_triangle_near(surface, near, [&](std::uint32_t id, const Triangle& t) {
                EXPECT_NEAR(glm::length(t.a), radius, 1e-5);
                EXPECT_NEAR(glm::length(t.c), radius, 1e-5);
                EXPECT_NEAR(glm::length(Vec3(surface.corner_normals(id).normals[1])), 1.0, 1e-5);
                ++seen;
                return true;
            });
        }
    });
    for (std::uint64_t k = 1; k <= kPublications; ++k) {
        for (std::size_t i = 0; i < directions.size(); ++i)
            source.positions_m[i] = (1.0 + 0.01 * static_cast<double>(k)) * directions[i];
        ASSERT_TRUE(mesh.move_all(source.positions_m).has_value());
        LocalSurface& draft = slot.draft();
        draft.sequence = k;
        draft.meshes.assign(1, {mesh.snapshot(), 0});
        slot.publish();
    }
    done.store(true, std::memory_order_relaxed);
    reader.join();
    EXPECT_EQ(newest, kPublications);
    EXPECT_GT(seen, 0u);
}

}  // namespace
}  // namespace burin::geometry::test

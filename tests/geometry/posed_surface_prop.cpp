// SPDX-License-Identifier: MIT
// Meshes that have a pose: what a query finds in them, against looking at every triangle.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>
#include <set>

#include "geometry/mesh/triangle_tree.hpp"
#include "tests/geometry/touch_samples.hpp"

namespace burin::geometry::test {
namespace {

MeshMotion any_motion(std::mt19937& random, std::uint64_t body) {
    MeshMotion motion;
    motion.body = body;
    motion.object_from_mesh.position_m = random_vector(random, 0.3);
    const Vec3 q = random_vector(random, 1.0);
    motion.object_from_mesh.orientation = glm::normalize(Quat(0.3, q.x, q.y, q.z));
    return motion;
}

// A box that rests, balls that have been turned and moved, one of them at another pose than the published one, and a
// box that rests at a pose.
struct Scene {
    explicit Scene(std::mt19937& random) {
        surface.origin_object = random_vector(random, 1.0);
        surface.meshes.push_back({TouchMesh::create(cube(0.02))->snapshot(), 0});
        poses.emplace_back();
        for (std::uint64_t body = 1; body <= 2; ++body) {
            const int n = 2 + static_cast<int>(random() % 2);
            auto mesh = TouchMesh::create(ball(n, 0.05, random_vector(random, 0.1)));
            surface.meshes.push_back({mesh->snapshot(), 0, false, any_motion(random, body)});
            poses.push_back(surface.meshes.back().motion.object_from_mesh);
        }
        // The tick's pose; the published one stays behind.
        poses[2] = any_motion(random, 2).object_from_mesh;
        surface.meshes.push_back({TouchMesh::create(cube(0.03))->snapshot(), 0, false, any_motion(random, 0)});
        poses.push_back(surface.meshes.back().motion.object_from_mesh);
    }
    [[nodiscard]] PosedSurface posed() const {
        return {surface, followed, std::span<const Pose>(poses).subspan(1, followed.size())};
    }
    // The triangle where the mesh is, by the published surface and the two poses.
    [[nodiscard]] Triangle triangle(std::uint32_t id) const {
        Triangle t = surface.triangle(id);
        const std::uint32_t mesh = surface.mesh_of(id);
        const Pose& published = surface.meshes[mesh].motion.object_from_mesh;
        for (Vec3* const p : {&t.a, &t.b, &t.c})
            *p = poses[mesh] *
                     (glm::conjugate(published.orientation) * (*p + surface.origin_object - published.position_m)) -
                 surface.origin_object;
        return t;
    }

    // The same also where it is not part of a mesh.
    [[nodiscard]] Triangle place(std::uint32_t id) const {
        return surface.mesh_of(id) == LocalSurface::kNoMesh ? surface.triangle(id) : triangle(id);
    }

    LocalSurface surface;
    std::array<std::uint32_t, 2> followed{1, 2};
    std::vector<Pose> poses;  // of all meshes
};

bool same(const Triangle& a, const Triangle& b) {
    return glm::length(a.a - b.a) + glm::length(a.b - b.b) + glm::length(a.c - b.c) < 1e-12;
}

RC_GTEST_PROP(PosedSurface, IsFoundWhereItsMeshesAre, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const Scene scene(random);
    std::uniform_real_distribution<double> exponent(-4.0, -0.5);
    for (int i = 0; i < 3; ++i) {
        const Triangle near_it = scene.triangle(static_cast<std::uint32_t>(random() % scene.surface.triangles()));
        const double reach = std::pow(10.0, exponent(random));
        const Vec3 from = near_it.a + random_vector(random, reach), to = from + random_vector(random, reach);
        Near near{glm::min(from, to), glm::max(from, to), reach};
        if (random() % 2 == 0) near.by_way = true, near.from = from, near.to = to;
        std::map<std::uint32_t, Triangle> found;
        RC_ASSERT(for_each_triangle_near(scene.posed(), near, [&](std::uint32_t id, const Triangle& t) {
            return found.emplace(id, t).second;  // each once
        }));
        for (std::uint32_t id = 0; id < scene.surface.triangles(); ++id) {
            const Triangle t = scene.triangle(id);
            for (const Vec3& p : {from, to})
                if (glm::length(p - nearest_point({t.a, t.b, t.c}, p)) <= reach) RC_ASSERT(found.contains(id));
            if (const auto at = found.find(id); at != found.end()) RC_ASSERT(same(at->second, t));
        }
    }
}

RC_GTEST_PROP(PosedSurface, ItsPointsAndNormalsAreTurnedAsItsMeshesAre, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const Scene scene(random);
    const Box all = bounds(scene.posed());
    Near near{.lo = all.lo, .hi = all.hi, .reach_m = 10.0, .by_way = true, .from = all.center(), .to = all.center()};
    std::vector<std::pair<Vec3, Vec3>> corners;  // places and normals
    for (std::uint32_t id = 0; id < scene.surface.triangles(); ++id) {
        const Triangle t = scene.triangle(id);
        const CornerNormals normals = scene.posed().corner_normals(id);
        const std::array places{t.a, t.b, t.c};
        for (std::size_t k = 0; k < 3; ++k) corners.emplace_back(places[k], Vec3(normals.normals[k]));
    }
    std::size_t points = 0;
    const auto triangle = [](std::uint32_t, const Triangle&) { return true; };
    const auto point = [&](const SurfacePoint& p) {
        const Vec3 normal = p.normal();
        ++points;
        return std::ranges::any_of(corners, [&](const auto& corner) {
            return glm::length(corner.first - p.position) < 1e-9 && glm::length(corner.second - normal) < 1e-6;
        });
    };
    RC_ASSERT(for_each_near(scene.posed(), near, MixedVisitor{triangle, point, Fineness{1.0, 1}}));
    RC_ASSERT(points > 20u);
}

// A group is left out where its slab and its box say that it lies behind a plane: then every triangle of it must.
RC_GTEST_PROP(PosedSurface, LeavesOutNoTriangleThatRisesBeforeAPlane, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    Scene scene(random);
    auto loose = std::make_shared<GriddedTriangles>();
    for (const Vec3& p : ball(3, 0.04, random_vector(random, 0.1)).positions_m) loose->positions_m.emplace_back(p);
    loose->triangles = ball(3, 0.04, Vec3(0.0)).triangles;
    build_search(*loose);
    scene.surface.loose = loose;
    const Box all = bounds(scene.posed());
    const Vec3 normal = glm::normalize(random_vector(random, 1.0) + Vec3(1e-3));
    const std::uint32_t chosen = static_cast<std::uint32_t>(random() % scene.surface.triangles());
    const double top = glm::dot(normal, scene.place(chosen).a);
    Near near{.lo = all.lo, .hi = all.hi, .reach_m = 1.0, .by_way = true, .from = all.lo, .to = all.hi};
    std::set<std::uint32_t> seen;
    std::size_t left_out = 0;
    const auto triangle = [&](std::uint32_t id, const Triangle&) { return seen.insert(id), true; };
    const auto point = [](const SurfacePoint&) { return true; };
    const auto skips = [&](const Box& box, const TriangleSlab& slab) {
        const bool behind = highest(box, slab, normal) <= top;
        left_out += behind;
        return behind;
    };
    RC_ASSERT(for_each_near(scene.posed(), near, SkippingVisitor{triangle, point, Fineness{}, skips}));
    for (std::uint32_t id = 0; id < scene.surface.triangles(); ++id) {
        const Triangle t = scene.place(id);
        const double highest_corner = std::max({glm::dot(normal, t.a), glm::dot(normal, t.b), glm::dot(normal, t.c)});
        if (highest_corner > top + 1e-7 && !is_degenerate(t)) RC_ASSERT(seen.contains(id));
    }
    RC_CLASSIFY(left_out > 0, "groups left out");
}

// The slab of a flat group is as tight as the group, however it is turned to the axes.
TEST(TriangleSlab, OfAFlatGroupIsThatGroupsPlane) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const Vec3 up = glm::normalize(random_vector(random, 1.0) + Vec3(1e-3)), any = random_vector(random, 1.0);
        const Vec3 across = glm::normalize(glm::cross(up, any)), along = glm::cross(up, across);
        std::vector<Triangle> flat;
        Box box;
        for (int k = 0; k < 16; ++k) {
            const Vec3 a = 0.01 * up + 0.001 * k * across;
            flat.push_back({a, a + 0.001 * across, a + 0.001 * along});
            if (glm::dot(glm::cross(flat[0].b - flat[0].a, flat[0].c - flat[0].a), up) < 0.0)
                std::swap(flat.back().b, flat.back().c);
            for (const Vec3& p : {flat.back().a, flat.back().b, flat.back().c}) box.include(p);
        }
        const TriangleSlab slab = slab_around([&](auto&& visit) { std::ranges::for_each(flat, visit); });
        EXPECT_LT(std::abs(highest(box, slab, up) - 0.01), 1e-8);
        EXPECT_LT(std::abs(highest(box, slab, -up) + glm::dot(up, box.center())),
                  1e-12 + glm::dot(glm::abs(up), 0.5 * box.extent()));
    }
}

TEST(MeshMotion, MovesAndTurnsAboutTheMeshsOrigin) {
    const Pose start{{1.0, 0.0, 0.0}};
    const Pose later = moved_on(start, {0.0, 2.0, 0.0}, {0.0, 0.0, std::numbers::pi}, 0.5);
    EXPECT_LT(glm::length(later * Vec3(0.1, 0.0, 0.0) - Vec3(1.0, 1.1, 0.0)), 1e-12);
    MeshMotion motion;
    motion.time_ns = 1'000'000'000;
    EXPECT_EQ(followed_s(motion, 1'200'000'000, 0.5), 0.2);
    EXPECT_EQ(followed_s(motion, 9'000'000'000, 0.5), 0.5) << "then it stands";
    EXPECT_EQ(followed_s(motion, 0, 0.5), -0.5);
    EXPECT_TRUE(is_sensible(motion));
    motion.object_from_mesh.orientation.w = 0.5;
    EXPECT_FALSE(is_sensible(motion));
}

}  // namespace
}  // namespace burin::geometry::test

// SPDX-License-Identifier: MIT
// Smooth shapes that are known exactly, and meshes of them: what force shading is to feel like, and what it has to work
// with.
#pragma once

#include <cmath>

#include "geometry/contact/touch_mesh.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics::test {

// |p| = radius + bump * sin(waves x) sin(waves y) sin(waves z), x, y, z of the direction: metres, object frame.
struct BumpySphere {
    double radius_m = 0.05;
    double bump_m = 0.0;  // 0: a sphere
    double waves = 10.0;

    [[nodiscard]] double radius_towards(const Vec3& d) const {
        return radius_m + bump_m * std::sin(waves * d.x) * std::sin(waves * d.y) * std::sin(waves * d.z);
    }
    [[nodiscard]] Vec3 point(const Vec3& direction) const {
        const Vec3 d = glm::normalize(direction);
        return radius_towards(d) * d;
    }
    // Outward, by central differences of the implicit function |p| - radius_towards(p / |p|).
    [[nodiscard]] Vec3 normal(const Vec3& direction) const {
        const Vec3 p = point(direction);
        const auto f = [&](const Vec3& q) { return glm::length(q) - radius_towards(glm::normalize(q)); };
        const double h = 1e-6 * radius_m;
        Vec3 n;
        for (int k = 0; k < 3; ++k) {
            Vec3 step(0.0);
            step[k] = h;
            n[k] = f(p + step) - f(p - step);
        }
        return glm::normalize(n);
    }
    // Where a point on the surface comes to rest that is drawn to `hip` from near `start`: down the tangential pull in
    // small steps, until nothing pulls.
    [[nodiscard]] Vec3 resting_point(const Vec3& hip, const Vec3& start) const {
        Vec3 p = point(start);
        for (int i = 0; i < 3000; ++i) {
            const Vec3 n = normal(p), pull = hip - p, along = pull - glm::dot(pull, n) * n;
            if (glm::length(along) < 1e-10 * radius_m) break;
            p = point(p + 0.3 * along);
        }
        return p;
    }
};

// An icosahedron subdivided `times` times, its vertices on the shape.
inline geometry::TriangleMesh mesh_of(const BumpySphere& shape, int times) {
    const Surface unit = sphere(1.0, times);
    geometry::TriangleMesh mesh;
    for (const Vec3f& p : unit->loose->positions_m) mesh.positions_m.push_back(shape.point(Vec3(p)));
    mesh.triangles = unit->loose->triangles;
    return mesh;
}

// A mesh with the normals of the smooth surface at its corners, ready to touch.
inline Surface touchable(const geometry::TriangleMesh& mesh) {
    auto surface = std::make_unique<geometry::LocalSurface>();
    surface->sequence = 1;
    surface->radius_m = 1e3;
    surface->meshes.push_back({geometry::TouchMesh::create(mesh)->snapshot(), 0});
    surface->origin_object = surface->meshes[0].snapshot->origin_object;
    return surface;
}

}  // namespace burin::haptics::test

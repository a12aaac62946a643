// SPDX-License-Identifier: MIT
// Small closed meshes in metres, with known volumes.
#pragma once

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute::test {

// An axis-aligned box; each face is divided into n x n squares of two triangles.
[[nodiscard]] geometry::TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi, int n = 1);
// A prism with a regular polygon of `sides` corners in the xy plane, z from 0 to `height`.
[[nodiscard]] geometry::TriangleMesh prism_mesh(int sides, double radius, double height);
// A ball about the origin: an octahedron subdivided `levels` times, its vertices on the sphere.
[[nodiscard]] geometry::TriangleMesh ball_mesh(double radius, int levels);

[[nodiscard]] geometry::TriangleMesh joined(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b);
[[nodiscard]] geometry::TriangleMesh inverted(geometry::TriangleMesh mesh);
[[nodiscard]] geometry::TriangleMesh transformed(geometry::TriangleMesh mesh, const Quat& orientation,
                                                 const Vec3& translation = Vec3(0.0));
// By the divergence theorem.
[[nodiscard]] double volume_of(const geometry::TriangleMesh& mesh);
[[nodiscard]] double area_of(const geometry::TriangleMesh& mesh);

}  // namespace burin::compute::test

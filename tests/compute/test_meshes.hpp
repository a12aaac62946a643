// SPDX-License-Identifier: MIT
// Small closed meshes in metres, with known volumes.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace burin::test {

// An axis-aligned box; each face is divided into n x n squares of two triangles.
[[nodiscard]] TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi, int n = 1);
// A prism with a regular polygon of `sides` corners in the xy plane, z from 0 to `height`.
[[nodiscard]] TriangleMesh prism_mesh(int sides, double radius, double height);
// A ball about the origin: an octahedron subdivided `levels` times, its vertices on the sphere.
[[nodiscard]] TriangleMesh ball_mesh(double radius, int levels);

[[nodiscard]] TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);
[[nodiscard]] TriangleMesh inverted(TriangleMesh mesh);
[[nodiscard]] TriangleMesh transformed(TriangleMesh mesh, const Quat& orientation, const Vec3& translation = Vec3(0.0));
// By the divergence theorem.
[[nodiscard]] double volume_of(const TriangleMesh& mesh);
[[nodiscard]] double area_of(const TriangleMesh& mesh);

}  // namespace burin::test

// SPDX-License-Identifier: MIT
// How far points are from a mesh: the exact distance to the nearest of its triangles, for tens of thousands of points and
// tens of millions of triangles.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace burin::bench {

// The distance from p to the triangle abc, also where it has no area.
[[nodiscard]] double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// One for each point; infinity only for a mesh without triangles. The points lie in a search grid and the triangles pass by:
// each pass looks within a radius, starting at first_radius_m, and those points that found nothing there go on with four
// times as much. So cost is one look at each triangle when the mesh is near every point.
[[nodiscard]] std::vector<double> distances_to_mesh(const std::vector<Vec3>& points, const TriangleMesh& mesh,
                                                    double first_radius_m);

}  // namespace burin::bench

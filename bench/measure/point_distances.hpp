// SPDX-License-Identifier: MIT
// Measures the distance of points from a mesh: exactly to the nearest of its triangles, for tens of thousands of points
// and tens of millions of triangles.
#pragma once

#include <vector>

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

// Returns the distance from p to the triangle abc, which may have no area.
[[nodiscard]] double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// Returns one distance for each point; infinity only for a mesh without triangles. The points
// lie in a search grid, and each pass tests all triangles against the points within a radius,
// starting at first_radius_m; points without a triangle in that radius go on to a pass with
// four times the radius. So if the mesh is near every point, each triangle is tested once.
[[nodiscard]] std::vector<double> distances_to_mesh(const std::vector<Vec3>& points, const geometry::TriangleMesh& mesh,
                                                    double first_radius_m);

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
// Meshes with the connectivity of a cube whose faces have n by n squares: 12 n^2 triangles, closed, turned outwards.
#pragma once

#include <array>
#include <functional>

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

// Where the vertex is that lies so many squares along each axis of the cube, 0 to n; asked once for each vertex.
using PlaceOnCube = std::function<Vec3(const std::array<int, 3>& at)>;

[[nodiscard]] geometry::TriangleMesh mesh_of_cube(int squares_a_side, const PlaceOnCube& place);

// Returns the number of squares a side that gives about so many triangles.
[[nodiscard]] int squares_for(std::size_t triangles);

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
// A copy of a mesh with few triangles, made quickly for a first picture of it. Pure; any thread.
#pragma once

#include <cstddef>

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// Returns the mesh itself where it has at most so many triangles. Otherwise all vertices within one cell of a grid
// become one, in their mean, and triangles that lose their area go; the grid has so many cells along the longest side.
// Materials are kept. The copy may be open, and may pass through itself. Linear in the mesh, and 4 bytes for each cell
// of the grid.
[[nodiscard]] TriangleMesh coarse_copy(const TriangleMesh& mesh, std::size_t most_triangles, int cells);

}  // namespace burin::geometry

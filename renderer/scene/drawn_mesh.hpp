// SPDX-License-Identifier: MIT
// A mesh that a scene draws as it is: a tool's shape, an object of a world. It never changes once it is made, so that
// scenes share it and the renderer keeps one copy of it on the device (renderer/frame/mesh_store.hpp).
// Positions are in metres in the mesh's own frame. Pure; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/space.hpp"
#include "geometry/mesh/triangle_mesh.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::renderer {

struct DrawnMesh {
    std::vector<shared::SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;  // three for each triangle, counter-clockwise seen from outside
    Box bounds;
};

// Edges at which faces turn by more than this are drawn sharp; about 40 degrees.
inline constexpr double kCreaseCosine = 0.766;

// Returns the mesh with a normal for each corner: the mean of the faces that meet there and turn from the corner's own
// by less than a crease (to 4 degrees, where hundreds meet), weighted by area. Each triangle has its material's colour
// where the mesh has materials, and is white, to be tinted, where it has none. Triangles without area are left out.
[[nodiscard]] std::shared_ptr<const DrawnMesh> drawn_mesh(const geometry::TriangleMesh& mesh);

}  // namespace burin::renderer

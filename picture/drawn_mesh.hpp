// SPDX-License-Identifier: MIT
// A mesh that a scene draws as it is: a tool's shape, an object of a world. It never changes once it is made, so that
// scenes share it and the renderer keeps one copy of it on the device (renderer/frame/mesh_store.hpp).
// Positions are in metres in the mesh's own frame. Pure; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/space.hpp"
#include "geometry/contact/surface_tile.hpp"
#include "geometry/mesh/triangle_mesh.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::picture {

struct DrawnMesh {
    std::vector<shared::SurfaceVertex> vertices;
    std::vector<geometry::VertexLight> lights = {};  // one for each vertex; empty: all has full light
    std::vector<std::uint32_t> indices;              // three for each triangle, counter-clockwise seen from outside
    Box bounds;
};

// Returns a mesh that is smooth everywhere, with a normal for each place: the mean of the faces around it, weighted by
// area. White, to be tinted, unless there is a colour for each place; with the lights that are given, or full light.
// For meshes that are made anew for each frame: linear in the triangles.
[[nodiscard]] std::shared_ptr<const DrawnMesh> smooth_mesh(std::span<const Vec3> places_m,
                                                           std::span<const std::array<std::uint32_t, 3>> triangles,
                                                           std::span<const std::uint32_t> colours = {},
                                                           std::vector<geometry::VertexLight> lights = {});

// Edges at which faces turn by more than this are drawn sharp; about 40 degrees.
inline constexpr double kCreaseCosine = 0.766;

// Returns the mesh with a normal for each corner: the mean of the faces that meet there and turn from the corner's own
// by less than a crease (to 4 degrees, where hundreds meet), weighted by area. Each triangle has its material's colour
// where the mesh has materials, and is white, to be tinted, where it has none; or its corners have the colours (sRGB)
// that are given, one entry for each triangle. Triangles without area are left out.
using TriangleColours = std::array<std::array<std::uint8_t, 3>, 3>;
[[nodiscard]] std::shared_ptr<const DrawnMesh> drawn_mesh(const geometry::TriangleMesh& mesh,
                                                          std::span<const TriangleColours> colours = {});

}  // namespace burin::picture

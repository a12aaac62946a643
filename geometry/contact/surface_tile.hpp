// SPDX-License-Identifier: MIT
// One tile of a carved surface, as it is drawn and touched: the triangles around the lattice edges of a cube of kCells
// cells a side (compute/mesher/tile_mesher.hpp makes them).
//
// A published tile never changes: an update makes a new one. So the renderer, the haptic thread and an export may go on
// reading the tiles that they hold while carving goes on, without copies and without locks.
// Frame: the object frame, relative to the lattice's origin, metres.
// The light of its vertices is kept beside the tile (VertexLight), since it changes with the material around it too.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/space.hpp"
#include "geometry/contact/triangle_slab.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::geometry {

struct SurfaceTile {
    static constexpr int kCells = 16;

    // One vertex for each smooth piece of surface that meets in a cell: along a sharp edge two vertices share a
    // position and differ in normal and colour.
    std::vector<shared::SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise seen from outside

    // One entry for each crossed lattice edge, in increasing order: ((axis * 16 + y) * 16 + x) * 16 + z of the edge's
    // lower node, counted from the tile's first node, plus the flag bits below. A quad (two triangles) or a fan of more
    // triangles surrounds the edge. Its corners are in the four cells around the edge, or up to half a cell beside
    // them.
    static constexpr std::uint16_t kQuadEdge = 0x3fff, kOtherDiagonal = 0x4000, kDisagrees = 0x8000;
    std::vector<std::uint16_t> quads;
    [[nodiscard]] bool only_quads() const { return indices.size() == quads.size() * 6; }
    // Row axis * 16 + y has the quads [row_quads[row], row_quads[row + 1]) and the triangles from row_triangles[row]
    // on.
    static constexpr std::size_t kRows = 3 * kCells;
    std::array<std::uint16_t, kRows + 1> row_quads{};
    std::array<std::uint32_t, kRows + 1> row_triangles{};
    float longest_edge_m = 0.0f;  // of all triangles
    TriangleSlab slab;            // around all triangles

    [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

[[nodiscard]] inline Vec3f place_of(const shared::SurfaceVertex& v) noexcept { return {v.x, v.y, v.z}; }

// The share of light that reaches a vertex past the workpiece itself, from 0 (none) to 255 (all): computed by
// compute/light/tile_light.hpp, drawn by renderer/. The two bytes are in memory as the vertex shader reads them.
struct VertexLight {
    std::uint8_t sun = 255;   // from the lamp
    std::uint8_t open = 255;  // from the surroundings
    bool operator==(const VertexLight&) const = default;
};
static_assert(sizeof(VertexLight) == 2);

}  // namespace burin::geometry

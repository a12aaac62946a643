// SPDX-License-Identifier: MIT
// Makes one patch of a touched mesh from the triangles that it is to hold. Publisher's thread only; allocates.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/touch_patch.hpp"
#include "geometry/touch_surface.hpp"

namespace burin {

class TouchPatchMaker {
public:
    // Triangles by slot, at most TouchPatch::kMostTriangles, neighbours side by side. Degenerate ones are left out, so that the
    // patch may even be empty. mesh_index tells of each slot of the surface which triangle of the mesh it is.
    [[nodiscard]] std::shared_ptr<const TouchPatch> make(TouchSurface& surface, std::span<const std::uint32_t> slots,
                                                         std::span<const std::uint32_t> mesh_index);

private:
    struct Split {  // a vertex with several normals: its pieces, of pieces_
        std::uint32_t vertex = 0, first = 0, count = 0;
    };
    struct SplitPiece {
        TouchSurface::Piece piece;
        std::uint16_t local = kNone;  // the same for all triangles of the piece
    };

    void take_triangles(TouchPatch& patch, const TouchSurface& surface, std::span<const std::uint32_t> slots);
    void take_vertices(TouchPatch& patch, TouchSurface& surface);
    std::uint16_t add_vertex(std::uint32_t vertex, const Vec3f& position_m, const Vec3f& normal);
    std::uint16_t vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot);
    std::uint16_t split_vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot);
    void keep_pieces(TouchSurface& surface, std::uint32_t vertex);
    void box_triangles(TouchPatch& patch);

    static constexpr std::uint16_t kNone = 0xffffu;

    std::array<std::uint32_t, TouchPatch::kMostTriangles> slots_{};  // of the patch's triangles

    // Where a mesh vertex is in the patch being made: its number there; of a split one, its place in splits_. It may be out
    // of date, and then the vertex of that number, or the split, is another one: so nothing has to be wiped for the next patch.
    std::vector<std::uint16_t> place_of_;
    std::vector<Split> splits_;
    std::vector<SplitPiece> pieces_;
    // The patch's vertices.
    static constexpr std::size_t kMostVertices = 3 * TouchPatch::kMostTriangles;
    std::uint32_t vertices_ = 0;
    std::array<std::uint32_t, kMostVertices> mesh_vertex_{};
    std::array<Vec3f, kMostVertices> positions_m_{}, normals_{};
};

}  // namespace burin

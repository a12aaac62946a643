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
    // Where a mesh vertex is in the patch being made; of an earlier patch when the number does not match.
    struct Mark {
        std::uint32_t patch = 0;
        std::uint32_t local = 0;  // the vertex of the patch; of a split one, its place in splits_
    };
    struct Split {  // a vertex with several normals: its pieces, of all_pieces_
        std::uint32_t first = 0, count = 0;
    };
    struct SplitPiece {
        TouchSurface::Piece piece;
        std::uint32_t local = TouchSurface::kNone;  // the same for all triangles of the piece
    };

    void add_triangle(TouchPatch& patch, std::uint32_t mesh_triangle, const std::array<std::uint16_t, 3>& corners);
    std::uint16_t add_vertex(const Vec3f& position_m, const Vec3f& normal);
    std::uint16_t vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot);
    std::uint16_t split_vertex_of(const TouchSurface& surface, const Split& split, std::uint32_t vertex,
                                  std::uint32_t slot);
    void keep_pieces(TouchSurface& surface, std::uint32_t vertex);
    void box_triangles(TouchPatch& patch);

    std::uint32_t patch_number_ = 0;
    std::vector<Mark> marks_;
    std::vector<Split> splits_;
    std::vector<SplitPiece> pieces_;
    std::vector<Vec3f> positions_m_, normals_;                   // of the patch's vertices
    std::array<Vec3f, TouchPatch::kMostTriangles> lo_{}, hi_{};  // of its triangles
};

}  // namespace burin

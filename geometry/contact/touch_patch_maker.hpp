// SPDX-License-Identifier: MIT
// Makes one patch of a touched mesh from the triangles that it will hold. Publisher's thread only; allocates.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/contact/touch_patch.hpp"
#include "geometry/contact/touch_surface.hpp"

namespace burin::geometry {

class TouchPatchMaker {
public:
    // Makes a patch of the triangles in these slots, at most TouchPatch::kMostTriangles, neighbours side by side.
    // Degenerate triangles are left out, so the patch may even be empty. mesh_index gives the mesh index of each slot
    // of the surface.
    [[nodiscard]] std::shared_ptr<const TouchPatch> make(TouchSurface& surface, std::span<const std::uint32_t> slots,
                                                         std::span<const std::uint32_t> mesh_index);

private:
    // A vertex with several normals; its pieces are the range [first, first + count) of pieces_.
    struct Split {
        std::uint32_t vertex = 0, first = 0, count = 0;
    };
    struct SplitPiece {
        TouchSurface::Piece piece;
        std::uint16_t local = kNone;  // index in the patch, the same for all triangles of the piece
    };

    void take_triangles(TouchPatch& patch, const TouchSurface& surface, std::span<const std::uint32_t> slots);
    void take_vertices(TouchPatch& patch, TouchSurface& surface);
    std::uint16_t add_vertex(std::uint32_t vertex, const Vec3f& position_m, const Vec3f& normal);
    std::uint16_t vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot);
    std::uint16_t split_vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot);
    void keep_pieces(TouchSurface& surface, std::uint32_t vertex);
    void box_triangles(TouchPatch& patch);
    static void slab_triangles(TouchPatch& patch);

    static constexpr std::uint16_t kNone = 0xffffu;

    std::array<std::uint32_t, TouchPatch::kMostTriangles> slots_{};  // slots of the patch's triangles

    // Index of each mesh vertex in the patch being made; for a split vertex, its index in splits_. An entry may be
    // stale, which shows when the vertex or split at that index belongs to another mesh vertex; so the table need not
    // be cleared between patches.
    std::vector<std::uint16_t> place_of_;
    std::vector<Split> splits_;
    std::vector<SplitPiece> pieces_;
    // The patch's vertices.
    static constexpr std::size_t kMostVertices = 3 * TouchPatch::kMostTriangles;
    std::uint32_t vertices_ = 0;
    std::array<std::uint32_t, kMostVertices> mesh_vertex_{};
    std::array<Vec3f, kMostVertices> positions_m_{}, normals_{};
};

}  // namespace burin::geometry

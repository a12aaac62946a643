// SPDX-License-Identifier: MIT
#include "geometry/touch_patch_maker.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

double edge_lengths(const Triangle& t) {
    const auto length = [](const Vec3& v) { return std::sqrt(glm::dot(v, v)); };
    return length(t.b - t.a) + length(t.c - t.b) + length(t.a - t.c);
}

}  // namespace

std::shared_ptr<const TouchPatch> TouchPatchMaker::make(TouchSurface& surface, std::span<const std::uint32_t> slots,
                                                        std::span<const std::uint32_t> mesh_index) {
    auto patch = std::make_shared<TouchPatch>();
    ++patch_number_;
    marks_.resize(surface.vertices());
    splits_.clear(), pieces_.clear(), positions_m_.clear(), normals_.clear();
    patch->mesh_triangles.reserve(slots.size());
    patch->leaves.reserve((slots.size() + TouchBoxes::kMost - 1) / TouchBoxes::kMost);
    for (const std::uint32_t slot : slots) {
        const auto [a, b, c] = surface.triangle(slot);
        const Triangle t{Vec3(surface.position_m(a)), Vec3(surface.position_m(b)), Vec3(surface.position_m(c))};
        if (is_degenerate(t)) continue;
        patch->edge_sum_m += edge_lengths(t);
        add_triangle(*patch, mesh_index[slot],
                     {vertex_of(surface, a, slot), vertex_of(surface, b, slot), vertex_of(surface, c, slot)});
    }
    patch->positions_m.assign(positions_m_.begin(), positions_m_.end());
    patch->normals.assign(normals_.begin(), normals_.end());
    box_triangles(*patch);
    return patch;
}

void TouchPatchMaker::add_triangle(TouchPatch& patch, std::uint32_t mesh_triangle,
                                   const std::array<std::uint16_t, 3>& corners) {
    const std::uint32_t number = patch.triangles++, i = number % TouchBoxes::kMost;
    if (i == 0) patch.leaves.emplace_back();
    patch.leaves.back().corners[i] = corners;
    patch.mesh_triangles.push_back(mesh_triangle);
    const Vec3f &a = positions_m_[corners[0]], &b = positions_m_[corners[1]], &c = positions_m_[corners[2]];
    lo_[number] = lower_of(lower_of(a, b), c);
    hi_[number] = upper_of(upper_of(a, b), c);
}

std::uint16_t TouchPatchMaker::add_vertex(const Vec3f& position_m, const Vec3f& normal) {
    positions_m_.push_back(position_m);
    normals_.push_back(normal);
    return static_cast<std::uint16_t>(positions_m_.size() - 1);
}

std::uint16_t TouchPatchMaker::vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot) {
    Mark& mark = marks_[vertex];
    const bool known = mark.patch == patch_number_;
    mark.patch = patch_number_;
    if (!surface.is_split(vertex)) {
        if (!known) mark.local = add_vertex(surface.position_m(vertex), surface.normal(vertex));
        return static_cast<std::uint16_t>(mark.local);
    }
    if (!known) {
        mark.local = static_cast<std::uint32_t>(splits_.size());
        keep_pieces(surface, vertex);
    }
    return split_vertex_of(surface, splits_[mark.local], vertex, slot);
}

void TouchPatchMaker::keep_pieces(TouchSurface& surface, std::uint32_t vertex) {
    const auto pieces = surface.pieces_at(vertex);
    splits_.push_back({static_cast<std::uint32_t>(pieces_.size()), static_cast<std::uint32_t>(pieces.size())});
    for (const TouchSurface::Piece& piece : pieces) pieces_.push_back({piece});
}

std::uint16_t TouchPatchMaker::split_vertex_of(const TouchSurface& surface, const Split& split, std::uint32_t vertex,
                                               std::uint32_t slot) {
    const std::span<SplitPiece> pieces(pieces_.data() + split.first, split.count);
    const auto own = std::ranges::lower_bound(pieces, slot, {}, [](const SplitPiece& p) { return p.piece.slot; });
    // The piece is numbered by the place of its first triangle; that one keeps the vertex for all.
    SplitPiece& first = pieces[own->piece.piece];
    if (first.local == TouchSurface::kNone) first.local = add_vertex(surface.position_m(vertex), own->piece.normal);
    return static_cast<std::uint16_t>(first.local);
}

void TouchPatchMaker::box_triangles(TouchPatch& patch) {
    patch.count = static_cast<std::uint32_t>(patch.leaves.size());
    if (patch.triangles == 0) return;
    std::array<Vec3f, TouchBoxes::kMost> leaf_lo, leaf_hi;
    for (std::uint32_t i = 0; i < patch.triangles; ++i) {
        const std::uint32_t leaf = i / TouchBoxes::kMost;
        const bool first = i % TouchBoxes::kMost == 0;
        leaf_lo[leaf] = first ? lo_[i] : lower_of(leaf_lo[leaf], lo_[i]);
        leaf_hi[leaf] = first ? hi_[i] : upper_of(leaf_hi[leaf], hi_[i]);
    }
    Vec3f lo = leaf_lo[0], hi = leaf_hi[0];
    for (std::uint32_t leaf = 1; leaf < patch.count; ++leaf)
        lo = lower_of(lo, leaf_lo[leaf]), hi = upper_of(hi, leaf_hi[leaf]);
    patch.frame = TouchFrame::around(lo, hi);
    for (std::uint32_t leaf = 0; leaf < patch.count; ++leaf)
        patch.boxes.set(leaf, patch.frame.stepped(leaf_lo[leaf], leaf_hi[leaf]));
    for (std::uint32_t i = 0; i < patch.triangles; ++i)
        patch.leaves[i / TouchBoxes::kMost].boxes.set(i % TouchBoxes::kMost, patch.frame.stepped(lo_[i], hi_[i]));
}

}  // namespace burin

// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_patch_maker.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "geometry/mesh/componentwise.hpp"

namespace burin::geometry {
namespace {

// A corner's quantised coordinates along x, y and z, followed by 255 minus each. So the bytewise minimum over several
// corners holds all six sides of their bounding box. Quantisation is monotonic, so quantising before or after taking
// the minimum gives the same box: every vertex is quantised only once.
using Sides [[gnu::vector_size(16)]] = std::uint8_t;

Sides least(const Sides& a, const Sides& b) { return a < b ? a : b; }

Sides sides_of(const TouchFrame& frame, const Vec3f& p) {
    const std::uint8_t x = frame.step(0, p.x), y = frame.step(1, p.y), z = frame.step(2, p.z);
    const std::uint32_t all = 0xffffffu, up = x | std::uint32_t{y} << 8 | std::uint32_t{z} << 16;
    return std::bit_cast<Sides>(std::array<std::uint64_t, 2>{up | std::uint64_t{all ^ up} << 24, 0});
}

SteppedBox box_of(const Sides& sides) {
    const auto s = std::bit_cast<std::array<std::uint64_t, 2>>(sides)[0];
    const auto at = [&](int i) { return static_cast<std::uint8_t>(s >> 8 * i); };
    const auto upper = [&](int i) { return static_cast<std::uint8_t>(~(s >> 8 * i)); };
    return {{at(0), at(1), at(2)}, {upper(3), upper(4), upper(5)}};
}

TouchFrame frame_around(std::span<const Vec3f> positions_m) {
    Vec3f lo = positions_m.front(), hi = lo;
    for (const Vec3f& p : positions_m) lo = lower_of(lo, p), hi = upper_of(hi, p);
    return TouchFrame::around(lo, hi);
}

}  // namespace

std::shared_ptr<const TouchPatch> TouchPatchMaker::make(TouchSurface& surface, std::span<const std::uint32_t> slots,
                                                        std::span<const std::uint32_t> mesh_index) {
    auto patch = std::make_shared<TouchPatch>();
    place_of_.resize(surface.vertices());
    vertices_ = 0, splits_.clear(), pieces_.clear();
    take_triangles(*patch, surface, slots);
    patch->mesh_triangles.reserve(patch->triangles);
    for (std::uint32_t i = 0; i < patch->triangles; ++i) patch->mesh_triangles.push_back(mesh_index[slots_[i]]);
    take_vertices(*patch, surface);
    box_triangles(*patch);
    return patch;
}

void TouchPatchMaker::take_triangles(TouchPatch& patch, const TouchSurface& surface,
                                     std::span<const std::uint32_t> slots) {
    for (const std::uint32_t slot : slots) {
        const float edge_sum_m = surface.edge_sum_m(slot);
        if (edge_sum_m == 0.0f) continue;
        slots_[patch.triangles++] = slot;
        patch.edge_sum_m += edge_sum_m;
    }
    patch.count = (patch.triangles + TouchBoxes::kMost - 1) / TouchBoxes::kMost;
}

void TouchPatchMaker::take_vertices(TouchPatch& patch, TouchSurface& surface) {
    patch.leaves.resize(patch.count);
    for (std::uint32_t i = 0; i < patch.triangles; ++i) {
        const std::uint32_t slot = slots_[i];
        const auto& [a, b, c] = surface.triangle(slot);
        TouchPatch::Leaf& leaf = patch.leaves[i / TouchBoxes::kMost];
        if (i % TouchBoxes::kMost == 0) leaf.first_vertex = static_cast<std::uint16_t>(vertices_);
        const auto& corner = leaf.corners[i % TouchBoxes::kMost] = {
            vertex_of(surface, a, slot), vertex_of(surface, b, slot), vertex_of(surface, c, slot)};
        for (const auto& [from, to] : {std::pair{corner[0], corner[1]}, {corner[1], corner[2]}, {corner[2], corner[0]}})
            leaf.longest_edge_m = std::max(leaf.longest_edge_m, glm::length(positions_m_[to] - positions_m_[from]));
    }
    patch.positions_m.assign(positions_m_.begin(), positions_m_.begin() + vertices_);
    patch.normals.assign(normals_.begin(), normals_.begin() + vertices_);
}

std::uint16_t TouchPatchMaker::add_vertex(std::uint32_t vertex, const Vec3f& position_m, const Vec3f& normal) {
    mesh_vertex_[vertices_] = vertex;
    positions_m_[vertices_] = position_m;
    normals_[vertices_] = normal;
    return static_cast<std::uint16_t>(vertices_++);
}

std::uint16_t TouchPatchMaker::vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot) {
    if (surface.is_split(vertex)) return split_vertex_of(surface, vertex, slot);
    std::uint16_t& place = place_of_[vertex];
    if (place >= vertices_ || mesh_vertex_[place] != vertex)
        place = add_vertex(vertex, surface.position_m(vertex), surface.normal(vertex));
    return place;
}

std::uint16_t TouchPatchMaker::split_vertex_of(TouchSurface& surface, std::uint32_t vertex, std::uint32_t slot) {
    std::uint16_t& place = place_of_[vertex];
    if (place >= splits_.size() || splits_[place].vertex != vertex) {
        place = static_cast<std::uint16_t>(splits_.size());
        keep_pieces(surface, vertex);
    }
    const Split& split = splits_[place];
    const std::span<SplitPiece> pieces(pieces_.data() + split.first, split.count);
    const auto own = std::ranges::lower_bound(pieces, slot, {}, [](const SplitPiece& p) { return p.piece.slot; });
    // A piece is numbered by the index of its first triangle; that entry holds the vertex for all.
    SplitPiece& first = pieces[own->piece.piece];
    if (first.local == kNone) first.local = add_vertex(vertex, surface.position_m(vertex), own->piece.normal);
    return first.local;
}

void TouchPatchMaker::keep_pieces(TouchSurface& surface, std::uint32_t vertex) {
    const auto pieces = surface.pieces_at(vertex);
    splits_.push_back({vertex, static_cast<std::uint32_t>(pieces_.size()), static_cast<std::uint32_t>(pieces.size())});
    for (const TouchSurface::Piece& piece : pieces) pieces_.push_back({piece});
}

void TouchPatchMaker::slab_triangles(TouchPatch& patch) {
    const auto around = [&patch](std::uint32_t first, std::uint32_t end) {
        return slab_around([&](auto&& visit) {
            for (std::uint32_t i = first; i < end; ++i) {
                const auto& [a, b, c] = patch.corners(i);
                visit(Triangle{Vec3(patch.positions_m[a]), Vec3(patch.positions_m[b]), Vec3(patch.positions_m[c])});
            }
        });
    };
    patch.slab = around(0, patch.triangles);
    for (std::uint32_t number = 0; number < patch.count; ++number) {
        const std::uint32_t first = number * TouchBoxes::kMost;
        patch.leaves[number].slab = around(first, first + patch.in_leaf(number));
    }
}

void TouchPatchMaker::box_triangles(TouchPatch& patch) {
    if (patch.triangles == 0) return;
    patch.frame = frame_around(patch.positions_m);
    std::array<Sides, 3 * TouchPatch::kMostTriangles> corners;
    for (std::size_t i = 0; i < patch.positions_m.size(); ++i) corners[i] = sides_of(patch.frame, patch.positions_m[i]);
    for (std::uint32_t number = 0; number < patch.count; ++number) {
        TouchPatch::Leaf& leaf = patch.leaves[number];
        Sides all = ~Sides{};
        for (std::uint32_t i = 0, count = patch.in_leaf(number); i < count; ++i) {
            const auto& [a, b, c] = leaf.corners[i];
            const Sides box = least(least(corners[a], corners[b]), corners[c]);
            leaf.boxes.set(i, box_of(box));
            all = least(all, box);
        }
        patch.boxes.set(number, box_of(all));
    }
    slab_triangles(patch);
}

}  // namespace burin::geometry

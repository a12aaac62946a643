// SPDX-License-Identifier: MIT
// Whether two meshes of a tile are the same in every field, to the last bit.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "compute/mesher/surface.hpp"

namespace burin::compute::test {

template <typename T>
[[nodiscard]] bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
template <typename T>
[[nodiscard]] bool same_bytes(const T& a, const T& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// Names the first field that differs; nothing when none does.
[[nodiscard]] inline std::string first_difference(const TileMesh& a, const TileMesh& b) {
    if (!same_bytes(a.cells, b.cells)) return "cells";
    if (!same_bytes(a.vertices, b.vertices)) return "vertices";
    if (a.vertex_of_edge != b.vertex_of_edge) return "vertex_of_edge";
    if (a.quads != b.quads) return "quads";
    if (a.indices != b.indices) return "indices";
    if (a.row_quads != b.row_quads || a.row_triangles != b.row_triangles) return "rows";
    if (!same_bytes(a.longest_edge_m, b.longest_edge_m)) return "longest edge";
    if (!same_bytes(a.slab.normal, b.slab.normal) || !same_bytes(a.slab.top_m, b.slab.top_m)) return "slab";
    if (a.face_keys != b.face_keys || a.has_twice_passed_faces != b.has_twice_passed_faces) return "twice passed faces";
    if (a.disagreeing_edges != b.disagreeing_edges) return "disagreeing edges";
    if (a.signs != b.signs) return "signs";
    return "";
}

// Names the first tile that differs, and the field.
[[nodiscard]] inline std::string first_difference(const Surface& a, const Surface& b) {
    for (std::uint32_t t = 0; t < a.tile_count(); ++t) {
        const std::string field = first_difference(a.tile(t), b.tile(t));
        if (!field.empty()) return "tile " + std::to_string(t) + ": " + field;
        if ((a.shared_tile(t) == nullptr) != (b.shared_tile(t) == nullptr)) return "tile " + std::to_string(t);
    }
    if (a.triangles() != b.triangles() || a.disagreeing_edges() != b.disagreeing_edges()) return "sums";
    return "";
}

}  // namespace burin::compute::test

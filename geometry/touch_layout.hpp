// SPDX-License-Identifier: MIT
// How the triangles and vertices of a touched mesh are laid out: in classes of size, and by nearness within each, so that what an
// edit or a search needs together lies together in memory. For TouchMesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/edge_table.hpp"
#include "geometry/touch_order.hpp"

namespace burin {

struct SizedItem {
    TouchItem item;
    float longest_m = 0.0f;  // side of the box around it
};
[[nodiscard]] SizedItem sized(const std::array<Vec3f, 3>& corners_m, std::uint32_t id);

// Largest triangles first, neighbours side by side within a class. Classes may be empty.
[[nodiscard]] std::vector<std::vector<TouchItem>> in_classes(std::span<const SizedItem> items);

// Vertices and triangles have two numbers: an index, by which the publisher knows them, and an own one in the order of the
// patches: `own` of a vertex, `slot` of a triangle.
struct TouchLayout {
    std::vector<VertexTriple> triangles;  // by slot, of own vertices
    std::vector<Vec3f> positions_m;       // of own vertices
    std::vector<std::uint32_t> own_of;    // of each vertex index
    std::vector<std::uint32_t> slot_of;   // of each triangle index
    std::vector<std::uint32_t> mesh_index;
    std::vector<std::vector<TouchItem>> classes;  // by slot
};
[[nodiscard]] TouchLayout lay_out(std::span<const VertexTriple> triangles, std::span<const Vec3f> positions_m);

}  // namespace burin

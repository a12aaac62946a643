// SPDX-License-Identifier: MIT
// The memory layout of a touched mesh's triangles and vertices: in size classes, and by nearness within each class, so
// that items which an edit or a search needs together are close in memory. For TouchMesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/space.hpp"
#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {

// A triangle, patch or node by its place.
struct TouchItem {
    Vec3f middle{0.0f};
    std::uint32_t id = 0;
};

// Orders the items by nearness, so that every 16, 256, 4096 .. consecutive ones make a compact group: this is how
// triangles are grouped into leaves and patches, and patches into nodes (geometry/contact/touch_tree.hpp). Splits the
// items along the longest side recursively, at multiples of the largest group that is smaller than the range. So all
// groups but the last are full. About n log2(n / 16) steps.
void order_by_nearness(std::span<TouchItem> items);

void sort_along_longest_side(std::span<TouchItem> items);

// Returns the size class of a triangle: classes are a factor of 8 in longest edge apart. Triangles of different classes
// do not share patches, since one large triangle would enlarge the box of all the small ones beside it.
inline constexpr std::uint32_t kSizeClasses = 12;
[[nodiscard]] std::uint32_t size_class(float longest_edge_m, float largest_of_mesh_m) noexcept;

struct SizedItem {
    TouchItem item;
    float longest_m = 0.0f;  // longest side of the bounding box
};
[[nodiscard]] SizedItem sized(const std::array<Vec3f, 3>& corners_m, std::uint32_t id);

// Sorts the items into size classes, largest triangles first, neighbours side by side within a class. Classes may be
// empty.
[[nodiscard]] std::vector<std::vector<TouchItem>> in_classes(std::span<const SizedItem> items);

// Vertices and triangles have two numbers: an index, which the publisher uses, and an internal number in the order of
// the patches: `own` of a vertex, `slot` of a triangle.
struct TouchLayout {
    std::vector<VertexTriple> triangles;  // by slot, as own vertex numbers
    std::vector<Vec3f> positions_m;       // by own vertex number
    std::vector<std::uint32_t> own_of;    // own number of each vertex index
    std::vector<std::uint32_t> slot_of;   // slot of each triangle index
    std::vector<std::uint32_t> mesh_index;
    std::vector<std::vector<TouchItem>> classes;  // by slot
};
[[nodiscard]] TouchLayout lay_out(std::span<const VertexTriple> triangles, std::span<const Vec3f> positions_m);

}  // namespace burin::geometry

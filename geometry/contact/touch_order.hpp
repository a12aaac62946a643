// SPDX-License-Identifier: MIT
// Orders items by nearness, so that every 16, 256, 4096 .. consecutive ones make a compact group: this is how the
// triangles of a touched mesh are grouped into leaves and patches, and patches into nodes
// (geometry/contact/touch_tree.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "base/space.hpp"

namespace burin::geometry {

struct TouchItem {
    Vec3f middle{0.0f};
    std::uint32_t id = 0;
};

// Splits the items along the longest side recursively, at multiples of the largest group that is smaller than the
// range. So all groups but the last are full. About n log2(n / 16) steps.
void order_by_nearness(std::span<TouchItem> items);

void sort_along_longest_side(std::span<TouchItem> items);

// Returns the size class of a triangle: classes are a factor of 8 in longest edge apart. Triangles of different classes
// do not share patches, since one large triangle would enlarge the box of all the small ones beside it.
inline constexpr std::uint32_t kSizeClasses = 12;
[[nodiscard]] std::uint32_t size_class(float longest_edge_m, float largest_of_mesh_m) noexcept;

}  // namespace burin::geometry

// SPDX-License-Identifier: MIT
// Puts things that lie near each other side by side, so that every 16, 256, 4096 .. of them in a row make a compact group:
// how the triangles of a touched mesh come into leaves and patches, and these into nodes (geometry/touch_tree.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "base/space.hpp"

namespace burin {

struct TouchItem {
    Vec3f middle{0.0f};
    std::uint32_t id = 0;
};

// Halves along the longest side again and again, at multiples of the largest group that is smaller than what is there. So
// all groups but the last are full. About n log2(n / 16) steps.
void order_by_nearness(std::span<TouchItem> items);

void sort_along_longest_side(std::span<TouchItem> items);

// The size class of a triangle: classes are a factor of 8 in longest edge apart. Triangles of different classes do not share
// patches, since one large one would spoil the box of all the small ones beside it.
inline constexpr std::uint32_t kSizeClasses = 12;
[[nodiscard]] std::uint32_t size_class(float longest_edge_m, float largest_of_mesh_m) noexcept;

}  // namespace burin

// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_order.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/contact/touch_boxes.hpp"
#include "geometry/mesh/componentwise.hpp"

namespace burin::geometry {
namespace {

int longest_side(std::span<const TouchItem> items) {
    Vec3f lo = items.front().middle, hi = lo;
    for (const TouchItem& item : items) lo = lower_of(lo, item.middle), hi = upper_of(hi, item.middle);
    const Vec3f side = hi - lo;
    if (side.x >= side.y && side.x >= side.z) return 0;
    return side.y >= side.z ? 1 : 2;
}

// Orders by id where middles are equal, so that the order is the same with every standard library.
template <int kAxis>
bool before(const TouchItem& a, const TouchItem& b) {
    return a.middle[kAxis] < b.middle[kAxis] || (a.middle[kAxis] == b.middle[kAxis] && a.id < b.id);
}

// Calls sort(before) with the order along the longest side. An axis known at compile time takes half the time of one
// that is not.
template <typename Sort>
void along_longest_side(std::span<TouchItem> items, Sort&& sort) {
    switch (longest_side(items)) {
        case 0: return sort([](const TouchItem& a, const TouchItem& b) { return before<0>(a, b); });
        case 1: return sort([](const TouchItem& a, const TouchItem& b) { return before<1>(a, b); });
        default: return sort([](const TouchItem& a, const TouchItem& b) { return before<2>(a, b); });
    }
}

// Returns the index at which to split: near the middle, at a multiple of the largest power of 16 below the count.
std::size_t place_to_part(std::size_t count) {
    std::size_t group = TouchBoxes::kMost;
    while (group * TouchBoxes::kMost < count) group *= TouchBoxes::kMost;
    const std::size_t groups = (count + group - 1) / group;
    return groups / 2 * group;
}

}  // namespace

void order_by_nearness(std::span<TouchItem> items) {
    while (items.size() > TouchBoxes::kMost) {
        const auto part = items.begin() + static_cast<std::ptrdiff_t>(place_to_part(items.size()));
        along_longest_side(items, [&](auto is_before) { std::ranges::nth_element(items, part, is_before); });
        order_by_nearness({items.begin(), part});
        items = {part, items.end()};
    }
}

void sort_along_longest_side(std::span<TouchItem> items) {
    if (items.empty()) return;
    along_longest_side(items, [&](auto is_before) { std::ranges::sort(items, is_before); });
}

std::uint32_t size_class(float longest_edge_m, float largest_of_mesh_m) noexcept {
    if (!(longest_edge_m > 0.0f)) return kSizeClasses - 1;
    int octave = 0;  // longest = fraction * largest * 2^octave, fraction in [1/2, 1)
    std::frexp(longest_edge_m / largest_of_mesh_m, &octave);
    return static_cast<std::uint32_t>(std::clamp((1 - octave) / 3, 0, static_cast<int>(kSizeClasses) - 1));
}

}  // namespace burin::geometry

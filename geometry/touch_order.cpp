// SPDX-License-Identifier: MIT
#include "geometry/touch_order.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/componentwise.hpp"
#include "geometry/touch_boxes.hpp"

namespace burin {
namespace {

int longest_side(std::span<const TouchItem> items) {
    Vec3f lo = items.front().middle, hi = lo;
    for (const TouchItem& item : items) lo = lower_of(lo, item.middle), hi = upper_of(hi, item.middle);
    const Vec3f side = hi - lo;
    if (side.x >= side.y && side.x >= side.z) return 0;
    return side.y >= side.z ? 1 : 2;
}

// By id where middles are equal, so that the order is the same with every standard library.
struct Before {
    int axis;
    bool operator()(const TouchItem& a, const TouchItem& b) const {
        return a.middle[axis] < b.middle[axis] || (a.middle[axis] == b.middle[axis] && a.id < b.id);
    }
};

// The middle of the items, at a multiple of the largest power of 16 below their number.
std::size_t place_to_part(std::size_t count) {
    std::size_t group = TouchBoxes::kMost;
    while (group * TouchBoxes::kMost < count) group *= TouchBoxes::kMost;
    const std::size_t groups = (count + group - 1) / group;
    return groups / 2 * group;
}

}  // namespace

void order_by_nearness(std::span<TouchItem> items) {
    while (items.size() > TouchBoxes::kMost) {
        const int axis = longest_side(items);
        const auto part = items.begin() + static_cast<std::ptrdiff_t>(place_to_part(items.size()));
        std::ranges::nth_element(items, part, Before{axis});
        order_by_nearness({items.begin(), part});
        items = {part, items.end()};
    }
}

void sort_along_longest_side(std::span<TouchItem> items) {
    if (!items.empty()) std::ranges::sort(items, Before{longest_side(items)});
}

std::uint32_t size_class(float longest_edge_m, float largest_of_mesh_m) noexcept {
    if (!(longest_edge_m > 0.0f)) return kSizeClasses - 1;
    int octave = 0;  // longest = fraction * largest * 2^octave, fraction in [1/2, 1)
    std::frexp(longest_edge_m / largest_of_mesh_m, &octave);
    return static_cast<std::uint32_t>(std::clamp((1 - octave) / 3, 0, static_cast<int>(kSizeClasses) - 1));
}

}  // namespace burin

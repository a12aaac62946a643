// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_layout.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/contact/touch_boxes.hpp"
#include "geometry/mesh/componentwise.hpp"

namespace burin::geometry {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

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

// Orders triangles by class and nearness and numbers their slots. The triangles still name vertices by index.
void order_triangles(TouchLayout& layout, std::span<const VertexTriple> triangles, std::span<const Vec3f> positions_m) {
    std::vector<SizedItem> all(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles[i];
        all[i] = sized({positions_m[a], positions_m[b], positions_m[c]}, i);
    }
    layout.classes = in_classes(all);
    layout.triangles.reserve(triangles.size());
    layout.mesh_index.reserve(triangles.size());
    layout.slot_of.resize(triangles.size());
    for (std::vector<TouchItem>& items : layout.classes)
        for (TouchItem& item : items) {
            const auto slot = static_cast<std::uint32_t>(layout.mesh_index.size());
            layout.triangles.push_back(triangles[item.id]);
            layout.mesh_index.push_back(item.id);
            layout.slot_of[item.id] = slot;
            item.id = slot;
        }
}

// Numbers vertices in the order in which the triangles first name them, so that neighbours are close in memory; unused
// vertices come last.
void number_vertices(TouchLayout& layout, std::size_t vertices) {
    layout.own_of.assign(vertices, kNone);
    std::uint32_t next = 0;
    for (VertexTriple& t : layout.triangles)
        for (std::uint32_t& v : t) {
            if (layout.own_of[v] == kNone) layout.own_of[v] = next++;
            v = layout.own_of[v];
        }
    for (std::uint32_t& own : layout.own_of)
        if (own == kNone) own = next++;
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

SizedItem sized(const std::array<Vec3f, 3>& corners_m, std::uint32_t id) {
    const auto& [a, b, c] = corners_m;
    const Vec3f lo = lower_of(lower_of(a, b), c), hi = upper_of(upper_of(a, b), c), size = hi - lo;
    return {{0.5f * (lo + hi), id}, std::max({size.x, size.y, size.z})};
}

std::vector<std::vector<TouchItem>> in_classes(std::span<const SizedItem> items) {
    float largest_m = 0.0f;
    for (const SizedItem& one : items) largest_m = std::max(largest_m, one.longest_m);
    std::vector<std::vector<TouchItem>> classes(kSizeClasses);
    for (const SizedItem& one : items)
        classes[largest_m > 0.0f ? size_class(one.longest_m, largest_m) : 0].push_back(one.item);
    for (std::vector<TouchItem>& one : classes) order_by_nearness(one);
    return classes;
}

TouchLayout lay_out(std::span<const VertexTriple> triangles, std::span<const Vec3f> positions_m) {
    TouchLayout layout;
    order_triangles(layout, triangles, positions_m);
    number_vertices(layout, positions_m.size());
    layout.positions_m.resize(positions_m.size());
    for (std::size_t i = 0; i < positions_m.size(); ++i) layout.positions_m[layout.own_of[i]] = positions_m[i];
    return layout;
}

}  // namespace burin::geometry

// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_layout.hpp"

#include <algorithm>

#include "geometry/mesh/componentwise.hpp"

namespace burin::geometry {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

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

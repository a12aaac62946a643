// SPDX-License-Identifier: MIT
#include "geometry/edge_table.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace burin {

std::vector<EdgeUse> edge_uses(std::span<const VertexTriple> triangles) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const VertexTriple& v = triangles[t];
        if (names_a_vertex_twice(v)) continue;
        for (std::uint8_t k = 0; k < 3; ++k) {
            const std::uint32_t a = v[k], b = v[(k + 1u) % 3u];
            uses.push_back({edge_key(a, b), t, k, a < b});
        }
    }
    std::ranges::sort(uses, [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.key, a.triangle) < std::tie(b.key, b.triangle);
    });
    return uses;
}

DisjointSets::DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

std::uint32_t DisjointSets::set_of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
}

void DisjointSets::unite(std::uint32_t a, std::uint32_t b) {
    a = set_of(a);
    b = set_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
}

}  // namespace burin

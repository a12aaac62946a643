// SPDX-License-Identifier: MIT
#include "geometry/mesh/edge_table.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace burin::geometry {

namespace {

// Returns where the uses of each lower vertex begin. This counting sort makes the whole nearly linear: few edges share
// their lower vertex.
std::vector<std::size_t> first_use_of_vertex(std::span<const VertexTriple> triangles) {
    std::uint32_t highest = 0;
    for (const VertexTriple& v : triangles) highest = std::max({highest, v[0], v[1], v[2]});
    std::vector<std::size_t> first(std::size_t{highest} + 2);
    for (const VertexTriple& v : triangles) {
        if (names_a_vertex_twice(v)) continue;
        for (std::size_t k = 0; k < 3; ++k) ++first[std::size_t{std::min(v[k], v[(k + 1) % 3])} + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
}

}  // namespace

std::vector<EdgeUse> edge_uses(std::span<const VertexTriple> triangles) {
    const std::vector<std::size_t> first = first_use_of_vertex(triangles);
    std::vector<std::size_t> next(first);
    std::vector<EdgeUse> uses(first.back());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const VertexTriple& v = triangles[t];
        if (names_a_vertex_twice(v)) continue;
        for (std::uint8_t k = 0; k < 3; ++k) {
            const std::uint32_t a = v[k], b = v[(k + 1u) % 3u];
            uses[next[std::min(a, b)]++] = {edge_key(a, b), t, k, a < b};
        }
    }
    for (std::size_t v = 0; v + 1 < first.size(); ++v) {
        std::sort(uses.begin() + static_cast<std::ptrdiff_t>(first[v]),
                  uses.begin() + static_cast<std::ptrdiff_t>(first[v + 1]), [](const EdgeUse& a, const EdgeUse& b) {
                      return std::tie(a.key, a.triangle) < std::tie(b.key, b.triangle);
                  });
    }
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

}  // namespace burin::geometry

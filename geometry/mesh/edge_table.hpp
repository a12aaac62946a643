// SPDX-License-Identifier: MIT
// Which triangles meet at each edge of a triangle soup of any topology, as one sorted array: edges in ascending order
// of (lower vertex, higher vertex), the uses of one edge side by side in ascending order of triangle; and the holes
// that these edges bound. For geometry/ and compute/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

using VertexTriple = std::array<std::uint32_t, 3>;

[[nodiscard]] constexpr std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}
[[nodiscard]] constexpr std::uint32_t lower_vertex(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32); }
[[nodiscard]] constexpr std::uint32_t higher_vertex(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

// A triangle that names a vertex twice has neither interior nor edges of its own: all topology ignores it.
[[nodiscard]] constexpr bool names_a_vertex_twice(const VertexTriple& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

struct EdgeUse {
    std::uint64_t key = 0;
    std::uint32_t triangle = 0;
    std::uint8_t corner = 0;  // the edge runs from this corner of the triangle to the next
    bool upwards = false;     // from the lower vertex to the higher
};

// Returns the uses of all edges, three for each triangle. Nearly linear; n log n where most edges share one vertex.
[[nodiscard]] std::vector<EdgeUse> edge_uses(std::span<const VertexTriple> triangles);

// Calls f(std::span<const EdgeUse>) for each edge.
template <typename F>
void for_each_edge(std::span<const EdgeUse> uses, F&& f) {
    for (std::size_t first = 0; first < uses.size();) {
        std::size_t last = first + 1;
        while (last < uses.size() && uses[last].key == uses[first].key) ++last;
        f(uses.subspan(first, last - first));
        first = last;
    }
}

// Returns the number of upward uses minus the number of downward ones.
[[nodiscard]] inline std::ptrdiff_t imbalance(std::span<const EdgeUse> edge) {
    std::ptrdiff_t sum = 0;
    for (const EdgeUse& use : edge) sum += use.upwards ? 1 : -1;
    return sum;
}

// A hole of the mesh: a simple loop of at least 3 vertices, none of which occurs twice. It runs so that triangles
// (loop[i], loop[i+1], other) are oriented like most of their neighbours across the loop.
struct HoleLoop {
    std::vector<std::uint32_t> vertices;
};

// Returns all holes, in a deterministic order. The edges with an odd number of uses meet every vertex an even number of
// times (each triangle enters a vertex as often as it leaves it), so they always decompose into closed loops, in a mesh
// of any topology and orientation.
[[nodiscard]] std::vector<HoleLoop> hole_loops(std::span<const EdgeUse> uses);

// Disjoint sets of the numbers 0 .. n-1 (union-find); a set is identified by its least member.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n);
    [[nodiscard]] std::uint32_t set_of(std::uint32_t i);
    void unite(std::uint32_t a, std::uint32_t b);

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace burin::geometry

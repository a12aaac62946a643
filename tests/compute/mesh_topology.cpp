// SPDX-License-Identifier: MIT
#include "tests/compute/mesh_topology.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

namespace burin::compute::test {
namespace {

void count_edges(const geometry::TriangleMesh& mesh, MeshTopology& topology) {
    struct Half {
        std::uint32_t low, high;
        bool upward;
    };
    std::vector<Half> halves;
    halves.reserve(mesh.triangles.size() * 3);
    for (const auto& t : mesh.triangles) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) ++topology.degenerate_triangles;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            halves.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    }
    std::ranges::sort(halves, {}, [](const Half& h) { return std::tuple(h.low, h.high, h.upward); });
    for (std::size_t from = 0, to = 0; from < halves.size(); from = to) {
        while (to < halves.size() && halves[to].low == halves[from].low && halves[to].high == halves[from].high) ++to;
        if (to - from == 1) ++topology.open_edges;
        if (to - from > 2) ++topology.non_manifold_edges;
        if (to - from == 2 && halves[from].upward == halves[from + 1].upward) ++topology.misoriented_edges;
    }
}

// Around a vertex each triangle leads from one neighbour to the next; a manifold's lead once around through all of
// them.
void count_fans(const geometry::TriangleMesh& mesh, MeshTopology& topology) {
    struct Step {
        std::uint32_t vertex, from, to;
    };
    std::vector<Step> steps;
    steps.reserve(mesh.triangles.size() * 3);
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) steps.push_back({t[k], t[(k + 1) % 3], t[(k + 2) % 3]});
    }
    std::ranges::sort(steps, {}, [](const Step& s) { return std::tuple(s.vertex, s.from, s.to); });
    for (std::size_t first = 0, last = 0; first < steps.size(); first = last) {
        while (last < steps.size() && steps[last].vertex == steps[first].vertex) ++last;
        std::size_t walked = 0;
        std::uint32_t at = steps[first].from;
        do {
            const auto begin = steps.begin() + static_cast<std::ptrdiff_t>(first);
            const auto end = steps.begin() + static_cast<std::ptrdiff_t>(last);
            const auto step =
                std::lower_bound(begin, end, at, [](const Step& s, std::uint32_t v) { return s.from < v; });
            if (step == end || step->from != at) break;
            at = step->to;
            ++walked;
        } while (at != steps[first].from && walked <= last - first);
        if (walked != last - first || at != steps[first].from) ++topology.pinched_vertices;
    }
}

}  // namespace

MeshTopology topology_of(const geometry::TriangleMesh& mesh) {
    MeshTopology topology;
    count_edges(mesh, topology);
    count_fans(mesh, topology);
    return topology;
}

}  // namespace burin::compute::test

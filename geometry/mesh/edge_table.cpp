// SPDX-License-Identifier: MIT
#include "geometry/mesh/edge_table.hpp"

#include <algorithm>
#include <limits>
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

// An edge with an odd number of uses, seen from one of its ends.
struct OddStep {
    std::uint32_t from = 0, to = 0;
    std::uint32_t edge = 0;
    bool against = false;  // runs against the mesh's triangle, as the triangles of a filling must
};

std::vector<OddStep> odd_steps(std::span<const EdgeUse> uses, std::uint32_t& edges) {
    std::vector<OddStep> steps;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() % 2 == 0) return;
        const std::uint32_t lo = lower_vertex(edge[0].key), hi = higher_vertex(edge[0].key);
        const bool upwards = imbalance(edge) > 0;
        steps.push_back({lo, hi, edges, !upwards});
        steps.push_back({hi, lo, edges, upwards});
        ++edges;
    });
    // Sorts steps of the right direction first, so that a walk prefers them where several loops meet.
    std::ranges::sort(steps, [](const OddStep& a, const OddStep& b) {
        return std::tuple(a.from, !a.against, a.to) < std::tuple(b.from, !b.against, b.to);
    });
    return steps;
}

// Walks along unused odd edges; whenever the walk returns to a visited vertex, the path since then is a loop.
class Walker {
public:
    explicit Walker(std::span<const EdgeUse> uses) : steps_(odd_steps(uses, edges_)) {
        used_.resize(edges_);
        std::uint32_t vertices = 0;
        for (const OddStep& s : steps_) vertices = std::max(vertices, s.from + 1);
        first_.assign(vertices + 1, 0);
        for (const OddStep& s : steps_) ++first_[s.from + 1];
        for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
        next_.assign(first_.begin(), first_.end());
        place_.assign(vertices, kNowhere);
    }

    std::vector<HoleLoop> loops() {
        for (std::uint32_t s = 0; s < steps_.size(); ++s) {
            // Starts with steps of the right direction only; a walk takes a wrongly directed one only where no other is
            // left.
            if (!used_[steps_[s].edge] && steps_[s].against) walk_from(steps_[s].from);
        }
        return std::move(loops_);
    }

private:
    static constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

    // Walks until no unused edge is left. Every vertex has an even number of odd edges, so the walk ends where it
    // began.
    void walk_from(std::uint32_t start) {
        std::vector<OddStep> path;
        std::uint32_t at = start;
        place_[at] = 0;
        for (const OddStep* step = unused_step(at); step != nullptr; step = unused_step(at)) {
            used_[step->edge] = true;
            path.push_back(*step);
            at = step->to;
            if (place_[at] == kNowhere) {
                place_[at] = static_cast<std::uint32_t>(path.size());
            } else {
                cut_loop(path, place_[at]);
            }
        }
        place_[start] = kNowhere;
    }

    const OddStep* unused_step(std::uint32_t vertex) {
        std::uint32_t& next = next_[vertex];
        while (next < first_[vertex + 1] && used_[steps_[next].edge]) ++next;
        return next < first_[vertex + 1] ? &steps_[next] : nullptr;
    }

    void cut_loop(std::vector<OddStep>& path, std::uint32_t since) {
        HoleLoop loop;
        std::ptrdiff_t votes = 0;
        for (std::size_t i = since; i < path.size(); ++i) {
            loop.vertices.push_back(path[i].from);
            votes += path[i].against ? 1 : -1;
            if (i > since) place_[path[i].from] = kNowhere;
        }
        if (votes < 0) std::ranges::reverse(loop.vertices);
        loops_.push_back(std::move(loop));
        path.resize(since);
    }

    std::uint32_t edges_ = 0;
    std::vector<OddStep> steps_;
    std::vector<bool> used_;
    // Where each vertex's steps begin, and the first that may be unused.
    std::vector<std::uint32_t> first_, next_;
    std::vector<std::uint32_t> place_;  // index in the path
    std::vector<HoleLoop> loops_;
};

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

std::vector<HoleLoop> hole_loops(std::span<const EdgeUse> uses) { return Walker(uses).loops(); }

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

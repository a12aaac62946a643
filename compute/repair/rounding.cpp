// SPDX-License-Identifier: MIT
#include "compute/repair/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "compute/repair/near_pairs.hpp"
#include "compute/repair/remedies.hpp"
#include "geometry/mesh/triangle_contact.hpp"
#include "geometry/mesh/vertex_weld.hpp"

namespace burin::compute {
namespace {

constexpr int kPasses = 6;
constexpr int kSteps = 2;  // of a float, along each axis
// Of a vertex that is moved: the triangles around it, those near these, with which each place is compared, and the
// pairs that it is in. A vertex in more is in a tangle of triangles narrower than a step of a float, which no step
// ends.
constexpr std::size_t kMostTriangles = 64, kMostNear = 2000, kMostFaults = 8;

// Both meshes with one vertex for each position, and which of them each vertex of the originals is.
struct ByPosition {
    geometry::TriangleMesh exact, rounded;
    std::vector<std::uint32_t> index;
};

ByPosition by_position(const geometry::TriangleMesh& exact, const geometry::TriangleMesh& rounded) {
    ByPosition both;
    geometry::VertexWeld weld(both.exact.positions_m);
    for (const Vec3& p : exact.positions_m) both.index.push_back(weld.index_of(p));
    both.rounded.positions_m.resize(both.exact.positions_m.size());
    for (std::size_t v = 0; v < both.index.size(); ++v)
        both.rounded.positions_m[both.index[v]] = rounded.positions_m[v];
    for (const auto& [a, b, c] : exact.triangles)
        both.exact.triangles.push_back({both.index[a], both.index[b], both.index[c]});
    both.rounded.triangles = both.exact.triangles;
    return both;
}

double stepped(double number, int steps) {
    auto value = static_cast<float>(number);
    const float towards = std::copysign(std::numeric_limits<float>::max(), static_cast<float>(steps));
    for (int i = 0; i < std::abs(steps); ++i) value = std::nextafter(value, towards);
    return value;
}

bool meet(const geometry::TriangleMesh& mesh, const TrianglePair& pair) {
    return geometry::meet_beyond_shared(mesh.positions_m, mesh.triangles[pair[0]], mesh.triangles[pair[1]]);
}

class Nudger {
public:
    Nudger(ByPosition& meshes, WorkerPool& pool, RoundingReport& report)
        : exact_(meshes.exact),
          mesh_(meshes.rounded),
          before_(mesh_.positions_m),
          fans_(mesh_),
          pool_(pool),
          report_(report) {}

    // Returns those of the pairs that meet, but did not before rounding.
    [[nodiscard]] std::vector<TrianglePair> met_by_rounding(std::span<const TrianglePair> pairs) {
        std::vector<TrianglePair> met;
        for (const TrianglePair& pair : pairs) {
            ++report_.tests;
            if (meet(mesh_, pair) && !meet(exact_, pair)) met.push_back(pair);
        }
        return met;
    }

    // Finds what the triangles around the pairs' vertices may meet wherever these are moved.
    void look_around(std::span<const TrianglePair> pairs) {
        faults_.assign(mesh_.positions_m.size(), 0);
        for (const auto& [a, b] : pairs)
            for (const std::uint32_t t : {a, b})
                for (const std::uint32_t v : mesh_.triangles[t]) ++faults_[v];
        std::vector<double> reach(mesh_.positions_m.size(), 0.0);
        std::vector<std::uint8_t> wanted(mesh_.triangles.size(), 0);
        for (const TrianglePair& pair : pairs)
            for (const std::uint32_t v : vertices_of(pair)) {
                reach[v] = reach_of(v);
                for (const std::uint32_t t : fans_.of(v)) wanted[t] = 1;
            }
        NearPairs near = near_pairs(mesh_, {.reach = reach, .wanted = wanted}, pool_);
        report_.tests += near.tests;
        report_.complete = report_.complete && near.complete;
        near_ = std::move(near.pairs);
        first_.assign(mesh_.triangles.size() + 1, 0);
        for (const auto& [a, b] : near_) ++first_[a + 1], ++first_[b + 1];
        for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
        others_.resize(2 * near_.size());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (const auto& [a, b] : near_) others_[next[a]++] = b, others_[next[b]++] = a;
    }
    [[nodiscard]] std::span<const TrianglePair> looked_at() const { return near_; }

    // Returns whether a vertex of the pair was moved.
    bool treat(const TrianglePair& pair, std::uint64_t most_tests) {
        if (++report_.tests > most_tests || !meet(mesh_, pair)) return false;
        return std::ranges::any_of(vertices_of(pair), [&](std::uint32_t v) { return nudge(v, most_tests); });
    }
    [[nodiscard]] std::uint64_t moved() const {
        std::uint64_t count = 0;
        for (std::size_t v = 0; v < before_.size(); ++v) count += mesh_.positions_m[v] != before_[v] ? 1 : 0;
        return count;
    }

private:
    // Those of a pair's vertices that may be moved.
    [[nodiscard]] std::vector<std::uint32_t> vertices_of(const TrianglePair& pair) const {
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t t : pair)
            for (const std::uint32_t v : mesh_.triangles[t])
                if (fans_.of(v).size() <= kMostTriangles && faults_[v] <= kMostFaults) vertices.push_back(v);
        sort_unique(vertices);
        return vertices;
    }

    // How far a vertex gets from where it is now.
    [[nodiscard]] double reach_of(std::uint32_t v) const {
        Vec3 farthest;
        for (int k = 0; k < 3; ++k)
            farthest[k] = std::max(std::abs(stepped(before_[v][k], kSteps) - mesh_.positions_m[v][k]),
                                   std::abs(stepped(before_[v][k], -kSteps) - mesh_.positions_m[v][k]));
        return glm::length(farthest);
    }

    // Moves the vertex to the place beside its first one that leaves the fewest faults, if that is fewer than now.
    bool nudge(std::uint32_t v, std::uint64_t most_tests) {
        std::size_t near = 0;
        for (const std::uint32_t t : fans_.of(v)) near += first_[t + 1] - first_[t];
        if (near > kMostNear) return false;
        const Vec3 now = mesh_.positions_m[v];
        Vec3 best = now;
        std::size_t fewest = faults_around(v, std::numeric_limits<std::size_t>::max());
        for (int i = 0; i < kPlaces && fewest > 0 && report_.tests < most_tests; ++i) {
            const Vec3& home = before_[v];
            mesh_.positions_m[v] = {stepped(home.x, i % kAlong - kSteps), stepped(home.y, i / kAlong % kAlong - kSteps),
                                    stepped(home.z, i / kAlong / kAlong - kSteps)};
            if (lies_on_a_neighbour(v)) continue;
            const std::size_t faults = faults_around(v, fewest);
            if (faults < fewest) fewest = faults, best = mesh_.positions_m[v];
        }
        mesh_.positions_m[v] = best;
        return best != now;
    }

    // Vertices elsewhere that it lies on make faults.
    [[nodiscard]] bool lies_on_a_neighbour(std::uint32_t v) const {
        return std::ranges::any_of(fans_.of(v), [&](std::uint32_t t) {
            return std::ranges::any_of(mesh_.triangles[t], [&](std::uint32_t w) {
                return w != v && mesh_.positions_m[w] == mesh_.positions_m[v];
            });
        });
    }

    // Counts the intersections of the triangles at a vertex, up to `enough`.
    [[nodiscard]] std::size_t faults_around(std::uint32_t v, std::size_t enough) {
        std::size_t count = 0;
        const std::span<const std::uint32_t> fan = fans_.of(v);
        for (const std::uint32_t t : fan)
            for (const std::uint32_t other : std::span(others_).subspan(first_[t], first_[t + 1] - first_[t])) {
                if (other < t && std::ranges::binary_search(fan, other)) continue;
                ++report_.tests;
                if (meet(mesh_, {t, other}) && ++count >= enough) return count;
            }
        return count;
    }

    static constexpr int kAlong = 2 * kSteps + 1, kPlaces = kAlong * kAlong * kAlong;

    const geometry::TriangleMesh& exact_;
    geometry::TriangleMesh& mesh_;
    const std::vector<Vec3> before_;
    const Fans fans_;
    WorkerPool& pool_;
    RoundingReport& report_;
    std::vector<std::uint32_t> faults_;  // of each vertex, at the beginning of the pass
    std::vector<TrianglePair> near_;
    std::vector<std::uint32_t> first_, others_;  // of each triangle those that are near it
};

// Returns the pairs that still meet by rounding: the others than those looked at have not changed.
std::vector<TrianglePair> still_met(Nudger& nudger, const std::vector<TrianglePair>& pairs) {
    std::vector<TrianglePair> unchanged, all;
    std::ranges::set_difference(pairs, nudger.looked_at(), std::back_inserter(unchanged));
    std::ranges::set_union(unchanged, nudger.met_by_rounding(nudger.looked_at()), std::back_inserter(all));
    return all;
}

}  // namespace

RoundingReport repair_rounding(const geometry::TriangleMesh& exact, geometry::TriangleMesh& rounded, WorkerPool& pool,
                               const std::function<void(double)>& show) {
    RoundingReport report;
    ByPosition meshes = by_position(exact, rounded);
    const std::vector<double> nowhere(meshes.rounded.positions_m.size(), 0.0);
    const NearPairs near = near_pairs(meshes.rounded, {.reach = nowhere}, pool);
    report.tests = near.tests;
    report.complete = near.complete;
    Nudger nudger(meshes, pool, report);
    std::vector<TrianglePair> pairs = nudger.met_by_rounding(near.pairs);
    report.found = report.left = pairs.size();
    if (pairs.empty()) return report;
    const std::uint64_t most_tests =
        report.tests + kMostRepairTests + kRepairTestsATriangle * meshes.rounded.triangles.size();
    bool goes_on = true;
    for (int pass = 0; pass < kPasses && goes_on && !pairs.empty() && report.tests < most_tests; ++pass) {
        goes_on = false;
        nudger.look_around(pairs);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            goes_on = nudger.treat(pairs[i], most_tests) || goes_on;
            if (show) show((pass + static_cast<double>(i) / static_cast<double>(pairs.size())) / kPasses);
        }
        pairs = still_met(nudger, pairs);
    }
    report.complete = report.complete && report.tests < most_tests;
    report.left = pairs.size();
    report.found = std::max(report.found, report.left);  // some come up only when others have been looked at
    report.vertices_moved = nudger.moved();
    for (std::size_t v = 0; v < meshes.index.size(); ++v)
        rounded.positions_m[v] = meshes.rounded.positions_m[meshes.index[v]];
    return report;
}

}  // namespace burin::compute

// SPDX-License-Identifier: MIT
#include "compute/repair/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compute/repair/remedies.hpp"
#include "compute/repair/self_intersections.hpp"
#include "geometry/mesh/triangle_contact.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "geometry/mesh/vertex_weld.hpp"

namespace burin::compute {
namespace {

constexpr int kPasses = 6;
constexpr int kSteps = 2;  // of a float, along each axis

// A mesh with one vertex for each position, and which of them each vertex of the original is.
struct ByPosition {
    geometry::TriangleMesh mesh;
    std::vector<std::uint32_t> index;
};

ByPosition by_position(const geometry::TriangleMesh& mesh) {
    ByPosition welded;
    geometry::VertexWeld weld(welded.mesh.positions_m);
    for (const Vec3& p : mesh.positions_m) welded.index.push_back(weld.index_of(p));
    for (const auto& [a, b, c] : mesh.triangles)
        welded.mesh.triangles.push_back({welded.index[a], welded.index[b], welded.index[c]});
    return welded;
}

double stepped(double number, int steps) {
    auto value = static_cast<float>(number);
    const float towards = std::copysign(std::numeric_limits<float>::max(), static_cast<float>(steps));
    for (int i = 0; i < std::abs(steps); ++i) value = std::nextafter(value, towards);
    return value;
}

class Nudger {
public:
    explicit Nudger(geometry::TriangleMesh& mesh)
        : mesh_(mesh), before_(mesh.positions_m), fans_(mesh), tree_(before_, mesh.triangles) {}

    // Returns whether a vertex of the pair was moved.
    bool treat(const TrianglePair& pair) {
        const auto& [a, b] = pair;
        if (!geometry::meet_beyond_shared(mesh_.positions_m, mesh_.triangles[a], mesh_.triangles[b])) return false;
        std::vector<std::uint32_t> vertices(mesh_.triangles[a].begin(), mesh_.triangles[a].end());
        vertices.insert(vertices.end(), mesh_.triangles[b].begin(), mesh_.triangles[b].end());
        sort_unique(vertices);
        return std::ranges::any_of(vertices, [&](std::uint32_t v) { return nudge(v); });
    }
    [[nodiscard]] std::uint64_t moved() const {
        std::uint64_t count = 0;
        for (std::size_t v = 0; v < before_.size(); ++v) count += mesh_.positions_m[v] != before_[v] ? 1 : 0;
        return count;
    }

private:
    // Moves the vertex to the place beside its first one that leaves the fewest faults, if that is fewer than now.
    bool nudge(std::uint32_t v) {
        const Vec3 now = mesh_.positions_m[v];
        Vec3 best = now;
        std::size_t fewest = faults_around(v, std::numeric_limits<std::size_t>::max());
        for (int i = 0; i < kPlaces && fewest > 0; ++i) {
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
    [[nodiscard]] std::size_t faults_around(std::uint32_t v, std::size_t enough) const {
        std::size_t count = 0;
        const std::span<const std::uint32_t> fan = fans_.of(v);
        for (const std::uint32_t t : fan) {
            if (geometry::names_a_vertex_twice(mesh_.triangles[t])) continue;
            Box box;
            for (const std::uint32_t corner : mesh_.triangles[t]) {
                box.include(mesh_.positions_m[corner]);
                box.include(before_[corner]);
            }
            const Vec3 reach =
                8.0 * std::numeric_limits<float>::epsilon() * glm::max(glm::abs(box.lo), glm::abs(box.hi));
            box.lo -= reach;
            box.hi += reach;
            tree_.for_each_meeting(tree_.box_of(box), 0, [&](std::size_t place) {
                const std::uint32_t other = tree_.triangle_at(place);
                if (count >= enough || other == t) return;
                if (other < t && std::ranges::binary_search(fan, other)) return;
                if (geometry::meet_beyond_shared(mesh_.positions_m, mesh_.triangles[t], mesh_.triangles[other]))
                    ++count;
            });
        }
        return count;
    }

    static constexpr int kAlong = 2 * kSteps + 1, kPlaces = kAlong * kAlong * kAlong;

    geometry::TriangleMesh& mesh_;
    const std::vector<Vec3> before_;
    Fans fans_;
    geometry::TriangleTree tree_;
};

}  // namespace

RoundingReport repair_rounding(const geometry::TriangleMesh& exact, geometry::TriangleMesh& rounded, WorkerPool& pool) {
    RoundingReport report;
    const std::vector<TrianglePair> known = self_intersections(by_position(exact).mesh, pool);
    ByPosition welded = by_position(rounded);
    std::vector<TrianglePair> pairs = self_intersections(welded.mesh, pool);
    report.before = known.size();
    report.found = report.left = pairs.size();
    const auto is_known = [&](const TrianglePair& pair) { return std::ranges::binary_search(known, pair); };
    if (std::ranges::all_of(pairs, is_known)) return report;
    Nudger nudger(welded.mesh);
    bool goes_on = true;
    for (int pass = 0; pass < kPasses && goes_on; ++pass) {
        goes_on = false;
        for (const TrianglePair& pair : pairs) goes_on = (!is_known(pair) && nudger.treat(pair)) || goes_on;
        if (goes_on) pairs = self_intersections(welded.mesh, pool);
    }
    report.left = pairs.size();
    report.vertices_moved = nudger.moved();
    for (std::size_t v = 0; v < welded.index.size(); ++v)
        rounded.positions_m[v] = welded.mesh.positions_m[welded.index[v]];
    return report;
}

}  // namespace burin::compute

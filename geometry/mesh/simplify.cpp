// SPDX-License-Identifier: MIT
#include "geometry/mesh/simplify.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "geometry/mesh/edge_collapse.hpp"

namespace burin::geometry {
namespace {

constexpr int kRounds = 3;
// The share of the triangles below which a round is the last.
constexpr double kWorthwhile = 0.03;
// The accuracy of the measured distance, as a share of the bound.
constexpr double kMeasuringTolerance = 1.0 / 10.0;

std::string in_metres(double x) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::general, 4).ptr;
    return std::string(text.data(), end);
}

CollapseState start(const TriangleMesh& mesh, const SimplifyOptions& options) {
    CollapseState state;
    state.mesh = mesh;
    // Drops triangles that name a vertex twice: they cover nothing.
    if (std::ranges::any_of(mesh.triangles, names_a_vertex_twice)) {
        state.mesh.triangles.clear();
        state.mesh.triangle_materials.clear();
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (names_a_vertex_twice(mesh.triangles[t])) continue;
            state.mesh.triangles.push_back(mesh.triangles[t]);
            if (!mesh.triangle_materials.empty()) state.mesh.triangle_materials.push_back(mesh.triangle_materials[t]);
        }
    }
    state.moved_m.resize(state.mesh.triangles.size());
    state.colour_change.resize(state.mesh.triangles.size());
    state.kept.resize(mesh.positions_m.size());
    for (const std::uint32_t v : options.keep) state.kept[v] = true;
    for (std::uint32_t v = 0; v < mesh.positions_m.size(); ++v) state.first_vertex.push_back(v);
    return state;
}

// Measures both directions for each triangle of the simplified mesh: from it, and from the parts of the first mesh
// nearest to it.
std::vector<double> measured_distances(const TriangleMesh& first, const TriangleTree& first_tree,
                                       const TriangleMesh& now, double bound_m, const ForEach& for_each) {
    const double tolerance_m = bound_m * kMeasuringTolerance;
    const TriangleTree now_tree(now.positions_m, now.triangles);
    const SurfaceDistance there =
        distance_from(now.positions_m, now.triangles, first, first_tree, tolerance_m, for_each);
    const SurfaceDistance back =
        distance_from(first.positions_m, first.triangles, now, now_tree, tolerance_m, for_each);
    std::vector<double> distances(now.triangles.size());
    for (std::size_t t = 0; t < distances.size(); ++t)
        distances[t] = std::max(there.of_from_m[t], back.attributed_m[t]);
    return distances;
}

}  // namespace

Result<Simplified> simplify(const TriangleMesh& mesh, const SimplifyOptions& options) {
    if (!(options.bound_m > 0.0) || !std::isfinite(options.bound_m)) {
        return fail("simplification bound " + in_metres(options.bound_m), "is not a distance",
                    "give how far the surface may move, in metres, above zero");
    }
    CollapseState state = start(mesh, options);
    const TriangleMesh first = state.mesh;
    const TriangleTree first_tree(first.positions_m, first.triangles);
    double error_m = 0.0;
    for (int round = 0; round < kRounds && !first.triangles.empty(); ++round) {
        const std::size_t triangles = state.mesh.triangles.size();
        const auto show = [&](double share) {
            if (options.show) options.show(std::min(1.0, (round + share) / kRounds));
        };
        // Stays a little below the bound, so that rounding in the sums cannot exceed it.
        collapse_edges(state, options.bound_m * (1.0 - 1e-9), show);
        const std::vector<double> distances =
            measured_distances(first, first_tree, state.mesh, options.bound_m, options.for_each);
        error_m = 0.0;
        for (std::size_t t = 0; t < distances.size(); ++t) {
            // Both are bounds on the same distance: the smaller one holds, and leaves more for the next round.
            state.moved_m[t] = std::min(state.moved_m[t], distances[t]);
            error_m = std::max(error_m, state.moved_m[t]);
        }
        const double taken = static_cast<double>(triangles - state.mesh.triangles.size());
        if (taken < kWorthwhile * static_cast<double>(triangles)) break;
    }
    return Simplified{std::move(state.mesh), std::move(state.first_vertex), error_m};
}

}  // namespace burin::geometry

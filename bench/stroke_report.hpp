// SPDX-License-Identifier: MIT
// The figures of a benchmark run: as JSON, whose keys carry their unit at the end (_h: in cells), and as a table. A figure
// that was not measured is null in JSON and a dash in the table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "bench/peers/peers.hpp"
#include "bench/stroke.hpp"
#include "bench/surface_errors.hpp"

namespace burin::bench {

struct SelfIntersections {
    std::optional<std::uint64_t> pairs;          // by Burin's own exact count
    std::optional<std::uint64_t> pairs_by_cgal;  // by CGAL's, where it is built in and the mesh is not too large for it
};

[[nodiscard]] SelfIntersections count_self_intersections(const TriangleMesh& mesh, unsigned threads);

// median of the first hundred and of the last hundred updates.
struct Ageing {
    double first_100_ms = 0.0, last_100_ms = 0.0;
};
[[nodiscard]] Ageing ageing(const std::vector<double>& update_ms);

[[nodiscard]] Json describe(const CarveScene& scene, const StrokeRun& run, const SurfaceErrors& errors,
                            const SelfIntersections& crossings);
// A peer's, with the same keys where they mean the same. cell_m is 0 for a method without cells: figures in cells and of
// edges, which only ask how far the mesh is and not how finely it follows, are then null.
[[nodiscard]] Json describe(const CarveScene& scene, const PeerRun& run, const SurfaceErrors& errors, double cell_m);
// Adds the peer's keys as openvdb_..., and how many times as long as Burin it takes: openvdb_ratio, openvdb_cpu_ratio.
void add_openvdb(Json& report, const Json& peer);

// One line a key.
[[nodiscard]] std::string table(const Json& report);

}  // namespace burin::bench

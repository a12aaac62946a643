// SPDX-License-Identifier: MIT
// Reports the figures of a benchmark run: as JSON, whose keys end with their unit (_h: in cells), and as a table. A
// figure that was not measured is null in JSON and a dash in the table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "bench/measure/surface_errors.hpp"
#include "bench/peers/peers.hpp"
#include "bench/stroke/stroke.hpp"

namespace burin::bench {

struct SelfIntersections {
    std::optional<std::uint64_t> pairs;          // by Burin's own exact count
    std::optional<std::uint64_t> pairs_by_cgal;  // by CGAL, where it is built in and the mesh is not too large for it
};

[[nodiscard]] SelfIntersections count_self_intersections(const geometry::TriangleMesh& mesh, unsigned threads);

// Medians of the first hundred and of the last hundred updates.
struct Ageing {
    double first_100_ms = 0.0, last_100_ms = 0.0;
};
[[nodiscard]] Ageing ageing(const std::vector<double>& update_ms);

// update_ms_... and update_cpu_ms_... are an update's cut, surface and local surface, without undo and light;
// update_with_undo_... and update_with_light_... are the same updates with one of them, null where they were not run.
// submissions_per_update and the like are means of what was asked of a device, and counts_per_update spreads of the
// same; null without one. Errors, and lost and extra intervals, are null for a tool without closed forms, of which no
// errors are given.
[[nodiscard]] Json describe(const CarveScene& scene, const StrokeRun& run, const std::optional<SurfaceErrors>& errors,
                            const SelfIntersections& crossings);
// Describes a peer's run with the same keys where they mean the same. cell_m is 0 for a method without cells: figures
// in cells are then null, and so are those of edges, which measure how far the mesh is and not how finely it follows.
[[nodiscard]] Json describe(const CarveScene& scene, const PeerRun& run, const SurfaceErrors& errors, double cell_m);
// Adds the peer's keys as openvdb_..., and the ratios of its times to Burin's: openvdb_ratio, openvdb_cpu_ratio.
void add_openvdb(Json& report, const Json& peer);

// Returns one line a key, but for counts_per_update.
[[nodiscard]] std::string table(const Json& report);
// Returns counts_per_update as a table: median, 99th percentile, most, and the sum of all updates. Empty without a
// device.
[[nodiscard]] std::string counts_table(const Json& report);

// Sorts reports of the same cuts into different workpieces, the worst first: by faults (disagreeing edges, remaining
// self-intersections, lost and extra intervals), then by the error of the cut region.
void sort_worst_first(std::vector<Json>& reports);
// Returns one row a report.
[[nodiscard]] std::string scene_table(const std::vector<Json>& reports);

}  // namespace burin::bench

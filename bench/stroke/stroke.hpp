// SPDX-License-Identifier: MIT
// Carves a scene update by update with the sculpture of a session (sculpt/sculpture.hpp), and times it. In one update
// the engine cuts one sweep; the surface is brought up to date, vertices and indices; a local surface is filled with
// references to the tiles near the tool, ready to be published to the haptic thread. The Vulkan engine cuts and
// makes the surface's cells on the device, and the host puts what comes home into the solid and the tiles, as in a
// session.
//
// A session also keeps undo and light. The same updates are timed with each of them, on a sculpture of its own. With
// undo, a stroke ends every kUpdatesAStroke updates. With light, each update bakes as many tiles as one of a session
// does while the tool works; at the beginning the light of the whole surface waits to be baked, as when a session
// begins.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/measure/lost_intervals.hpp"
#include "bench/measure/scenes.hpp"
#include "bench/stroke/stroke_tools.hpp"
#include "compute/engine/engine.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

struct StrokeOptions {
    int resolution = 128;     // cells along a side of the cube, or along the longest side of a mesh
    bool on_vulkan = false;   // false: native code
    unsigned threads = 0;     // 0: one a core
    bool with_undo = false;   // time the updates with undo as well
    bool with_light = false;  // time the updates with light as well
    StrokeTool tool = StrokeTool::ball;
    bool smooths = false;  // the tool smooths where it has cut, all of the stroke, before
    // Says whether the removed volume and the cut surface have a closed form.
    [[nodiscard]] bool is_known() const { return tool == StrokeTool::ball && !smooths; }
};

// One value an update: wall time, and the process's time on all threads.
struct UpdateTimes {
    std::vector<double> update_ms, cpu_ms;
};

// Counts what each update asked of the device, and how many rays it changed. The bytes are those that cross over: none
// where the host sees the device's memory.
struct UpdateCounts {
    std::vector<double> submissions, blocking_waits, bytes_to_device, bytes_to_host, rays_changed;
};

struct StrokeRun {
    StrokeTool tool = StrokeTool::ball;
    bool smooths = false;
    std::string engine;  // "cpu" or "vulkan"
    std::string device;  // the Vulkan device, or "native"
    bool software_device = false;
    unsigned threads = 0;
    int resolution = 0;
    double cell_m = 0.0;
    // One value an update, wall time: the cut, the surface, the local surface, and all three; cpu_ms is the process's
    // time for all three on all threads. The cut is that of the device's too, with the making of cells.
    std::vector<double> carve_ms, mesh_ms, publish_ms, update_ms, cpu_ms;
    UpdateTimes with_undo, with_light;  // empty unless asked for
    // Sums up the updates without undo or light; nothing without a device.
    std::optional<compute::DeviceTraffic> traffic;
    UpdateCounts counts;
    std::size_t strokes_kept = 0;                      // by the history of with_undo
    std::size_t tiles_lit = 0;                         // baked during the updates of with_light
    std::uint64_t rays_touched = 0, rays_changed = 0;  // summed over the updates
    std::uint64_t cells_remeshed = 0, triangles_remeshed = 0, triangles_published = 0;  // likewise; of whole tiles
    double first_mesh_ms = 0.0;  // of the whole uncut solid, on the host
    std::uint64_t rays_held = 0;
    std::size_t bytes = 0;  // of the rays, at the end
    std::uint64_t disagreeing_edges = 0;
    std::optional<IntervalCheck> intervals;  // nothing for a tool whose rays have no closed form
    geometry::TriangleMesh mesh;             // at the end, object frame, repaired as for export
    std::uint64_t self_intersections_mended = 0;
};

// Radii of the scene's ball within which the surface is published.
inline constexpr double kPublishedRadii = 1.25;
// Updates after which a stroke ends: a second of a session.
inline constexpr std::size_t kUpdatesAStroke = 100;

[[nodiscard]] Result<StrokeRun> run_stroke(const CarveScene& scene, const StrokeOptions& options);

}  // namespace burin::bench

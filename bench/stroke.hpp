// SPDX-License-Identifier: MIT
// A scene carved update by update, as a session does it while someone sculpts, and timed. One update is: the engine cuts one
// sweep; the surface is brought up to date, vertices and indices; a local surface is filled with references to
// the tiles near the tool, ready to be published to the haptic thread. On the Vulkan engine all is done on the device
// (compute/device_surface.hpp), and how much is whose is what the device's clock says; there the triangles near the tool come
// back, and the search grid for them is built on the host.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/lost_intervals.hpp"
#include "bench/scenes.hpp"
#include "geometry/triangle_mesh.hpp"

namespace burin::bench {

struct StrokeOptions {
    int resolution = 128;
    bool on_vulkan = false;  // else native code
    unsigned threads = 0;    // 0: one a core
};

struct StrokeRun {
    std::string engine;  // "cpu" or "vulkan"
    std::string device;  // what it ran on: the Vulkan device, or "native"
    bool software_device = false;
    unsigned threads = 0;
    int resolution = 0;
    double cell_m = 0.0;
    // One an update, wall time: the cut, the surface, the local surface, and all three; cpu_ms is the process' time for all
    // three on all threads.
    std::vector<double> carve_ms, mesh_ms, publish_ms, update_ms, cpu_ms;
    std::uint64_t rays_touched = 0, rays_changed = 0;                                   // summed over the updates
    std::uint64_t cells_remeshed = 0, triangles_remeshed = 0, triangles_published = 0;  // likewise; of whole tiles
    double first_mesh_ms = 0.0;  // of the whole untouched cube; on a device with the making of its programs
    std::uint64_t rays_held = 0;
    std::size_t bytes = 0;  // of the rays at the end
    std::uint64_t disagreeing_edges = 0;
    IntervalCheck intervals;
    TriangleMesh mesh;  // at the end, as it would be exported: mended
    std::uint64_t self_intersections_mended = 0;
};

// Published is what lies within this many tool radii of the tool.
inline constexpr double kPublishedRadii = 1.25;

[[nodiscard]] Result<StrokeRun> run_stroke(const CarveScene& scene, const StrokeOptions& options);

}  // namespace burin::bench

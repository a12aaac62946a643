// SPDX-License-Identifier: MIT
// Measures the cost and the accuracy of touch: ticks of the haptic loop on bumpy spheres
// (bench/haptics/bumpy_sphere.hpp) of 20 thousand to 2 million triangles and on a solid that is being carved; the proxy
// against the true surface; lost contacts; the time from an edit until it is felt; the force's jumps at the edges of
// facets.
//
// Ticks are whole steps of HapticLoop, from reading the device to publishing the tool. Paced: at 1 kHz, as
// HapticLoop::run does it, with a warm-up tick just before the deadline. Paced cold: asleep until the deadline and
// timed from waking, with caches as cold as other work left them. Back to back: one after the other. The device follows
// a path, pressed 1 to 2 mm deep at 100 mm/s, and does not yield to force, so that every run touches the same places.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::bench {

struct HapticsOptions {
    std::vector<std::size_t> sizes{20'000, 200'000, 2'000'000};  // approximate triangle counts; the last one is edited
    std::size_t accuracy_size = 200'000;
    std::uint64_t paced_ticks = 5'000;  // for each scene
    std::uint64_t back_to_back_ticks = 20'000;
    std::uint64_t accuracy_ticks = 20'000;
    std::uint64_t contact_ticks = 1'000'000;
    std::uint64_t edits = 100;
    int solid_resolution = 192;
    bool ask_for_realtime = true;  // real-time priority and locked memory, where the system grants them
};

// Returns options with small sizes and few ticks, to check within seconds that everything works.
[[nodiscard]] HapticsOptions quick_haptics();

// The ticks of one combination of scene, probe and pacing.
struct TickCosts {
    // Scene: "sphere" or "carving"; probe: "point", ..; pacing: "paced", "paced_cold" or "back_to_back".
    std::string scene, probe, pacing;
    std::size_t triangles = 0;
    std::vector<double> tick_us, lateness_us;  // one value a tick; lateness of paced ticks only
    std::vector<double> warm_up_us;          // of warm-up ticks, where there were any
    std::vector<double> triangles_tested, triangles_seen;
    std::uint64_t in_contact = 0, skipped_deadlines = 0, surfaces_used = 0;
};

// The errors of a point's proxy against the true surface.
struct ProxyErrors {
    std::size_t triangles = 0;
    std::uint64_t ticks = 0, in_contact = 0, not_solved = 0;
    std::vector<double> normal_mm;  // distance of the proxy from the true surface
    std::vector<double> lag_mm;     // distance of the proxy from the true surface's point nearest to the HIP
    double chord_mm = 0.0;          // largest distance of the mesh itself from the true surface
};

// Ticks in which the hand is farther inside the true surface than the mesh's own error, and those of them without
// contact. For the whole loop a tick is lost as well where nothing reaches the device although the gate is open.
struct LostContact {
    // "move_proxy": the search for the proxy alone, along a smooth path. "whole_loop": HapticLoop with friction,
    // limits, passivity and gate, a device with the Omni's encoder step, and a hand that shakes.
    std::string part;
    std::string unit;  // of the scene's coordinates: "m" or "mm"
    std::uint64_t ticks = 0, inside = 0, lost = 0, felt_outside = 0;
};

struct EditCosts {
    std::size_t triangles = 0, edited_triangles = 0;
    std::vector<double> prepare_ms;  // moving the vertices, making the snapshot, publishing
    std::uint64_t patches_made = 0, used_at_next_tick = 0, felt_at_next_tick = 0;
    double create_ms = 0.0, first_snapshot_ms = 0.0;
    std::size_t deformed_triangles = 0;
    std::vector<double> deform_ms;  // all vertices of the smallest mesh, up to the snapshot
};

// Changes of the spring force from one tick to the next, relative to the force, on a smooth sphere.
struct ForceJumps {
    std::size_t triangles = 0;
    bool shading = false;
    double largest_percent = 0.0, p99_percent = 0.0;
    double turn_of_surface_percent = 0.0;  // largest change of the true surface's normal between two ticks
};

struct Haptics {
    std::string machine;   // recorded before the first run
    std::string realtime;  // what the system granted
    HapticsOptions options;
    std::vector<TickCosts> ticks;
    ProxyErrors errors;
    std::vector<LostContact> contact;
    // Distance between the proxies of the same run in metres and in a scaled unit,
    // converted to metres. Coordinates times 1000 are rounded differently, so that now
    // and then the ball takes another way around a corner; times 1024 they are not.
    // Coordinates times 1000: one value for each tick with the HIP inside.
    std::vector<double> metres_and_millimetres_differ_um;
    double metres_and_1024ths_differ_um = 0.0;  // coordinates times 1024: the largest
    EditCosts edits;
    std::vector<ForceJumps> jumps;
};

using Tell = std::function<void(const std::string&)>;

// notify(line) is called before each part.
[[nodiscard]] Result<Haptics> run_haptics(const HapticsOptions& options, const Tell& notify);

// Measure one part each, into its fields of `all`.
[[nodiscard]] Result<void> measure_ticks(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_accuracy(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_edits(Haptics& all, const Tell& notify);

[[nodiscard]] std::string haptics_table(const Haptics& all);
// Returns a comment line that names the machine, one of column names, and a row for each scene of ticks.
[[nodiscard]] std::string haptics_csv(const Haptics& all);
[[nodiscard]] Json haptics_json(const Haptics& all);
// Plots, for each scene, the share of paced ticks that take a time or longer.
[[nodiscard]] std::string haptics_svg(const Haptics& all);

}  // namespace burin::bench

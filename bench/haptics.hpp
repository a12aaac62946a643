// SPDX-License-Identifier: MIT
// What touching costs and how true it is: ticks of the haptic loop on bumpy spheres (bench/bumpy_sphere.hpp) of 20 thousand to 2
// million triangles and on a solid under carving; the proxy against the true surface; contact that is lost; an edit until
// it is felt; the force's jumps at the edges of facets.
//
// Ticks are whole steps of HapticLoop, from reading the device to publishing the tool. Paced: at 1 kHz, as HapticLoop::run does it,
// with a rehearsal just before the deadline. Paced cold: asleep until the deadline and timed from waking, so that caches are
// as cold as another's work left them. Back to back: one after the other. The device is a path, pressed 1 to 2 mm deep at 100 mm/s, with no hand that gives way, so that every run
// touches the same places.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::bench {

struct HapticsOptions {
    std::vector<std::size_t> sizes{20'000, 200'000, 2'000'000};  // triangles, about; the last is the one that is edited
    std::size_t accuracy_size = 200'000;
    std::uint64_t paced_ticks = 5'000;  // of each scene
    std::uint64_t back_to_back_ticks = 20'000;
    std::uint64_t accuracy_ticks = 20'000;
    std::uint64_t contact_ticks = 1'000'000;
    std::uint64_t edits = 100;
    int solid_resolution = 192;
    bool ask_for_realtime = true;  // priority and locked memory, where the system grants them
};

// Small sizes and few ticks: whether everything works, in seconds.
[[nodiscard]] HapticsOptions quick_haptics();

// The ticks of one scene, probe and pacing.
struct TickCosts {
    std::string scene, probe, pacing;  // "sphere" or "carving"; "point", ..; "paced", "paced_cold" or "back_to_back"
    std::size_t triangles = 0;
    std::vector<double> tick_us, lateness_us;  // one each; lateness of paced ticks only
    std::vector<double> rehearsal_us;          // of those rehearsed
    std::vector<double> triangles_tested, triangles_seen;
    std::uint64_t in_contact = 0, skipped_deadlines = 0, surfaces_used = 0;
};

// The proxy of a point against the true surface.
struct ProxyErrors {
    std::size_t triangles = 0;
    std::uint64_t ticks = 0, in_contact = 0, not_solved = 0;
    std::vector<double> normal_mm;  // how far the proxy is from the true surface
    std::vector<double> lag_mm;     // how far from the true surface's point nearest to the HIP
    double chord_mm = 0.0;          // how far the mesh itself is from the true surface at most
};

struct LostContact {
    std::string unit;  // "m" or "mm": the scene's coordinates
    std::uint64_t ticks = 0, inside = 0, lost = 0, felt_outside = 0;
};

struct EditCosts {
    std::size_t triangles = 0, edited_triangles = 0;
    std::vector<double> prepare_ms;  // move the vertices, make the snapshot, publish
    std::uint64_t patches_made = 0, used_at_next_tick = 0, felt_at_next_tick = 0;
    double create_ms = 0.0, first_snapshot_ms = 0.0;
    std::size_t deformed_triangles = 0;
    std::vector<double> deform_ms;  // all vertices of the smallest mesh, to a snapshot
};

// Of the spring force from a tick to the next, over the force, on a smooth sphere.
struct ForceJumps {
    std::size_t triangles = 0;
    bool shading = false;
    double largest_percent = 0.0, p99_percent = 0.0;
    double turn_of_surface_percent = 0.0;  // what the true surface's normal turns by meanwhile
};

struct Haptics {
    std::string machine;   // before the first run
    std::string realtime;  // what the system granted
    HapticsOptions options;
    std::vector<TickCosts> ticks;
    ProxyErrors errors;
    std::vector<LostContact> contact;
    // Between the proxies of the two, in metres' terms. The same numbers times 1000 are rounded otherwise, so that now and then the
    // ball goes another way around a corner; times 1024 they are not.
    std::vector<double> metres_and_millimetres_differ_um;  // 1000 times as large: one each tick that any is inside
    double metres_and_1024ths_differ_um = 0.0;             // 1024 times as large: the most
    EditCosts edits;
    std::vector<ForceJumps> jumps;
};

using Tell = std::function<void(const std::string&)>;

// tell(line) is called before each part.
[[nodiscard]] Result<Haptics> run_haptics(const HapticsOptions& options, const Tell& tell);

// The parts, each into its place.
[[nodiscard]] Result<void> measure_ticks(Haptics& all, const Tell& tell);
[[nodiscard]] Result<void> measure_accuracy(Haptics& all, const Tell& tell);
[[nodiscard]] Result<void> measure_edits(Haptics& all, const Tell& tell);

[[nodiscard]] std::string haptics_table(const Haptics& all);
// First a comment line that names the machine, then one of column names; a row for each scene of ticks.
[[nodiscard]] std::string haptics_csv(const Haptics& all);
[[nodiscard]] Json haptics_json(const Haptics& all);
// How large a share of paced ticks takes as long or longer, a plot for each scene.
[[nodiscard]] std::string haptics_svg(const Haptics& all);

}  // namespace burin::bench

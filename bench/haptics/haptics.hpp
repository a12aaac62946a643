// SPDX-License-Identifier: MIT
// Measures the cost and the accuracy of touch: ticks of the haptic loop on scenes of detail (touch_scenes.hpp) and on a
// solid that is being carved, with a point, balls and many points, with friction and without; the proxy against the
// true surface; lost contacts; the time from an edit until it is felt; the force's jumps at the edges of facets.
//
// Ticks are whole steps of HapticLoop with a session's own settings (touch_run.hpp). The device follows a path, pressed
// 1 to 2 mm deep at 100 mm/s (surface_walk.hpp), and does not yield to force, so that every run touches the same
// places. Cold ticks are what counts; rehearsed and back-to-back ones stand beside them. The work of a tick is counted
// too: the counts do not depend on the machine.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "bench/haptics/touch_scenes.hpp"

namespace burin::bench {

struct HapticsOptions {
    // Approximate triangle counts of the spheres; the last one is edited.
    std::vector<std::size_t> sizes{20'000, 200'000, 2'000'000};
    TouchSceneOptions scenes{.spheres = sizes};
    std::size_t accuracy_size = 200'000;
    std::uint64_t paced_ticks = 2'000;         // of each scene and probe, cold, and as many rehearsed
    std::uint64_t back_to_back_ticks = 5'000;  // likewise; the counts are of these
    std::uint64_t peer_ticks = 1'000;          // cold, of each program and mode; twice as many back to back
    std::uint64_t accuracy_ticks = 20'000;
    std::uint64_t contact_ticks = 1'000'000;
    std::uint64_t edits = 100;
    std::uint64_t parts_turns = 12'000;            // of each scene and number of parts, in simulated time
    std::uint64_t shape_ticks = 6'000;             // of each scene and shape, in simulated time
    std::uint64_t wand_ticks = 10'000;             // through the tube, with each choice of ends; in simulated time
    std::vector<int> solid_resolutions{256, 512};  // cells along the side of a ball of 100 mm that is carved
    std::vector<int> carved_resolutions{128, 256, 512};  // of the block in which a tool lies in its own groove
    bool ask_for_realtime = true;  // real-time priority and locked memory, where the system grants them
};

// Returns options with small sizes and few ticks, to check within seconds that everything works.
[[nodiscard]] HapticsOptions quick_haptics();

// The ticks of one combination of scene, probe, friction and pacing.
struct TickCosts {
    std::string scene, probe, pacing;  // pacing: "cold", "rehearsed" or "back_to_back"
    bool friction = true;
    bool smooth = false;  // of the scene: a sphere
    std::size_t triangles = 0;
    double radius_m = 0.0, mean_edge_m = 0.0;  // of the probe; of the surface
    // One value a tick that counts: time and how late it began (0 back to back); time of the warm-up tick, where there
    // was one.
    std::vector<double> tick_us, lateness_us, warm_up_us;
    // The work of each: exact tests, looks at bounds, triangles and points gathered, steps of the proxy, solves for the
    // nearest point under planes; and what all this costs on the reference core, us, by which the tick is bounded
    // (haptics/contact/contact_work.hpp).
    std::vector<double> tests, looks, gathered, steps, solves, cost_us;
    // Ticks in contact, of which the work ran into its limit, with the probe inside the material and put outside, and
    // with the probe caught far from the hand; and deadlines that passed in a tick.
    std::uint64_t in_contact = 0, work_limited = 0, pushed_out = 0, left_behind = 0, skipped_deadlines = 0;
    std::uint64_t surfaces_used = 0;
    // Ticks without contact though the probe meets the mesh: counted back to back, for a point or one ball on a mesh.
    std::optional<std::uint64_t> contact_lost;
};

// Ticks of ours or of a peer's (bench/peers/proxy_peer.hpp), taken in turn on one mesh and path.
struct PeerTicks {
    // "burin_tick", the whole tick of our loop; "burin_contact", its proxy alone; "burin_unshaded", the same without
    // force shading, which the peer's proxy does not do; "chai3d_static", "chai3d_dynamic".
    std::string scene, probe, who;
    bool friction = true;
    std::size_t triangles = 0;
    double radius_m = 0.0;
    std::vector<double> cold_us, back_to_back_us;
    // Of the ticks back to back: how deep the ball is in the mesh, how far the proxy is from the hand, and from the
    // mesh's point nearest to the hand, for a point.
    std::vector<double> sunk_um, from_hand_mm, from_nearest_um;
    std::uint64_t contact_lost = 0;
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

// Parts of one device that share a turn's work, each on a walk of its own: a ball of 2 mm, or a fingertip of five
// points.
struct PartsShare {
    std::string scene;
    std::size_t triangles = 0, parts = 0, points = 1;  // of each part
    std::vector<double> turn_cost_us;                  // as counted, of all parts
    // Ticks of parts: in all; in contact; held over, since no work was left in their turn; with the ball caught far
    // from the hand; in which the watch let go. And the most turns in a row for which a part or points of it were held
    // over.
    std::uint64_t ticks = 0, in_contact = 0, held_over = 0, left_behind = 0, let_go = 0, longest_wait = 0;
};

// Ticks of a tool that touches with its shape, while the hand is down and moves.
struct ShapeTicks {
    std::string scene, tool;
    std::size_t triangles = 0;
    // In contact; of which the work or the steps ran out; and in which the tool stood still for that.
    std::uint64_t ticks = 0, in_contact = 0, limited = 0, frozen = 0, frozen_in_a_row = 0;
    std::vector<double> cost_us;  // of each, as counted
};

// What a tool feels in the groove that it cuts, and what is right: the most force once it is lifted clear, how fast it
// sinks under one and a half times its yield, the mean force of a hand 0.7 mm below the groove, the least force while
// a piece turns under the tool (turned_scene.hpp).
struct CarvedFeel {
    std::string row, tool, unit;
    int resolution = 0;  // cells along a block of 40 mm; 30 mm for the one that is pressed; 0: it is no lattice
    double right = 0.0, found = 0.0;
    std::uint64_t ticks = 0, limited = 0, let_go = 0;
};

// A wand in a tube: the work of a tick as counted, with both ends, or with one alone.
struct WandWork {
    std::string points;  // "both", "top", "bottom"
    std::uint64_t in_contact = 0;
    std::vector<double> cost_us;  // of each tick
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
    std::vector<std::string> notes;  // what could not be measured, and why
    std::vector<TickCosts> ticks;    // the worst first: by the p99.9 of cold ticks
    std::vector<PeerTicks> peers;    // five in turn for each combination; empty in a build without the peer
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
    std::vector<PartsShare> parts;
    std::vector<ShapeTicks> shapes;
    std::vector<CarvedFeel> carved;
    std::vector<WandWork> wand;  // both ends first, then each; empty where the tube is not here
};

using Tell = std::function<void(const std::string&)>;

// notify(line) is called before each part.
[[nodiscard]] Result<Haptics> run_haptics(const HapticsOptions& options, const Tell& notify);

// Measure one part each, into its fields of `all`.
// Has each scene that is rough, as what is touched in use is, measured: `what` is told with the scene's name. A scene
// that cannot be touched is left out; measure_ticks() tells of it.
[[nodiscard]] Result<void> on_rough_scenes(const Haptics& all, const Tell& notify, const std::string& what,
                                           const std::function<Result<void>(const TouchedScene&)>& measure);
[[nodiscard]] Result<void> measure_ticks(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_carving_ticks(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_peer_ticks(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_accuracy(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_parts(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_shapes(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_carved(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_wand(Haptics& all, const Tell& notify);
[[nodiscard]] Result<void> measure_edits(Haptics& all, const Tell& notify);

[[nodiscard]] std::string haptics_table(const Haptics& all);
// Returns a comment line that names the machine, one of column names, and a row for each scene of ticks.
[[nodiscard]] std::string haptics_csv(const Haptics& all);
[[nodiscard]] Json haptics_json(const Haptics& all);
// Plots, for the worst scenes, the share of cold ticks that take a time or longer.
[[nodiscard]] std::string haptics_svg(const Haptics& all);

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
// Options of `burin sculpt`: what is carved with what (SculptOptions), and how a live session is shown and controlled
// (LiveOptions).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compute/engine/chosen_engine.hpp"
#include "devices/registry/device_registry.hpp"
#include "scene/world_reading.hpp"
#include "sculpt/mirror.hpp"
#include "sculpt/workpiece.hpp"
#include "session/input/actions.hpp"
#include "session/options/edge_comfort.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::scene {
struct World;  // scene/world_file.hpp
}

namespace burin::session {

// The device of one hand of several: --device right=simulated.
struct NamedDevice {
    std::string hand, device;
    bool operator==(const NamedDevice&) const = default;
};
// Hands have names of letters, digits, - and _.
inline constexpr std::size_t kMostHands = 4;
// Reads "right=simulated". Fails on a name that no hand can have, and where no device is named.
[[nodiscard]] Result<NamedDevice> parse_named_device(const std::string& text);
// Reads what --device was given: one device alone, or a named one for each hand. Fails on two of one name.
[[nodiscard]] Result<void> set_devices(struct LiveOptions& live, const std::vector<std::string>& given);

// How much of a picture is drawn while the view moves (desk/draw/drawn_detail.hpp).
enum class DetailChoice { automatic, full };

struct LiveOptions {
    bool live = false;  // explicitly requested; also implied when there is neither a stroke nor an output
    std::string input;  // a log or a script that takes the user's place; empty: keyboard, mouse, trackers
    std::vector<toolbox::ToolSpec> tools_of_input;  // that the input takes up; no option of the command line
    std::string record;                             // path of the input recording; empty: none
    bool lsl = false;                               // ticks and events are streamed by Lab Streaming Layer
    // Streams of markers that it hears, by a name, a predicate or "" for all; none: it hears none.
    std::optional<std::string> lsl_markers = std::nullopt;
    // Folder for a journal of what is not saved; empty: the usual one of a person, none with an input; "none".
    std::string journal;
    bool offscreen = false;  // no window; needs an input
    std::string stereo;      // a mode's name; empty: mono in a window
    bool swap_eyes = false;
    EdgeComfort edge_comfort = EdgeComfort::automatic;  // on a lone screen
    std::string wall;  // wall file with screens, eyes and tracker; empty: one desktop window
    // A tracker's address, "udp:PORT", a file that describes one, or "none"; empty: the wall's, or keys fly the head.
    std::string tracker;
    std::string device = devices::kDefaultHapticDevice;  // name of a force-feedback device; of the first of several
    std::vector<NamedDevice> hands;                      // of all, where there are several; else empty
    bool device_given = false;                           // false: the device is the usual one
    // How the mouse leads the hand. None: along the surface where a person carves with it, once settle_mouse() has seen
    // to it; else freely, as logs and recordings from before there was a choice have it, and nothing on the panel tells
    // of it.
    std::optional<MouseMode> mouse = std::nullopt;
    bool windowed = false;    // the wall's screens as desktop windows, fitted into width x height
    std::string full_screen;  // a monitor's name or index; empty: a window
    // The panel has a window of its own and is on no picture; these show the activity's page alone.
    bool panel_window = false;
    // Size of the panel's letters; none: as the display asks, 1 in simulated time.
    std::optional<double> panel_scale = std::nullopt;
    // A person stands before a world: its picture fills what the panel leaves free, and the tool is under the cursor.
    // Logs and recordings from before are shown as they were. No option of the command line.
    bool frames_world = false;
    bool first_steps = false;  // a card of them is shown at first; no option of the command line
    int width = 1280, height = 720;
    std::uint32_t samples = 0;  // per pixel, 1 or 4; 0: 4 on hardware, 1 on a software device
    DetailChoice detail = DetailChoice::automatic;
    bool shadows = true;          // the objects of a world cast some
    std::string screenshots;      // folder for screenshots with a relative name; empty: the working directory
    std::string outputs;          // folder for all files of an input; empty: one named after the input
    bool writes_nothing = false;  // files that are asked for are left out
    // Exports are ordered as ever and refused, so that a session that is done again takes the same course.
    bool refuses_exports = false;
    bool stands_in = false;  // a recording is done again: no device is looked for
};

// Returns whether these options ask for streams, out or in.
[[nodiscard]] inline bool wants_streams(const LiveOptions& live) { return live.lsl || live.lsl_markers.has_value(); }

// Reads "free" or "surface".
[[nodiscard]] Result<MouseMode> parse_mouse_mode(const std::string& text, const std::string& where);
// Says why the mouse of a session cannot lead its hand along the surface; nothing where it can.
[[nodiscard]] std::optional<Error> no_surface(const struct SculptOptions& options);
// Decides what the options leave open: how the mouse leads the hand, and where that is along the surface and no device
// was given, by which arm. Fails where it is to be led along the surface and cannot.
[[nodiscard]] Result<void> settle_mouse(struct SculptOptions& options);

// Decides whether a world is framed: where a person explores one in a desktop's window.
void settle_view(struct SculptOptions& options);

// Decides how much room a workpiece has where the options leave it open: some where a person carves, or where material
// is added along a stroke; none for an input, because recordings and logs from before there was any have none.
void settle_room(struct SculptOptions& options, bool in_session);

// Returns the devices of all hands: one without a name where there is one hand.
[[nodiscard]] std::vector<NamedDevice> devices_of(const LiveOptions& live);

class Activity;  // session/activity/activity.hpp

enum class HandChoice { rigid, simulated };

struct SculptOptions {
    sculpt::WorkpieceOptions workpiece;
    std::string world;  // a file of objects that are touched besides the workpiece, or without one; empty: none
    scene::WorldReading world_reading;
    std::shared_ptr<const scene::World> scene;  // the world itself, in place of a file; no option of the command line
    bool no_workpiece = false;                  // with a world
    std::string points;  // of a handle, that touch (devices::points_named); empty: the tool is held in its middle
    toolbox::ToolOptions tool;
    sculpt::Mirror mirror;   // planes on whose other sides it works as well
    std::string stroke;      // a CSV file; empty: nothing is carved
    bool merge_rows = true;  // with a rigid hand: merge nearly straight runs of rows into one sweep
    compute::EngineChoice engine = compute::EngineChoice::automatic;
    // Makes it; none: the processor's, and a device that is asked for is refused. No option of the command line.
    compute::EngineMaker make_engine;
    HandChoice hand = HandChoice::rigid;
    toolbox::FeelOptions feel;  // with a simulated hand
    bool real_time = false;
    std::size_t undo = 0;                                   // strokes to undo at the end, from press to release
    std::size_t undo_memory_MiB = 1024;                     // memory for strokes that can be undone
    std::vector<std::string> exports;                       // STL, PLY, OBJ
    std::optional<LengthUnit> export_units = std::nullopt;  // none: those of the workpiece's file, metres for a shape
    std::optional<double> simplify_m;  // bound on the exported surface's motion; none: all triangles
    std::optional<double> crumbs_m;    // size below which loose pieces are not exported; none: as usual_crumbs says
    bool usual_crumbs = false;         // kCrumbCells; else all are kept. No option of the command line
    std::string pictures;              // a folder; empty: none
    std::string report;                // a JSON file; empty: none; plots of the felt stroke lie beside it
    unsigned threads = 0;              // 0: one per core
    // A recording from before sessions knew of units: the panel's ranges suit no workpiece in particular, and nothing
    // is said of sizes that do not fit. No option of the command line.
    bool from_before_units = false;
    std::shared_ptr<Activity> activity;  // null: none; no option of the command line
    // Facts of the program, for documents: version, compiler. No option of the command line.
    std::vector<std::pair<std::string, std::string>> provenance;
    LiveOptions live;
};

// Returns whether the options name a world, and a workpiece.
[[nodiscard]] inline bool has_world(const SculptOptions& options) { return options.scene || !options.world.empty(); }
[[nodiscard]] inline bool has_workpiece(const SculptOptions& options) {
    return !options.no_workpiece || !has_world(options);
}

}  // namespace burin::session

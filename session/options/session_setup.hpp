// SPDX-License-Identifier: MIT
// What a session is made of, as plain data: whose hands touch which scene, what that means, what is recorded of it and
// what becomes of the work. CarveOptions are those of carving, DeskOptions how a person sees and leads it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/registry/device_registry.hpp"
#include "scene/world_reading.hpp"
#include "session/input/actions.hpp"
#include "session/options/carve_options.hpp"
#include "session/options/desk_options.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::scene {
struct World;  // scene/world_file.hpp
}

namespace burin::session {

class Activity;  // session/activity/activity.hpp

// The device of one hand of several: --device right=simulated.
struct NamedDevice {
    std::string hand, device;
    bool operator==(const NamedDevice&) const = default;
};
// Hands have names of letters, digits, - and _.
inline constexpr std::size_t kMostHands = 4;

struct HandsSetup {
    std::string device = devices::kDefaultHapticDevice;  // name of a force-feedback device; of the first of several
    std::vector<NamedDevice> named;                      // of all, where there are several; else empty
    bool device_given = false;                           // false: the device is the usual one
    std::string points;  // of a handle, that touch (devices::points_named); empty: the tool is held in its middle
    toolbox::ToolOptions tool;
    // How the mouse leads the hand. None: along the surface where a person carves with it, once settle_mouse() has seen
    // to it; else freely, as logs and recordings from before there was a choice have it, and nothing on the panel tells
    // of it.
    std::optional<MouseMode> mouse = std::nullopt;
};

// What is touched.
struct SceneSetup {
    std::string world;  // a file of objects that are touched besides the workpiece, or without one; empty: none
    scene::WorldReading reading;
    std::shared_ptr<const scene::World> given;  // the world itself, in place of a file; no option of the command line
    bool no_workpiece = false;                  // with a world
};

// What leads the session in a person's place, and what is recorded and streamed of it.
struct RecordSetup {
    std::string input;  // a log or a script that takes the user's place; empty: keyboard, mouse, trackers
    std::vector<toolbox::ToolSpec> tools_of_input;  // that the input takes up; no option of the command line
    std::string path;                               // of the recording; empty: none
    bool lsl = false;                               // ticks and events are streamed by Lab Streaming Layer
    // Streams of markers that it hears, by a name, a predicate or "" for all; none: it hears none.
    std::optional<std::string> lsl_markers = std::nullopt;
    bool stands_in = false;  // a recording is done again: no device is looked for
    // A recording from before sessions knew of units: the panel's ranges suit no workpiece in particular, and nothing
    // is said of sizes that do not fit. No option of the command line.
    bool from_before_units = false;
};

inline constexpr const char* kOpensWork = "burin sculpt";

// What becomes of the work.
struct WorkSetup {
    // Folder for a journal of what is not saved; empty: the usual one of a person, none with an input; "none".
    std::string journal;
    // The command that opens what the journal keeps, before its path, and the journal that this session's activity goes
    // on from, if any; it goes once there is this session's own. No options of the command line.
    std::string opened_by = kOpensWork, goes_on_from = {};
    std::string outputs;          // folder for all files of an input; empty: one named after the input
    bool writes_nothing = false;  // files that are asked for are left out
    // Exports are ordered as ever and refused, so that a session that is done again takes the same course.
    bool refuses_exports = false;
    // Facts of the program, for documents: version, compiler. No option of the command line.
    std::vector<std::pair<std::string, std::string>> provenance;
};

struct SessionSetup {
    HandsSetup hands;
    SceneSetup scene;
    CarveOptions carve;
    std::shared_ptr<Activity> activity;  // null: none; no option of the command line
    RecordSetup record;
    WorkSetup work;
    DeskOptions desk;
    unsigned threads = 0;  // 0: one per core
};

// Reads "right=simulated". Fails on a name that no hand can have, and where no device is named.
[[nodiscard]] Result<NamedDevice> parse_named_device(const std::string& text);
// Reads what --device was given: one device alone, or a named one for each hand. Fails on two of one name.
[[nodiscard]] Result<void> set_devices(HandsSetup& hands, const std::vector<std::string>& given);
// Returns the devices of all hands: one without a name where there is one hand.
[[nodiscard]] std::vector<NamedDevice> devices_of(const HandsSetup& hands);

// Returns whether these options ask for streams, out or in.
[[nodiscard]] inline bool wants_streams(const RecordSetup& record) {
    return record.lsl || record.lsl_markers.has_value();
}

// Reads "free" or "surface".
[[nodiscard]] Result<MouseMode> parse_mouse_mode(const std::string& text, const std::string& where);
// Says why the mouse of a session cannot lead its hand along the surface; nothing where it can.
[[nodiscard]] std::optional<Error> no_surface(const SessionSetup& setup);
// Decides what the options leave open: how the mouse leads the hand, and where that is along the surface and no device
// was given, by which arm. Fails where it is to be led along the surface and cannot.
[[nodiscard]] Result<void> settle_mouse(SessionSetup& setup);
// Decides whether a world is framed: where a person explores one in a desktop's window.
void settle_view(SessionSetup& setup);
// Decides how much room a workpiece has where the options leave it open: some where a person carves, or where material
// is added along a stroke; none for an input, because recordings and logs from before there was any have none.
void settle_room(SessionSetup& setup, bool in_session);

// Returns whether the options name a world, and a workpiece.
[[nodiscard]] inline bool has_world(const SessionSetup& setup) {
    return setup.scene.given || !setup.scene.world.empty();
}
[[nodiscard]] inline bool has_workpiece(const SessionSetup& setup) {
    return !setup.scene.no_workpiece || !has_world(setup);
}

}  // namespace burin::session

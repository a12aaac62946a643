// SPDX-License-Identifier: MIT
// State of a session except what is carved: where the scene is, and which tool each hand holds. A struct, and functions
// that change it by commands; what other parts have to be told comes out as a list of orders. No clock, thread or
// viewer: the same commands give the same states. Who sees it, and with what, is the desk's (desk/viewer/viewer.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/haptic/haptic_device.hpp"
#include "haptics/tick_parameters.hpp"
#include "sculpt/feel_options.hpp"
#include "sculpt/sculpt_order.hpp"
#include "sculpt/tool_options.hpp"
#include "session/held/hand_state.hpp"
#include "session/input/input_event.hpp"
#include "session/notices/message_kind.hpp"
#include "session/objects/world_history.hpp"
#include "session/objects/world_objects.hpp"
#include "session/state/asked_close.hpp"
#include "session/state/command_table.hpp"
#include "session/state/smooth_stroke.hpp"

namespace burin::session {

// A session has one hand or more. Mouse, keys and panel lead one of them.
struct SessionState {
    std::vector<HandState> hands{1};  // by number; at least one
    std::size_t hand = 0;             // the one that is led
    Similarity world_from_object, home_world_from_object;
    // How often a command has placed workpiece or workspace anew; between, the workpiece moves as it is led.
    std::uint64_t placed = 1;
    Vec3 middle_object{0.0};                   // of all that can be touched
    std::shared_ptr<const ToolMeshes> meshes;  // that tools of files are taken from; null: there are none
    sculpt::FeelSettings feel;
    bool carves = true;                 // there is a workpiece
    bool saves = true;                  // the work can be saved
    sculpt::Mirror mirror;              // planes on whose other sides the workpiece is carved as well
    MouseMode mouse = MouseMode::free;  // how a mouse leads the hand in use
    // Somebody has chosen that. Logs from before there was a choice fill on the surface alone, and still do.
    bool mouse_chosen = false;
    std::shared_ptr<const WorldObjects> world;  // null: none
    WorldHistory edits;                         // of its objects, where they can be saved
    std::size_t strokes = 0;                    // that can be undone, as far as a frame knows
    std::optional<SmoothStroke> smooth_stroke;  // while one lasts
    std::string export_path = "part.stl";
    LengthUnit export_unit = LengthUnit::m;
    double crumbs_m = 0.0;  // size below which loose pieces are not exported
    AskedClose asked;       // about the document
    bool quit = false;
    bool discards = false;  // what was not saved is not wanted

    [[nodiscard]] HandState& led() { return hands[hand]; }
    [[nodiscard]] const HandState& led() const { return hands[hand]; }
};

// Has mouse, keys and panel lead another hand. Fails where there is none of that name, and says which there are.
[[nodiscard]] Result<void> lead_hand(SessionState& state, const std::string& name);

// A file that is asked for, or a message about what was.
struct Asked {
    std::string text;
    std::size_t line = 0;  // of the log that asked; 0: none
    MessageKind kind = MessageKind::warning;
    bool replaces = false;  // a file that is there may go
};

// A save, of the work as it was when it was asked for.
struct AskedSave : Asked {
    std::size_t after = 0;                           // so many of the step's orders for the workpiece
    std::shared_ptr<const WorldObjects> world = {};  // null: there is none
    std::uint64_t edits_state = 0;                   // WorldHistory::state()
};

// What the activity is told by a command.
struct AskedAct {
    std::vector<std::string> words;
    std::size_t line = 0;  // of the log that asked; 0: none
};

// How the device's amplifiers are to be switched.
struct AskedAmplifiers {
    bool on = true;
    std::size_t line = 0;  // of the log that asked; 0: none
};

// Orders that a step gives to the other parts of the session.
struct SessionOrders {
    std::size_t line = 0;  // of the log, for commands that are run now
    std::vector<sculpt::SculptOrder> carving;
    std::vector<WorldOrder> world;
    std::vector<HoldOrder> holds;  // after the edits of `world`
    std::vector<AskedAct> acts;
    std::vector<AskedAmplifiers> amplifiers;
    bool parameters = false;         // the haptic thread's parameters have changed
    std::vector<Asked> screenshots;  // names
    std::vector<AskedSave> saves;    // names of documents; empty: the one that there is
    std::vector<Asked> names;        // of documents whose places are to be looked at before they are saved there
    bool put_away = false;           // the messages that are shown
    std::vector<Asked> messages;     // for the user: why a command was not carried out; with the line of one in a log
};

// How far a hand reaches in its device: a stylus as is usual, a handle over a workspace of its device's own, and what
// is worn as far as an arm does.
enum class Reach : std::uint8_t { stylus, own, arm };

// What of a hand's device decides how it is placed and led.
struct HandRoom {
    Vec3 workspace_device_m{0.1626, 0.1219, 0.0711};
    Reach reach = Reach::stylus;
    bool is_upright = false;           // rests standing, as a handle with its points below does
    Quat rest_device = pen_at_rest();  // orientation at rest
    // Where the mouse does not lead it along the surface; with the hand only once that was chosen.
    haptics::FillPlace fills = haptics::FillPlace::surface;
};

// What there is to be touched, and with how many hands, before the first step.
struct Room {
    Box workpiece_object;               // of all that stands there
    std::optional<Box> carved_object;   // of the workpiece that is carved; none: there is none
    Box lattice_object;                 // within which material can be added; empty: nothing is carved
    bool covers_depth = false;          // the workspace reaches all of it, not its front alone
    std::optional<Box> reach_object;    // what the workspace reaches, if not that
    std::vector<HandRoom> hands{1};     // at least one
    MouseMode mouse = MouseMode::free;  // at the start
    bool mouse_chosen = false;
};
// Returns the first state: the workpiece at this place in the world, each hand's workspace over its front, and all
// hands with the same tool. handles: of each hand that has one, by number; hands: their names, none for one alone.
[[nodiscard]] SessionState begin_session(const Room& room, const sculpt::ToolSettings& tool,
                                         const sculpt::FeelSettings& feel, const Similarity& world_from_object = {},
                                         std::shared_ptr<const ToolMeshes> meshes = nullptr,
                                         std::span<const std::shared_ptr<const HeldHandle>> handles = {},
                                         std::span<const std::string> hands = {});
// Places a hand's workspace with its center at the workpiece's front, large enough to cover its width and height.
[[nodiscard]] Similarity world_from_workspace(const Room& room, const HandRoom& hand,
                                              const Similarity& world_from_object, const HeldHandle* held);
// Returns where a hand rests: this far before its workspace's front.
[[nodiscard]] Vec3 resting_hand_device(const HandRoom& hand, const HeldHandle* held, double before_front_m);
// Returns where the workspace is in the workpiece's own frame while a mouse leads the hand along its surface: around
// all of it, with room for the tool on each side, however it is turned before the viewer.
[[nodiscard]] Similarity object_from_device_on_surface(const Room& room);
// Returns how the device of a hand is mapped into the workpiece's frame.
[[nodiscard]] Similarity object_from_device(const SessionState& state, const Room& room, std::size_t hand);
// Makes the tool of the settings of the hand in use ready to be held.
[[nodiscard]] Result<void> take_up(SessionState& state);

// Runs a command by its name (command_table.hpp). On an Error, which says what would be right, nothing has changed.
// Commands of a viewer are a Leader's (leader.hpp), and fail here: nobody sees the session.
[[nodiscard]] Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command);
[[nodiscard]] Result<void> run_command(SessionState& state, SessionOrders& orders, const SessionCommand& command);

// Returns the parameters that the haptic thread is to use for a hand.
[[nodiscard]] haptics::TickParameters parameters_of(const SessionState& state, const Room& room, std::size_t hand);
// Returns them for what the hand holds: a device, whose most force is the gate's limit.
[[nodiscard]] inline haptics::TickParameters parameters_of(const SessionState& state, const Room& room,
                                                           std::size_t hand, const devices::DeviceDescription& device) {
    haptics::TickParameters parameters = parameters_of(state, room, hand);
    parameters.limits.max_force_N = device.max_force_N;
    return parameters;
}
[[nodiscard]] inline haptics::TickParameters parameters_of(const SessionState& state, const Room& room) {
    return parameters_of(state, room, state.hand);
}
// Returns the tool that the carving side is to use; the Error says what is wrong with it.
[[nodiscard]] Result<sculpt::UseTool> tool_of(const SessionState& state);
}  // namespace burin::session

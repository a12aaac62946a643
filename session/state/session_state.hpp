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

#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "base/space.hpp"
#include "document/history.hpp"
#include "session/held/hand_state.hpp"
#include "session/input/actions.hpp"
#include "session/objects/world_history.hpp"
#include "session/state/asked_close.hpp"
#include "session/state/smooth_stroke.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/mirror.hpp"

namespace burin::devices {
struct DeviceDescription;  // devices/haptic/haptic_device.hpp
}  // namespace burin::devices

namespace burin::haptics {
struct TickParameters;  // haptics/tick_parameters.hpp
}  // namespace burin::haptics

namespace burin::workpiece {
struct UseTool;  // workpiece/carve_order.hpp
}  // namespace burin::workpiece

namespace burin::session {

struct HandRoom;      // session/state/session_room.hpp
struct HeldHandle;    // session/held/held_handle.hpp
struct Room;          // session/state/session_room.hpp
class ToolMeshes;     // session/held/held_tool.hpp
struct WorldObjects;  // session/objects/world_objects.hpp

// A session has one hand or more. Mouse, keys and panel lead one of them.
struct SessionState {
    std::vector<HandState> hands{1};  // by number; at least one
    std::size_t hand = 0;             // the one that is led
    Similarity world_from_object, home_world_from_object;
    // How often a command has placed workpiece or workspace anew; between, the workpiece moves as it is led.
    std::uint64_t placed = 1;
    Vec3 middle_object{0.0};                   // of all that can be touched
    std::shared_ptr<const ToolMeshes> meshes;  // that tools of files are taken from; null: there are none
    toolbox::FeelSettings feel;
    bool carves = true;                 // there is a workpiece
    bool saves = true;                  // the work can be saved
    bool saves_brought = false;         // a part that the activity has brought can be, though the rest is its own
    toolbox::Mirror mirror;             // planes on whose other sides the workpiece is carved as well
    MouseMode mouse = MouseMode::free;  // how a mouse leads the hand in use
    // Somebody has chosen that. Logs from before there was a choice fill on the surface alone, and still do.
    bool mouse_chosen = false;
    std::shared_ptr<const WorldObjects> world;  // null: none
    WorldHistory edits;                         // of its objects, where they can be saved
    document::History history;                  // of the steps of all parts, as far as a frame knows
    std::optional<SmoothStroke> smooth_stroke;  // while one lasts
    std::string export_path = "part.stl";
    LengthUnit export_unit = LengthUnit::m;
    double crumbs_m = 0.0;  // size below which loose pieces are not exported
    AskedClose asked;       // about the document
    bool quit = false;
    bool discards = false;  // what was not saved is not wanted

    [[nodiscard]] HandState& led() { return hands[hand]; }
    [[nodiscard]] const HandState& led() const { return hands[hand]; }
    // The numbers of the scene's parts, which are those of a document's: a workpiece is the first, then the objects.
    static constexpr std::uint32_t kWorkpiecePart = 0;
    [[nodiscard]] std::uint32_t objects_part() const { return carves ? 1 : 0; }
};

// Has mouse, keys and panel lead another hand. Fails where there is none of that name, and says which there are.
[[nodiscard]] Result<void> lead_hand(SessionState& state, const std::string& name);

// Returns the first state: the workpiece at this place in the world, each hand's workspace over its front, and all
// hands with the same tool. handles: of each hand that has one, by number; hands: their names, none for one alone.
[[nodiscard]] SessionState begin_session(const Room& room, const toolbox::ToolSettings& tool,
                                         const toolbox::FeelSettings& feel, const Similarity& world_from_object = {},
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

// Returns the parameters that the haptic thread is to use for a hand.
[[nodiscard]] haptics::TickParameters parameters_of(const SessionState& state, const Room& room, std::size_t hand);
// Returns them for what the hand holds: a device, whose most force is the gate's limit.
[[nodiscard]] haptics::TickParameters parameters_of(const SessionState& state, const Room& room, std::size_t hand,
                                                    const devices::DeviceDescription& device);
[[nodiscard]] haptics::TickParameters parameters_of(const SessionState& state, const Room& room);
// Returns the tool that the carving side is to use; the Error says what is wrong with it.
[[nodiscard]] Result<workpiece::UseTool> tool_of(const SessionState& state);
}  // namespace burin::session

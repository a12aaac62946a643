// SPDX-License-Identifier: MIT
// What a live session is, but for what is carved: where head and scene are, which tool is held, how it is shown. A struct and functions that
// change it by events and commands; what others have to be told comes out as a list of orders. No clock, no thread, no window:
// the same events give the same states.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/feel_options.hpp"
#include "app/session/carving_desk.hpp"
#include "app/session/command_table.hpp"
#include "app/session/desk_input.hpp"
#include "app/session/input_source.hpp"
#include "app/session/input_wand.hpp"
#include "app/session/session_head.hpp"
#include "app/session/session_screens.hpp"
#include "app/tool_option.hpp"
#include "haptics/channels.hpp"
#include "renderer/output/output_settings.hpp"
#include "renderer/scene.hpp"

namespace burin {

struct SessionState {
    DeskState desk;
    SessionHead head;
    WandState wands;
    Similarity world_from_object, home_world_from_object;
    Similarity world_from_device;  // where the hand's workspace stands in the room
    double interpupillary_m = 0.063;
    ToolOptions tool;
    FeelOptions feel;
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;
    // a of the exponentially weighted means of force (P11) and velocity; 0: none.
    double force_filter = 0.0, velocity_filter = 0.0;
    double workspace_gain = 1.0;  // on top of what the workspace has at home
    bool force_on = true;
    bool force_shown = false;  // as an arrow
    bool only_touch = false;   // the tool feels and leaves all as it is
    OutputSettings output;     // of the main screen (output_on(), session_screens.hpp)
    bool panel = true, help = false, figures = false;
    std::string export_path = "part.stl";
    bool quit = false;
};

// What a step wants of the others.
struct SessionOrders {
    std::vector<CarvingOrder> carving;
    bool parameters = false;  // the haptic thread's are other ones
    std::vector<std::string> screenshots;
    bool full_screen = false;           // exchange window and full screen
    std::vector<std::string> messages;  // for people
};

// Where things are at the start: the workpiece before the viewer, the hand's workspace over its front.
struct Room {
    Box workpiece_object;
    SessionWall wall;
    Vec3 workspace_device_m{0.1626, 0.1219, 0.0711};
    DeskSettings desk;

    [[nodiscard]] Screen screen() const { return screen_world(wall.setup, wall.setup.screens[wall.main]); }
};
// Fits the workpiece into the room.
[[nodiscard]] SessionState begin_session(const Room& room, const ToolOptions& tool, const FeelOptions& feel,
                                         const OutputSettings& output);

// What a step must know of the rest of the session.
struct Captured {  // what the panel keeps for itself
    bool mouse = false, keyboard = false;
};
struct SessionView {
    double dt_s = 0.0;           // since the step before
    Nanoseconds display_ns = 0;  // when the picture is to be seen
    ImageSize eye_size;          // of the main screen
    ToolState tool;
    Captured captured;
};
struct SessionStep {
    SessionState state;
    SessionOrders orders;
    HandTarget hand;
};
[[nodiscard]] SessionStep step_session(SessionState state, const Room& room, std::span<const InputEvent> events,
                                       const SessionView& view);

// By its name (command_table.hpp); an Error says what would be right, and changes nothing.
[[nodiscard]] Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command);

// What the haptic thread is to use.
[[nodiscard]] TickParameters parameters_of(const SessionState& state, const Room& room);
// What the carving side is to use; an Error says what is wrong with the tool.
[[nodiscard]] Result<UseTool> tool_of(const SessionState& state);
// What one screen shows; nothing where an eye is not in front of it.
[[nodiscard]] std::optional<Scene> scene_of(const SessionState& state, const Room& room, std::size_t screen,
                                            const Vec3& lattice_origin_object, const ToolState& tool);
// What in the scene strains the eyes, on the main screen.
[[nodiscard]] ComfortFinding comfort_of(const SessionState& state, const Room& room, const ToolState& tool);

}  // namespace burin

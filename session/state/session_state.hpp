// SPDX-License-Identifier: MIT
// State of a live session except what is carved: where head and scene are, which tool is held, how it is shown. A
// struct, and functions that change it by events and commands; what other parts have to be told comes out as a list of
// orders. No clock, thread or window: the same events give the same states.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "desk/input/desk_input.hpp"
#include "desk/input/input_wand.hpp"
#include "desk/view/fitted_view.hpp"
#include "desk/view/session_head.hpp"
#include "desk/view/session_screens.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "haptics/channels.hpp"
#include "picture/picture.hpp"
#include "sculpt/carved_part.hpp"
#include "sculpt/feel_options.hpp"
#include "sculpt/tool_options.hpp"
#include "session/held/hand_state.hpp"
#include "session/input/input_event.hpp"
#include "session/notices/message_kind.hpp"
#include "session/objects/world_history.hpp"
#include "session/objects/world_objects.hpp"
#include "session/options/edge_comfort.hpp"
#include "session/state/asked_close.hpp"
#include "session/state/command_table.hpp"
#include "session/state/shown_guides.hpp"
#include "session/state/smooth_stroke.hpp"
#include "wall/output_settings.hpp"

namespace burin::session {

// A session has one hand or more. Mouse, keys and panel lead one of them, whose state is the session's own; the others
// wait in `hands`.
struct SessionState : HandState {
    std::vector<HandState> hands;  // of all, by number; that of the hand in use is out of date. Empty: there is one
    std::size_t hand = 0;          // in use
    DeskState desk;
    SessionHead head;
    WandState wands;
    Similarity world_from_object, home_world_from_object;
    // How often a command has placed workpiece or workspace anew; between, the workpiece moves as it is led.
    std::uint64_t placed = 1;
    Vec3 middle_object{0.0};  // of all that stands before the viewer
    double interpupillary_m = 0.063;
    std::shared_ptr<const ToolMeshes> meshes;  // that tools of files are taken from; null: there are none
    sculpt::FeelSettings feel;
    bool force_shown = false;  // as an arrow
    EdgeComfort edge_comfort = EdgeComfort::automatic;
    bool carves = true;                 // there is a workpiece
    bool saves = true;                  // the work can be saved
    bool framed = false;                // a world, beside the panel (LiveOptions::frames_world)
    sculpt::Mirror mirror;              // planes on whose other sides the workpiece is carved as well
    MirrorPanes mirror_panes;           // none where nothing is carved
    Vec3 mirror_middle_object{0.0};     // of the workpiece, through which the planes go
    MouseMode mouse = MouseMode::free;  // how it leads the hand in use
    // Somebody has chosen that. Logs from before there was a choice fill on the surface alone, and still do.
    bool mouse_chosen = false;
    std::string no_surface;                     // why it cannot lead it along a surface; empty: it can
    std::shared_ptr<const WorldObjects> world;  // null: none
    WorldHistory edits;                         // of its objects, where they can be saved
    std::size_t strokes = 0;                    // that can be undone, as far as a frame knows
    scene::ObjectId selected = 0;               // on the panel; 0: the first
    wall::OutputSettings output;                // of the main screen (output_on(), session_screens.hpp)
    bool panel = true, help = false, figures = false, devices = false;
    std::optional<SmoothStroke> smooth_stroke;  // while one lasts
    bool first_steps = false;                   // the card for who sees this for the first time
    SeenFrom seen_from;                         // as of the last step
    std::optional<Action> over_cube;            // the view whose face is under the cursor (view_cube.hpp)
    bool pressed_cube = false;                  // the left button went down on it
    std::string export_path = "part.stl";
    LengthUnit export_unit = LengthUnit::m;
    double crumbs_m = 0.0;  // size below which loose pieces are not exported
    AskedClose asked;       // about the document
    bool quit = false;
    bool discards = false;  // what was not saved is not wanted
};

[[nodiscard]] inline std::size_t hands_of(const SessionState& state) {
    return state.hands.empty() ? 1 : state.hands.size();
}
[[nodiscard]] inline const HandState& hand_of(const SessionState& state, std::size_t hand) {
    return hand == state.hand ? state : state.hands[hand];
}
[[nodiscard]] inline HandState& hand_of(SessionState& state, std::size_t hand) {
    return hand == state.hand ? state : state.hands[hand];
}
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
    bool full_screen = false;        // toggle between window and full screen
    bool put_away = false;           // the messages that are shown
    std::vector<Asked> messages;     // for the user: why a command was not carried out; with the line of one in a log
};

// What of a hand's device decides how mouse and keys lead it.
struct HandRoom {
    Vec3 workspace_device_m{0.1626, 0.1219, 0.0711};
    DeskSettings desk;
    // Where the mouse does not lead it along the surface; with the hand only once that was chosen.
    haptics::FillPlace fills = haptics::FillPlace::surface;
};

// Positions at the start: the workpiece before the viewer, the hand's workspace over its front.
struct Room : HandRoom {
    Box workpiece_object;              // of all that stands before the viewer
    std::optional<Box> carved_object;  // of the workpiece that is carved; none: there is none
    Box lattice_object;                // within which material can be added; empty: nothing is carved
    bool covers_depth = false;         // the workspace reaches all of it, not its front alone
    std::optional<Box> reach_object;   // what the workspace reaches, if not that
    SessionWall wall;
    std::vector<HandRoom> others;       // of the hands after the first
    MouseMode mouse = MouseMode::free;  // at the start
    bool mouse_chosen = false;
    bool offers_mouse = false;  // the panel has the choice
    bool first_steps = false;   // are shown at first
    double panel_scale = 1.0;   // of the panel's letters on a desktop
    bool frames_world = false;  // LiveOptions::frames_world
    double free_width = 1.0;    // of the main screen's picture, that the panel leaves free at its left
    // Why the mouse cannot lead the hand along a surface; empty: it can.
    std::string no_surface;

    [[nodiscard]] const HandRoom& of(std::size_t hand) const { return hand == 0 ? *this : others[hand - 1]; }
    [[nodiscard]] wall::Screen screen() const { return wall::screen_world(wall.setup, wall.setup.screens[wall.main]); }
};
// Places the workpiece before the viewer and returns the first state.
// Each hand begins with the tool; handles: of each hand that has one, by number; hands: their names, none for one
// alone.
[[nodiscard]] SessionState begin_session(const Room& room, const sculpt::ToolSettings& tool,
                                         const sculpt::FeelSettings& feel, const wall::OutputSettings& output,
                                         std::shared_ptr<const ToolMeshes> meshes = nullptr,
                                         std::span<const std::shared_ptr<const HeldHandle>> handles = {},
                                         std::span<const std::string> hands = {});
// Makes the tool of the settings of the hand in use ready to be held.
[[nodiscard]] Result<void> take_up(SessionState& state);

// What a step must know of the rest of the session: input that the panel captures, times, and the tool.
struct Captured {
    bool mouse = false, keyboard = false;
};
struct SessionView {
    double dt_s = 0.0;           // since the step before
    Nanoseconds display_ns = 0;  // when the picture is to be seen
    ImageSize eye_size;          // of the main screen
    haptics::ToolState tool;     // of the hand in use
    Captured captured;
    std::span<const haptics::ToolState> tools = {};  // of each hand; empty: of the only one
    wall::OutputPlace output = {};                   // of the main screen
    const SeenSurface* surface = nullptr;            // null: none is known, and the mouse flies freely
};
struct SessionStep {
    SessionState state;
    SessionOrders orders;
    std::size_t led_hand = 0;  // the hand in use when the step began
    // Where that hand is to go meanwhile, at the times of the events, and at the end.
    std::vector<devices::SteeredTarget> hand_way;
    devices::HandTarget hand;
};
[[nodiscard]] SessionStep step_session(SessionState state, const Room& room, std::span<const InputEvent> events,
                                       const SessionView& view);

// Has the tool smooth from the press of a stroke that began with Shift until all of it has been carved, given the
// gestures with which strokes on the surface began in a step.
[[nodiscard]] Result<void> follow_smooth_stroke(SessionState& state, SessionOrders& orders,
                                                std::span<const Gesture> strokes, const SessionView& view);

// Runs a command by its name (command_table.hpp). On an Error, which says what would be right, nothing has changed.
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
// Returns the scene that one screen shows, with the tool of the hand in use; nothing where an eye is not in front of
// it.
[[nodiscard]] std::optional<picture::Picture> scene_of(const SessionState& state, const Room& room, std::size_t screen,
                                                       const Vec3& lattice_origin_object,
                                                       const haptics::ToolState& tool);
// Adds the tool of another part of the hands to a picture: the tool of a hand, where a part of it has it.
void add_tool(picture::Picture& scene, const SessionState& state, std::size_t hand, const haptics::ToolState& tool);
// Returns whether the screens are such that parallax could fade towards an edge: a lone one, which both eyes see their
// own pictures on. Adjoining screens have no edge that could cut off what stands in front, and a fade would break the
// picture apart there.
[[nodiscard]] bool could_fade_at_edges(const SessionState& state, const Room& room, std::size_t screen);
// Returns whether it does.
[[nodiscard]] bool fades_at_edges(const SessionState& state, const Room& room, std::size_t screen);
// Judges what in the scene strains the eyes, on the main screen.
[[nodiscard]] wall::ComfortFinding comfort_of(const SessionState& state, const Room& room,
                                              const haptics::ToolState& tool);

}  // namespace burin::session

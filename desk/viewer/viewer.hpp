// SPDX-License-Identifier: MIT
// Who sees and leads a session, as plain data: the head, mouse and keys, the tracker's wands, and how the session is
// shown. A session knows nothing of it but where it is led (session/state/leader.hpp). Pure; any thread.
//
//   viewer_lead.hpp      what keys, mouse and trackers do in a step, and a viewer's own commands
//   viewed_picture.hpp   the picture that a screen shows
// Frames: world, object, device; metres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "desk/input/desk_input.hpp"
#include "desk/input/input_wand.hpp"
#include "desk/view/fitted_view.hpp"
#include "desk/view/session_head.hpp"
#include "desk/view/session_screens.hpp"
#include "desk/viewer/shown_guides.hpp"
#include "session/options/edge_comfort.hpp"
#include "session/state/session_command.hpp"
#include "session/state/session_state.hpp"
#include "wall/output_settings.hpp"

namespace burin::session {

struct Viewer {
    DeskState desk;  // mouse and keys
    SessionHead head;
    WandState wands;
    double interpupillary_m = 0.063;
    wall::OutputSettings output;  // of the main screen (output_on(), session_screens.hpp)
    EdgeComfort edge_comfort = EdgeComfort::automatic;
    bool force_shown = false;      // as an arrow
    scene::ObjectId selected = 0;  // on the panel; 0: the first
    bool panel = true, help = false, figures = false, devices = false;
    bool first_steps = false;         // the card for who sees this for the first time
    SeenFrom seen_from;               // as of the last step
    std::optional<Action> over_cube;  // the view whose face is under the cursor (view_cube.hpp)
    bool pressed_cube = false;        // the left button went down on it
    bool wants_full_screen_exchanged = false;
};

// Where the viewer is, and how mouse and keys lead each hand.
struct DeskRoom {
    SessionWall wall;
    std::vector<DeskSettings> hands{1};  // by number; at least one
    MirrorPanes mirror_panes;            // none where nothing is carved
    bool offers_mouse = false;           // the panel has the choice of how it leads
    std::string no_surface;              // why it cannot lead a hand along a surface; empty: it can
    bool first_steps = false;            // are shown at first
    double panel_scale = 1.0;            // of the panel's letters on a desktop
    bool frames_world = false;           // DeskOptions::frames_world
    double free_width = 1.0;             // of the main screen's picture, that the panel leaves free at its left

    [[nodiscard]] wall::Screen screen() const { return wall::screen_world(wall.setup, wall.setup.screens[wall.main]); }
};

// A session and its viewer, for functions that only look; all must outlive it.
struct ViewedSession {
    const SessionState& state;
    const Room& room;
    const Viewer& viewer;
    const DeskRoom& desk;

    // Returns what the viewer's head sees of a screen.
    [[nodiscard]] View view_of(std::size_t screen) const {
        return burin::session::view_of(desk.wall.setup, screen, viewer.head, viewer.interpupillary_m);
    }
    [[nodiscard]] wall::OutputSettings output_on(std::size_t screen) const {
        return burin::session::output_on(desk.wall, screen, viewer.output);
    }
};

// Returns the viewer at the start, and where the workpiece then stands before it: with its front about in the screen's
// own plane, where eyes rest best. held: the first hand's handle; null: none.
[[nodiscard]] Viewer begin_viewer(const DeskRoom& desk, const wall::OutputSettings& output);
[[nodiscard]] Similarity placed_before(const Viewer& viewer, const Room& room, const DeskRoom& desk,
                                       const HeldHandle* held);
// Has mouse and keys begin where the session's hand in use rests.
void take_hand(Viewer& viewer, const SessionState& state);

// Returns from where the scene is seen. With a handle what is fitted into the picture is at least a share of its
// workspace: in a small world the resting handle would be right before the viewer's nose.
[[nodiscard]] SeenFrom seen_from(const ViewedSession& seen);

// Returns a number that the viewer keeps, or the session.
[[nodiscard]] double value_of(const SessionState& state, const Viewer& viewer, Quantity quantity);

}  // namespace burin::session

// SPDX-License-Identifier: MIT
// What a session is in before its first step: what can be touched, and the hands that reach it. Plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/space.hpp"
#include "haptics/tool_action.hpp"
#include "session/held/pen_at_rest.hpp"
#include "session/held/placed_hand.hpp"
#include "session/input/actions.hpp"

namespace burin::session {

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
    std::optional<PlacedHand> placed;  // by an activity; none: over what can be touched
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

}  // namespace burin::session

// SPDX-License-Identifier: MIT
// Workspace techniques: how the motion of a device of centimetres becomes motion in a scene of metres.
//
// Techniques (settings.technique), one pure step function each, behind one interface:
//   fixed      the mapping of the settings, always
//   moving     the PowerWall paper's algorithm, below
//   scaling    amplified motion: the whole workspace covers the scene by one gain
//   clutching  as with a mouse: while the button is held the scene's tool stays and the hand returns; after release the
//              tool follows the hand again
//   bubble     position control inside a ball, rate control beyond it, with an elastic force at its surface (Dominjon
//              2005: V = k (|d| - R)^3 d/|d|, F = -s (|d| - R) d/|d|, d the hand from the workspace's middle)
//   drift      drift control (Conti and Khatib 2005): while the hand moves, the mapping drifts outwards under it, too
//              slowly to be seen, so that the hand comes back towards the middle: speed = drift_ratio * hand speed *
//              distance from the middle, the latter in half extents of the workspace and at most 1
//
// The moving algorithm. The paper (4.1, its Figure 6) says that on a press modelling pauses and a transparent box
// appears, centred on the tool; that on release the workspace sits where the box is; and that repeated presses jump in
// the direction in which the tool moved. All three follow from one rule: on release the workspace's middle moves to the
// tool. The stylus does not move with it and stays at the border where it was, so the tool is at the same border of the
// moved workspace: one offset farther on (jumped). Pressed again without moving the hand, the workspace goes on by the
// same offset in the tool's direction, by up to half the workspace's diagonal a press; nearer to the middle the jumps
// are shorter. While the button is held the tool and its box are dragged: the workspace follows the tool at drag_rate
// times the tool's offset a second, which is the same jump in many small parts; a hand at the border could not pull
// farther by position control. It ends like any press. During a drag the hand steers, and stops the workspace by moving
// to the middle.
//
//     phase     | what happens                      | next      | the mapping
//     editing   | the button goes down              | paused    | stays
//     paused    | it comes up before tap_s          | jumping   | jumps: middle to the tool
//     paused    | it has been down for tap_s        | dragging  | stays
//     dragging  | it is held                        | dragging  | moves: at most max_speed
//     dragging  | it comes up                       | jumping   | jumps: middle to the tool
//     jumping   | the button goes down              | paused    | stays
//     jumping   | series_s pass without a press     | editing   | stays
//
// Nothing is touched or carved except in editing. A button that is down when a technique begins has to come up first.
//
// Data flow: device sample -> step -> object_from_device for this tick, a force of the technique's own, and a picture
// for the frame.
// Frames: device and object. Pure; state in a struct; no clock, heap, lock or throw; a few dozen operations. The
// mapping is continuous except where WorkspaceStep::jumped is set: then contact starts afresh, and the gate fades the
// force in.
// Energy: a mapping that moves pushes the tool into what it touches without work of the hand. So in contact it moves at
// most at max_speed_in_contact (0: not at all), and afterwards speeds up from rest by at most max_acceleration.
// A piece that another hand or the mouse moves is no motion of the mapping in this sense: it is a body that moves, and
// the work that it does on the hand is accounted for (WorkspaceStep::piece, piece_motion.hpp).
// Output is finite for all finite input; device coordinates beyond 10 m are clamped to it.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "haptics/workspace/piece_motion.hpp"
#include "haptics/workspace/workspace_picture.hpp"
#include "haptics/workspace/workspace_settings.hpp"

namespace burin::haptics {

struct WorkspaceInput {
    Vec3 position_device_m{0.0};
    Vec3 velocity_device_m_per_s{0.0};
    std::uint32_t buttons = 0;
    bool in_contact = false;  // in the last tick
    double dt_s = 0.0;
};

struct WorkspaceState {
    bool begun = false;  // false: the next step starts from the settings
    // Settings of the last step; a change restarts the technique, unless it is a motion of the piece.
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;
    Similarity settings_map;
    double scaling_gain = 1.0;
    std::uint64_t placed = 0;
    FollowedPiece piece;  // the settings' mapping, as far as this tick has it
    Similarity object_from_device;
    WorkspacePhase phase = WorkspacePhase::editing;
    double phase_s = 0.0;  // duration of the phase so far
    bool pressed = false;
    Vec3 anchor_object_m{0.0};       // clutching: the tool's position when the button went down
    Vec3 glide_device_m_per_s{0.0};  // velocity of the mapping: drag, bubble, drift
    std::uint32_t presses = 0;       // since the start
};

struct WorkspaceStep {
    WorkspaceState next;
    Similarity object_from_device;
    PieceMotion piece;         // of the piece under the device, while it is followed
    Vec3 force_device_N{0.0};  // of the technique itself: the bubble's elastic surface
    bool paused = false;       // modelling pauses: nothing is touched or carved
    bool jumped = false;       // the mapping is not continuous with that of the last step
    WorkspacePicture picture;
};

// Advances the technique by one tick.
[[nodiscard]] WorkspaceStep step_workspace(const WorkspaceState& state, const WorkspaceSettings& settings,
                                           const WorkspaceInput& input) noexcept;

// Checks the settings: nothing beyond 1e9 or negative, a unit rotation (to 1e-6), gains above 0, a drift slower than
// the hand.
[[nodiscard]] bool settings_are_sensible(const WorkspaceSettings& settings) noexcept;

}  // namespace burin::haptics

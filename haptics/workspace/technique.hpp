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

namespace burin::haptics {

enum class WorkspaceTechnique : std::uint8_t { fixed, moving, scaling, clutching, bubble, drift };

[[nodiscard]] const char* text(WorkspaceTechnique technique) noexcept;

struct WorkspaceSettings {
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;
    Similarity object_from_device;  // at rest, and at the start of each technique; its scale is the gain
    Vec3 workspace_device_m{0.1626, 0.1219, 0.0711};  // the box centred on the device's origin
    // Region that the tool should be able to reach; empty: unbounded. The workspace never leaves it (except with
    // `fixed`); along an axis where the workspace is longer than the region it is centred.
    Box reach_object;
    std::uint32_t button_mask = 2;  // which button moves the workspace: bit 1, the stylus' second one
    // Moving: a press released sooner is a jump; held longer it drags.
    double tap_s = 0.3;
    double series_s = 0.4;  // moving: a press within this time of the last belongs to its series
    // Moving: speed of a drag divided by the tool's distance from the middle.
    double drag_rate_per_s = 5.0;
    double scaling_gain = 1.0;  // scaling: multiplies object_from_device.scale
    // Bubble, in the device frame. The ball must leave room for rate control along the workspace's shortest side.
    double bubble_radius_m = 0.025;
    double bubble_stiffness_N_per_m = 100.0;
    double bubble_rate_per_m2s = 1e5;  // k: 10 mm beyond the ball are 0.1 m/s
    // Drift: drift speed over hand speed at the edge of the workspace; less inside.
    double drift_ratio = 0.15;
    // Greatest speeds of a mapping without a jump, in device metres; times the gain in object metres.
    double max_speed_m_per_s = 1.0;
    double max_speed_in_contact_m_per_s = 0.0;
    double max_acceleration_m_per_s2 = 4.0;  // only when speeding up; slowing down is immediate
    // How often the mapping has been set otherwise than by a motion of the piece. While it stays the same the tick
    // follows the mapping as that of a body; 0: never, each change starts the technique and the contact afresh.
    std::uint64_t placed = 0;
};

enum class WorkspacePhase : std::uint8_t {
    editing,   // the tool works
    paused,    // the button is down: the box shows where the workspace will be
    dragging,  // the workspace follows the tool
    jumping,   // between presses of a series
    clutched,  // the scene's tool stays, the hand returns
    gliding,   // rate control beyond the bubble
};

[[nodiscard]] const char* text(WorkspacePhase phase) noexcept;

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

// What the frame draws of the workspace, in the object frame.
struct WorkspacePicture {
    WorkspacePhase phase = WorkspacePhase::editing;
    Similarity object_from_device;  // present location of the device's box
    // The transparent box of the moving algorithm, turned and as large as the device's.
    bool proposed_visible = false;
    Vec3 proposed_center_object_m{0.0};
    double bubble_radius_object_m = 0.0;  // around the box's middle; 0: none
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

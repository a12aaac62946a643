// SPDX-License-Identifier: MIT
// Reaching a wall of metres with a device of centimetres: how device motion becomes motion in the scene.
//
// Techniques (settings.technique), one pure step function for each behind one interface:
//   fixed      the mapping of the settings, always
//   moving     the PowerWall paper's algorithm, below
//   scaling    amplified motion: the whole workspace covers the scene by one gain
//   clutching  as with a mouse: while the button is held the scene's tool stays and the hand returns; on release it goes on
//   bubble     inside a ball position control; beyond it rate control, with an elastic force at its surface (Dominjon 2005:
//              V = k (|d| - R)^3 d/|d|, F = -s (|d| - R) d/|d|, d the hand from the workspace's middle)
//   drift      drift control (Conti and Khatib 2005): while the hand moves, the mapping drifts outwards under it, too
//              slowly to be seen, so that the hand comes back towards the middle: speed = drift_ratio * hand speed *
//              distance from the middle, the latter in half extents of the workspace and at most 1
//
// The moving algorithm. The paper (4.1, its Figure 6) says that on a press modelling pauses and a transparent box appears,
// centred on the tool; that on release the workspace sits where the box is; and that repeated presses jump in the
// direction in which the tool moved. All three follow from one rule: on release the workspace's middle comes to where
// the tool is. The stylus is a thing of the desk and stays at the border where it was, so that the tool is at the same
// border of the workspace that has moved: one offset farther on (jumped). Pressed again without moving the hand it goes
// on by the same offset, that is in the tool's direction, by up to half the workspace's diagonal a press; nearer to the
// middle the jumps are shorter. Held, the tool and its box are dragged: the workspace goes after the tool by drag_rate times the tool's offset a second,
// which is the same jump in many small parts; a hand at its border could not pull farther by position. It ends like
// any press. While it is dragged the hand steers, and stops it by going to the middle.
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
// In all but editing nothing is touched or carved. A button that is down when a technique begins has to come up first.
//
// Data flow: device sample -> step -> object_from_device for this tick, a force of the technique's own, and a picture for the frame.
// Frames: device and object. Pure; state in a struct; no clock, heap, lock or throw; a few dozen operations. The mapping moves continuously but where
// WorkspaceStep::jumped says that it has jumped: then contact starts afresh, and the gate fades the force in.
// Energy: a mapping that moves pushes the tool into what it touches without the hand's doing. So in contact it moves at
// most at max_speed_in_contact (0: it stands), and starts from rest by at most max_acceleration afterwards.
// Finite for all finite input; a hand farther than 10 m from the device is taken to be there.
#pragma once

#include <cstdint>

#include "base/space.hpp"

namespace burin {

enum class WorkspaceTechnique : std::uint8_t { fixed, moving, scaling, clutching, bubble, drift };

[[nodiscard]] const char* text(WorkspaceTechnique technique) noexcept;

struct WorkspaceSettings {
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;
    Similarity object_from_device;                    // at rest, and where each technique begins; its scale is the gain
    Vec3 workspace_device_m{0.1626, 0.1219, 0.0711};  // the box centred on the device's origin
    // Where the tool shall be able to go; empty: anywhere. The workspace never leaves it (but for `fixed`); along an
    // axis where it is longer than that it lies centred.
    Box reach_object;
    std::uint32_t button_mask = 2;  // which button moves the workspace: bit 1, the stylus' second one
    double tap_s = 0.3;             // moving: released sooner it was a press for a jump, held longer it drags
    double series_s = 0.4;          // moving: a press within this time of the last belongs to its series
    double drag_rate_per_s = 5.0;   // moving: speed of a drag over the tool's distance from the middle
    double scaling_gain = 1.0;      // scaling: on top of object_from_device.scale
    // Bubble, in the device frame. The ball has to leave some of the workspace's flattest side for rate control.
    double bubble_radius_m = 0.025;
    double bubble_stiffness_N_per_m = 100.0;
    double bubble_rate_per_m2s = 1e5;  // k: 10 mm beyond the ball are 0.1 m/s
    double drift_ratio = 0.15;         // drift: drift speed over hand speed, at the edge of the workspace; less inside
    // How fast a mapping may move without a jump, in device metres; times the gain it is in the object's.
    double max_speed_m_per_s = 1.0;
    double max_speed_in_contact_m_per_s = 0.0;
    double max_acceleration_m_per_s2 = 4.0;  // of a mapping that speeds up; it may slow down at once
};

enum class WorkspacePhase : std::uint8_t {
    editing,   // the tool works
    paused,    // the button is down: the box shows where the workspace will be
    dragging,  // the workspace goes after the tool
    jumping,   // between presses of a series
    clutched,  // the scene's tool stays, the hand returns
    gliding,   // rate control beyond the bubble
};

[[nodiscard]] const char* text(WorkspacePhase phase) noexcept;

struct WorkspaceInput {
    Vec3 position_device_m{0.0};
    Vec3 velocity_device_m_per_s{0.0};
    std::uint32_t buttons = 0;
    bool in_contact = false;  // in the tick before
    double dt_s = 0.0;
};

struct WorkspaceState {
    bool begun = false;  // false: the next step starts from the settings
    // Of the step before; a change of any of the three starts anew.
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;
    Similarity settings_map;
    double scaling_gain = 1.0;
    Similarity object_from_device;
    WorkspacePhase phase = WorkspacePhase::editing;
    double phase_s = 0.0;  // how long it has lasted
    bool pressed = false;
    Vec3 anchor_object_m{0.0};       // clutching: where the tool was when the button went down
    Vec3 glide_device_m_per_s{0.0};  // how fast the mapping moves: drag, bubble, drift
    std::uint32_t presses = 0;       // since the start
};

// For the frame: what to draw of it, in the object frame.
struct WorkspacePicture {
    WorkspacePhase phase = WorkspacePhase::editing;
    Similarity object_from_device;  // the device's box, as it is now
    bool proposed_visible =
        false;  // the transparent box of the moving algorithm: as turned and as large as the device's
    Vec3 proposed_center_object_m{0.0};
    double bubble_radius_object_m = 0.0;  // around the box's middle; 0: none
};

struct WorkspaceStep {
    WorkspaceState next;
    Similarity object_from_device;
    Vec3 force_device_N{0.0};  // of the technique itself: the bubble's elastic surface
    bool paused = false;       // modelling pauses: nothing is touched and nothing is cut
    bool jumped = false;       // the mapping is not continuous with the one before
    WorkspacePicture picture;
};

[[nodiscard]] WorkspaceStep step_workspace(const WorkspaceState& state, const WorkspaceSettings& settings,
                                           const WorkspaceInput& input) noexcept;

// Nothing beyond 1e9 or negative, a unit rotation (to 1e-6), gains above 0, a drift below the hand's own motion.
[[nodiscard]] bool settings_are_sensible(const WorkspaceSettings& settings) noexcept;

}  // namespace burin

// SPDX-License-Identifier: MIT
// Reaching a wall of metres with a device of centimetres: how device motion becomes motion in the scene.
//
// Techniques (settings.technique), one pure step function for each behind one interface:
//   fixed      the mapping of the settings, always
//   moving     the PowerWall paper's algorithm: the tool moves inside the haptic workspace's box. Press the button: modelling
//              pauses, and a transparent box appears, centred on the tool. Release: the workspace sits where the box is. Press and release repeatedly: it jumps
//              in the tool's direction of motion. Hold: it is dragged. Stop pressing: it stays and editing resumes.
//   scaling    amplified motion: the whole workspace covers the scene by one gain
//   clutching  as with a mouse: while the button is held the scene's tool stays and the hand returns; on release it goes on
//   bubble     inside a ball position control; beyond it rate control, with an elastic force at its surface (Dominjon 2005:
//              V = k (|d| - R)^3 d/|d|, F = -s (|d| - R) d/|d|)
//   drift      drift control (Conti and Khatib 2005): while the hand moves, the mapping drifts so that the hand comes back
//              towards the middle, too slowly to be seen
//
// Data flow: device sample -> step -> object_from_device for this tick, a force of the technique's own, and a picture for the frame.
// Frames: device and object. Pure; state in a struct; no clock, heap, lock or throw. The mapping moves continuously but where
// WorkspaceStep::jumped says that it has jumped: then contact starts afresh, and the gate fades the force in.
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
    Box reach_object;  // where the tool shall be able to go; empty: anywhere. The workspace never leaves it
    std::uint32_t button_mask = 2;  // which button moves the workspace: bit 1, the stylus' second one
    double tap_s = 0.3;             // moving: released sooner it was a press for a jump, held longer it drags
    double jump_ratio = 0.8;        // moving: a jump is so much of the workspace's extent in that direction
    double scaling_gain = 1.0;      // scaling: on top of object_from_device.scale
    double bubble_radius_m = 0.03;  // bubble: device frame
    double bubble_stiffness_N_per_m = 100.0;
    double bubble_rate_per_m2s =
        1e5;                    // bubble: k of V = k (|d| - R)^3, in device metres; V times the gain is object speed
    double drift_ratio = 0.15;  // drift: drift speed over hand speed, at the edge of the workspace; less inside
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
    bool in_contact = false;  // in the tick before
    double dt_s = 0.0;
};

struct WorkspaceState {
    bool begun = false;                                        // false: the next step starts from the settings
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;  // of the step before
    Similarity settings_map;  // of the step before; a change of the settings starts anew
    Similarity object_from_device;
    WorkspacePhase phase = WorkspacePhase::editing;
    bool pressed = false;
    double held_s = 0.0;          // since the button went down, or up
    Vec3 travel_object_m{0.0};    // the tool's recent direction of motion, not normalised
    Vec3 anchor_object_m{0.0};    // where the tool was when the button went down
    Vec3 position_device_m{0.0};  // of the step before
    std::uint32_t presses = 0;    // since the start
};

// For the frame: what to draw of it, in the object frame.
struct WorkspacePicture {
    WorkspacePhase phase = WorkspacePhase::editing;
    Similarity object_from_device;  // the device's box, as it is now
    bool proposed_visible = false;  // the transparent box of the moving algorithm
    Vec3 proposed_center_object_m{0.0};
    double bubble_radius_object_m = 0.0;  // 0: none
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

// Finite, positive where they must be.
[[nodiscard]] bool settings_are_sensible(const WorkspaceSettings& settings) noexcept;

}  // namespace burin

// SPDX-License-Identifier: MIT
// The simulated head and stylus of a desk: what keys and mouse mean, as one pure step function of (state, events, dt).
//
// Stylus: mouse motion moves the hand's target relatively, like a mouse its arrow: what leads out of the workspace is lost, so
// the way back has no dead travel. How far a pixel leads is the caller's to say (DeskView::device_m_per_px), so that the tool's
// picture can move as far as the arrow. Left and right button are the stylus' buttons 0 and 1; a click between two frames is held
// for one step, so that it is not lost.
// Head: flies with bounded speed, softly started and stopped, within a box before the screen.
// Scene: turned, moved and scaled about a pivot; the caller applies scene_change from the left to world_from_scene.
// What the panel has captured (its fields have the keyboard, the mouse is over it) presses nothing here, but releases.
// Frames and units: device frame in metres for the target, world frame for head and scene, pixels y down for the mouse.
#pragma once

#include <bitset>
#include <optional>
#include <span>
#include <vector>

#include "app/session/desk_input_table.hpp"
#include "app/session/input_event.hpp"
#include "base/space.hpp"
#include "devices/simulated_hand.hpp"

namespace burin {

// All lengths positive.
struct DeskSettings {
    Pose home_head_world{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};
    Box head_world{};  // where the head may fly, home inside; empty: anywhere. Keep it before the screen.
    Vec3 workspace_m{0.1626, 0.1219, 0.0711};
    double depth_per_wheel_step_m = 0.002;
    double turn_rad_per_px = 0.005;
    double scale_per_wheel_step = 1.1;
    double least_scale = 0.01, most_scale = 100.0;
    double flight_speed_m_per_s = 0.6;
    double flight_lag_s = 0.1;  // of the speed behind the keys
};

// What the step must know of the rest of the session.
struct DeskView {
    double device_m_per_px = 0.00025;             // how far a pixel of mouse motion moves the stylus
    double world_m_per_px = 0.001;                // how far it moves the scene when panning
    Vec2 picture_px_per_px{1.0};                  // the mouse's pixels, where an eye's picture is squeezed
    Quat device_from_screen{1.0, 0.0, 0.0, 0.0};  // the screen's right, up and towards the viewer, in the device frame
    Quat world_from_screen{1.0, 0.0, 0.0, 0.0};
    Vec3 pivot_world{0.0};     // what turning and scaling keep in place
    double scene_scale = 1.0;  // of world_from_scene now, for the limits
    bool keyboard_captured = false, mouse_captured = false;
};

struct DeskState {
    Vec3 target_device_m{0.0};
    Pose head_world;
    Vec3 flight_m_per_s{0.0};
    std::optional<Vec2> mouse_px;  // nothing: the next place only says where the mouse is
    std::bitset<kKeyCount> keys;   // held, and not pressed into the panel
    Modifiers modifiers;
    std::uint32_t buttons = 0;    // of the stylus
    std::optional<Gesture> drag;  // with the middle button, as it began
};

[[nodiscard]] DeskState desk_at_home(const DeskSettings& settings);

struct DeskStep {
    DeskState state;
    HandTarget target;  // velocity not given; orientation as the hand rests
    Pose head_world;
    Similarity scene_change;      // world_from_scene becomes scene_change * world_from_scene
    std::vector<Action> actions;  // in their order; reset_view is among them, and resets the head here
};

// dt_s: since the step before, not negative.
[[nodiscard]] DeskStep step_desk(DeskState state, std::span<const InputEvent> events, double dt_s, const DeskView& view,
                                 const DeskSettings& settings = {});

// How far a pixel's worth of screen is at the tool's depth, seen from between the eyes, in the device frame: with this the tool's
// picture moves as far as the mouse. The distances are along the screen's normal from the eye, positive.
[[nodiscard]] double device_m_per_px(double screen_m_per_px, double eye_to_screen_m, double eye_to_tool_m,
                                     double world_per_device);

}  // namespace burin

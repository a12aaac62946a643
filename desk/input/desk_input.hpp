// SPDX-License-Identifier: MIT
// Simulated head and stylus of a desktop session: interprets keys and mouse in one pure step function of (state,
// events, dt).
//
// Stylus: mouse motion moves the hand's target relatively, as it moves a pointer, or keeps it under the pointer
// (DeskView::cursor). Motion beyond the workspace is
// discarded, so that the way back has no dead travel. The caller sets how far a pixel moves the target
// (DeskView::device_m_per_px), so that the tool's picture can move as far as the pointer. Left and right button are the
// stylus' buttons 0 and 1; a click between two frames is held for one step, so that it is not lost. Dragged with the
// middle button and Ctrl, the stylus turns about its tip instead.
// Head: flies with bounded speed, with soft start and stop, within a box before the screen.
// Scene: is turned, moved and scaled about a pivot; the caller applies scene_change from the left to world_from_scene.
//
// On a surface (DeskView::surface) the tool is where the cursor is instead (surface_hand.hpp): the left button works
// there, and beside the workpiece it turns the scene, as the right one does; keys do not fly the head. The scene is not
// turned while the tool works, and the tool stays where it is while the scene is turned.
//
// What the panel has captured (its fields have the keyboard, or the mouse is over it) cannot be pressed here, but
// releases count.
// Frames and units: device frame in metres for the target, world frame for head and scene, pixels with y down for the
// mouse.
#pragma once

#include <bitset>
#include <optional>
#include <span>
#include <vector>

#include "base/space.hpp"
#include "desk/input/desk_input_table.hpp"
#include "desk/input/surface_hand.hpp"
#include "devices/hand/steered_hand.hpp"
#include "session/held/held_tool.hpp"
#include "session/held/pen_at_rest.hpp"
#include "session/input/input_event.hpp"

namespace burin::session {

// Settings of the desktop input. All lengths are positive.
struct DeskSettings {
    Pose home_head_world{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};
    // Where the head may fly; contains home; empty: anywhere. Keep it before the screen.
    Box head_world{};
    Vec3 workspace_m{0.1626, 0.1219, 0.0711};
    double depth_per_wheel_step_m = 0.002;
    double turn_rad_per_px = 0.005;  // of the scene, and of the stylus
    // The resting hand: a pen's shaft, +Y of the tool, leans to the right, up and to the viewer.
    Quat rest_device = pen_at_rest();
    // Ctrl and Shift lean the handle to the side, about the screen's normal, and do not turn it about its shaft: of a
    // wand that shows nothing and moves no end.
    bool leans_sideways = false;
    double scale_per_wheel_step = 1.1;
    double least_scale = 0.01, most_scale = 100.0;
    double flight_speed_m_per_s = 0.6;
    double flight_lag_s = 0.1;  // time constant of the speed behind the keys
};

// What a step must know where the tool follows a surface. seen must outlive the step.
struct DeskSurface {
    const SeenSurface* seen = nullptr;
    CursorView cursor;
    ToolOnSurface tool;  // with the whole half width as depth
    Similarity object_from_device;
    Quat object_from_screen{1.0, 0.0, 0.0, 0.0};
    Vec3 middle_object{0.0};  // of the workpiece
    Similarity world_from_object;
};

// What a step must know of the rest of the session.
struct DeskView {
    double device_m_per_px = 0.00025;  // how far a pixel of mouse motion moves the stylus
    double world_m_per_px = 0.001;     // how far a pixel of mouse motion pans the scene
    // Scale from mouse pixels to pixels of an eye's picture, where that is squeezed.
    Vec2 picture_px_per_px{1.0};
    // The screen's right, up and out (towards the viewer), in the device frame.
    Quat device_from_screen{1.0, 0.0, 0.0, 0.0};
    Quat world_from_screen{1.0, 0.0, 0.0, 0.0};
    Vec3 pivot_world{0.0};     // fixed point of turning and scaling
    double scene_scale = 1.0;  // of world_from_scene now; for the limits
    bool keyboard_captured = false, mouse_captured = false;
    std::optional<DeskSurface> surface;  // none: free flight
    // From where the cursor is seen, with the frame of the device for that of the object: in free flight the target is
    // kept under the cursor, as deep before the screen as it is. None: it moves as far as the mouse.
    std::optional<CursorView> cursor;
};

struct DeskState {
    Vec3 target_device_m{0.0};
    Quat target_turn_device{1.0, 0.0, 0.0, 0.0};  // from the resting hand's orientation, applied after it
    Pose head_world;
    Vec3 flight_m_per_s{0.0};
    std::optional<Vec2> mouse_px;  // none: the next motion only sets it
    std::bitset<kKeyCount> keys;   // held keys, without those pressed into the panel
    Modifiers modifiers;
    std::uint32_t buttons = 0;    // of the stylus, one bit each
    std::optional<Gesture> drag;  // of the middle button, or another that turns the scene; chosen when it went down
    MouseButton dragged_by = MouseButton::middle;
    double dragged_px = 0.0;  // how far, since then
    SurfaceHand on_surface;
    double strength = 0.3;
    double roll_rad = 0.0;                // of the tool about its axis, on a surface
    Quat led_device{1.0, 0.0, 0.0, 0.0};  // the tool's orientation there
    bool in_work = false;                 // the tool was told to work where it is
    bool works = true;                    // false: what hides the stroke bears the tool, and its button does nothing
    bool in_air = false;                  // the cursor has left the surface within a stroke
    bool beyond_reach = false;            // the cursor is, in the air: the tool does not get there
};

[[nodiscard]] DeskState desk_at_home(const DeskSettings& settings);

struct DeskStep {
    DeskState state;
    // Where the mouse led the hand: a target for each of its events, and for each that changes buttons.
    std::vector<devices::SteeredTarget> way;
    devices::HandTarget target;  // at the end; without a velocity
    Pose head_world;
    Similarity scene_change;      // world_from_scene becomes scene_change * world_from_scene
    std::vector<Action> actions;  // in order; reset_view is among them and also resets head and stylus' turn here
    bool missed = false;          // a click beside the workpiece
    // The gestures with which strokes on the surface began, in order.
    std::vector<Gesture> strokes;
};

// Applies one step's events. dt_s: time since the step before, not negative.
[[nodiscard]] DeskStep step_desk(DeskState state, std::span<const InputEvent> events, double dt_s, const DeskView& view,
                                 const DeskSettings& settings = {});

// Returns how far a pixel on the screen reaches at the tool's depth, seen from between the eyes, in the device frame:
// with this the tool's picture moves as far as the mouse. The distances are from the eye along the screen's normal,
// positive.
[[nodiscard]] double device_m_per_px(double screen_m_per_px, double eye_to_screen_m, double eye_to_tool_m,
                                     double world_per_device);

}  // namespace burin::session

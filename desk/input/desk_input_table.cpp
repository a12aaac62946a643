// SPDX-License-Identifier: MIT
#include "desk/input/desk_input_table.hpp"

#include <array>

#include "session/input/input_keys.hpp"

namespace burin::session {
namespace {

constexpr Modifiers kNone{};
constexpr Modifiers kShift{.shift = true};
constexpr Modifiers kCtrl{.ctrl = true};
constexpr Modifiers kCtrlShift{.shift = true, .ctrl = true};

constexpr std::array kShortCuts = {
    ShortCut{Key::z, kCtrl, Action::undo, true},
    ShortCut{Key::z, kCtrlShift, Action::redo, true},
    ShortCut{Key::y, kCtrl, Action::redo, true},
    ShortCut{Key::digit_1, kNone, Action::tool_1, false},
    ShortCut{Key::digit_2, kNone, Action::tool_2, false},
    ShortCut{Key::digit_3, kNone, Action::tool_3, false},
    ShortCut{Key::digit_4, kNone, Action::tool_4, false},
    ShortCut{Key::digit_5, kNone, Action::tool_5, false},
    ShortCut{Key::left_bracket, kNone, Action::smaller_radius, true},
    ShortCut{Key::right_bracket, kNone, Action::larger_radius, true},
    ShortCut{Key::m, kNone, Action::next_stereo_mode, false},
    ShortCut{Key::m, kShift, Action::swap_eyes, false},
    ShortCut{Key::t, kNone, Action::next_workspace_technique, false},
    ShortCut{Key::h, kNone, Action::next_hand, false},
    ShortCut{Key::home, kNone, Action::reset_view, false},
    ShortCut{Key::f, kNone, Action::fit_view, false, MouseMode::surface},
    ShortCut{Key::f, kNone, Action::fit_object, false, MouseMode::free},
    ShortCut{Key::digit_1, kCtrl, Action::view_front, false, MouseMode::surface},
    ShortCut{Key::keypad_1, kNone, Action::view_front, false, MouseMode::surface},
    ShortCut{Key::digit_2, kCtrl, Action::view_side, false, MouseMode::surface},
    ShortCut{Key::keypad_3, kNone, Action::view_side, false, MouseMode::surface},
    ShortCut{Key::digit_3, kCtrl, Action::view_top, false, MouseMode::surface},
    ShortCut{Key::keypad_7, kNone, Action::view_top, false, MouseMode::surface},
    ShortCut{Key::digit_1, kCtrlShift, Action::view_back, false, MouseMode::surface},
    ShortCut{Key::digit_2, kCtrlShift, Action::view_left, false, MouseMode::surface},
    ShortCut{Key::digit_3, kCtrlShift, Action::view_bottom, false, MouseMode::surface},
    ShortCut{Key::left, kNone, Action::turn_left, true, MouseMode::surface},
    ShortCut{Key::right, kNone, Action::turn_right, true, MouseMode::surface},
    ShortCut{Key::up, kNone, Action::turn_up, true, MouseMode::surface},
    ShortCut{Key::down, kNone, Action::turn_down, true, MouseMode::surface},
    ShortCut{Key::comma, kNone, Action::roll_left, true, MouseMode::surface},
    ShortCut{Key::period, kNone, Action::roll_right, true, MouseMode::surface},
    ShortCut{Key::escape, kNone, Action::put_away, false},
    ShortCut{Key::tab, kNone, Action::toggle_panel, false},
    ShortCut{Key::f1, kNone, Action::toggle_help, false},
    ShortCut{Key::f2, kNone, Action::toggle_frame_figures, false},
    ShortCut{Key::f3, kNone, Action::toggle_devices, false},
    ShortCut{Key::f11, kNone, Action::toggle_full_screen, false},
    ShortCut{Key::f12, kNone, Action::take_screenshot, false},
    ShortCut{Key::e, kCtrl, Action::export_mesh, false},
    ShortCut{Key::s, kCtrl, Action::save_session, false},
    ShortCut{Key::s, kCtrlShift, Action::save_as, false},
    ShortCut{Key::q, kCtrl, Action::quit, false},
};

constexpr std::array kFlightKeys = {
    FlightKey{Key::w, Flight::forwards, "Move closer"},
    FlightKey{Key::s, Flight::backwards, "Move away"},
    FlightKey{Key::a, Flight::left, "Move to the left"},
    FlightKey{Key::d, Flight::right, "Move to the right"},
    FlightKey{Key::left, Flight::left, "Move to the left"},
    FlightKey{Key::right, Flight::right, "Move to the right"},
    FlightKey{Key::up, Flight::up, "Move up"},
    FlightKey{Key::down, Flight::down, "Move down"},
    FlightKey{Key::page_up, Flight::forwards, "Move closer"},
    FlightKey{Key::page_down, Flight::backwards, "Move away"},
};

constexpr std::array kFreeGestures = {
    MouseGesture{MouseUse::move, kNone, Gesture::move_stylus, "Move the stylus along the screen"},
    MouseGesture{MouseUse::move, kShift, Gesture::move_stylus_in_depth, "Move the stylus sideways and in depth"},
    MouseGesture{MouseUse::wheel, kNone, Gesture::stylus_depth, "Move the stylus in depth"},
    MouseGesture{MouseUse::wheel, kShift, Gesture::stylus_depth, "Move the stylus in depth"},
    MouseGesture{MouseUse::wheel, kCtrl, Gesture::scale_scene, "Scale the scene"},
    MouseGesture{MouseUse::left_button, kNone, Gesture::carve, "First button of the stylus: carve"},
    MouseGesture{MouseUse::left_button, kShift, Gesture::carve, "First button of the stylus: carve"},
    MouseGesture{MouseUse::right_button, kNone, Gesture::move_workspace,
                 "Second button of the stylus: move the workspace"},
    MouseGesture{MouseUse::right_button, kShift, Gesture::move_workspace,
                 "Second button of the stylus: move the workspace"},
    MouseGesture{MouseUse::middle_drag, kNone, Gesture::turn_scene, "Turn the scene"},
    MouseGesture{MouseUse::middle_drag, kShift, Gesture::pan_scene, "Move the scene along the screen"},
    MouseGesture{MouseUse::middle_drag, kCtrl, Gesture::turn_stylus, "Turn the stylus about its tip"},
    MouseGesture{MouseUse::middle_drag, kCtrlShift, Gesture::roll_stylus, "Turn the stylus about its shaft"},
};

constexpr std::array kSurfaceGestures = {
    MouseGesture{MouseUse::move, kNone, Gesture::follow_surface, "The tool follows the surface under the cursor"},
    MouseGesture{MouseUse::left_button, kNone, Gesture::work_on_surface,
                 "Work on the surface; beside the workpiece: turn the scene"},
    MouseGesture{MouseUse::left_button, kShift, Gesture::smooth_surface,
                 "Smooth the surface, whatever the tool does else"},
    MouseGesture{MouseUse::right_button, kNone, Gesture::turn_scene, "Drag: turn the scene"},
    MouseGesture{MouseUse::right_button, kShift, Gesture::pan_scene, "Drag: move the scene along the screen"},
    MouseGesture{MouseUse::middle_drag, kNone, Gesture::pan_scene, "Move the scene along the screen"},
    MouseGesture{MouseUse::middle_drag, kShift, Gesture::turn_scene, "Turn the scene"},
    MouseGesture{MouseUse::wheel, kNone, Gesture::zoom_to_cursor,
                 "Zoom to the cursor; with the left button down: deeper or less deep"},
    MouseGesture{MouseUse::wheel, kShift, Gesture::zoom_to_cursor,
                 "Zoom to the cursor; with the left button down: deeper or less deep"},
    MouseGesture{MouseUse::wheel, kCtrl, Gesture::zoom_to_cursor,
                 "Zoom to the cursor; with the left button down: deeper or less deep"},
};

constexpr std::array<std::string_view, 5> kMouseUses = {"Mouse", "Left button", "Right button", "Middle drag", "Wheel"};

std::string key_label(Key key) {
    switch (key) {
        case Key::left_bracket: return "[";
        case Key::right_bracket: return "]";
        default: break;
    }
    std::string label(name_of(key));
    bool starts_word = true;
    for (char& c : label) {
        if (starts_word && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        starts_word = c == '-';
        if (c == '-') c = ' ';
    }
    return label;
}

std::string with_modifiers(const Modifiers& modifiers, const std::string& label) {
    std::string text;
    if (modifiers.ctrl) text += "Ctrl+";
    if (modifiers.alt) text += "Alt+";
    if (modifiers.shift) text += "Shift+";
    if (modifiers.super) text += "Super+";
    return text + label;
}

}  // namespace

std::span<const ShortCut> short_cuts() { return kShortCuts; }
std::span<const FlightKey> flight_keys() { return kFlightKeys; }
std::span<const MouseGesture> mouse_gestures(MouseMode mode) {
    if (mode == MouseMode::surface) return kSurfaceGestures;
    return kFreeGestures;
}

std::string label_of(const ShortCut& s) { return with_modifiers(s.modifiers, key_label(s.key)); }
std::string label_of(const FlightKey& key) { return key_label(key.key); }
std::string label_of(const MouseGesture& g) {
    return with_modifiers(g.modifiers, std::string(kMouseUses.at(static_cast<std::size_t>(g.use))));
}

}  // namespace burin::session

// SPDX-License-Identifier: MIT
// Tables of what keys and the mouse do in a desktop session. The step function looks actions up in them and the panel
// shows them, so that the two cannot differ.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "session/input/actions.hpp"
#include "session/input/input_event.hpp"

namespace burin::session {

// Flight of the head while a key is held, in the head's own directions.
enum class Flight : std::uint8_t { forwards, backwards, left, right, up, down };
// What a mouse gesture does.
enum class Gesture : std::uint8_t {
    // clang-format off
    move_stylus, move_stylus_in_depth, carve, move_workspace, turn_scene, pan_scene, stylus_depth, scale_scene,
    turn_stylus, roll_stylus, follow_surface, work_on_surface, smooth_surface, zoom_to_cursor,
    // clang-format on
};

struct ShortCut {
    Key key;
    Modifiers modifiers;  // exactly these
    Action action;
    bool repeats;                                  // while the key is held
    std::optional<MouseMode> only = std::nullopt;  // while the mouse leads the hand so; none: always
};
struct FlightKey {
    Key key;
    Flight flight;
    std::string_view description;
};
enum class MouseUse : std::uint8_t { move, left_button, right_button, middle_drag, wheel };
struct MouseGesture {
    MouseUse use;
    // Exactly these, of shift and ctrl; a use without an entry for the modifiers held does nothing.
    Modifiers modifiers;
    Gesture gesture;
    std::string_view description;
};

[[nodiscard]] std::span<const ShortCut> short_cuts();
[[nodiscard]] std::span<const FlightKey> flight_keys();
[[nodiscard]] std::span<const MouseGesture> mouse_gestures(MouseMode mode);

// Labels for people: "Ctrl+Shift+Z", "[", "Middle drag".
[[nodiscard]] std::string label_of(const ShortCut& short_cut);
[[nodiscard]] std::string label_of(const FlightKey& key);
[[nodiscard]] std::string label_of(const MouseGesture& gesture);

}  // namespace burin::session

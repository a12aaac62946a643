// SPDX-License-Identifier: MIT
// Input events of a live session as plain data: everything from outside that its pictures depend on. A session that is
// given the same events makes the same frames (session/record/input_log.hpp records and replays them).
//
// Times are nanoseconds since the session's start. Poses are in the world frame, metres (base/space.hpp); pixels count
// from the output's upper left corner, x to the right and y down, as window systems have it. No window system's types
// or numbers appear here: whoever makes the window translates.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "devices/trackers/tracker_input.hpp"
#include "session/input/command_input.hpp"
#include "session/input/key.hpp"

namespace burin::session {

enum class KeyMotion : std::uint8_t { press, release, repeat };
enum class MouseButton : std::uint8_t { left, right, middle, back, forward };

struct KeyInput {
    Key key = Key::space;
    KeyMotion motion = KeyMotion::press;
    Modifiers modifiers;
    friend bool operator==(const KeyInput&, const KeyInput&) = default;
};
struct MouseMove {
    Vec2 position_px{0.0};
    friend bool operator==(const MouseMove&, const MouseMove&) = default;
};
struct MouseClick {
    MouseButton button = MouseButton::left;
    bool pressed = true;
    Modifiers modifiers;
    friend bool operator==(const MouseClick&, const MouseClick&) = default;
};
// Scroll in wheel steps; y > 0 away from the user.
struct Scroll {
    Vec2 steps{0.0};
    Modifiers modifiers;
    friend bool operator==(const Scroll&, const Scroll&) = default;
};
// Typed text for text fields; valid UTF-8.
struct TextInput {
    std::string utf8;
    friend bool operator==(const TextInput&, const TextInput&) = default;
};
// New size of the window; 0 by 0: minimised.
struct WindowResize {
    std::uint32_t width_px = 0, height_px = 0;
    friend bool operator==(const WindowResize&, const WindowResize&) = default;
};
// Change of focus; without focus all keys and buttons count as released.
struct WindowFocus {
    bool gained = true;
    friend bool operator==(const WindowFocus&, const WindowFocus&) = default;
};
struct WindowClose {
    friend bool operator==(const WindowClose&, const WindowClose&) = default;
};
// What trackers report is theirs.
using devices::HeadInput;
using devices::WandClick;
using devices::WandInput;
using devices::WandStick;
// Begins a frame that is expected to be seen at display_ns, the time its poses are predicted to.
struct FrameStart {
    Nanoseconds display_ns = 0;
    friend bool operator==(const FrameStart&, const FrameStart&) = default;
};

using Input = std::variant<KeyInput, MouseMove, MouseClick, Scroll, TextInput, WindowResize, WindowFocus, WindowClose,
                           HeadInput, WandInput, WandClick, WandStick, CommandInput, FrameStart>;

[[nodiscard]] inline Input input_of(devices::TrackerInput reported) {
    return std::visit([](auto&& input) { return Input(std::move(input)); }, std::move(reported));
}

struct InputEvent {
    Nanoseconds time_ns = 0;  // not negative, non-decreasing over events
    Input input;
    std::size_t line = 0;  // of the log that it stands in, for messages; 0: none. No part of what happened
    friend bool operator==(const InputEvent& a, const InputEvent& b) {
        return a.time_ns == b.time_ns && a.input == b.input;
    }
};

// Returns whether an input may be recorded and acted on: finite numbers, quaternions of unit length to 1e-6, valid
// UTF-8 text, names and counts within the bounds of the log. Keeps nonsense of trackers and drivers out.
[[nodiscard]] bool is_sensible(const Input& input);

inline constexpr std::uint32_t kMostWands = 8;
inline constexpr std::uint32_t kMostWandButtons = 32;
inline constexpr std::uint32_t kMostWindow_px = 65536;
inline constexpr double kMostInputNumber = 1e9;      // metres, pixels or steps: far from overflow
inline constexpr std::size_t kMostTextBytes = 1024;  // of a text, a name or an argument
inline constexpr std::size_t kMostCommandArguments = 15;
inline constexpr Nanoseconds kLongestSession_ns = 1'000'000 * kNanosecondsPerSecond;  // 11.6 days

}  // namespace burin::session

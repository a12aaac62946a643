// SPDX-License-Identifier: MIT
// What comes into a live session from outside, as plain data: everything that its pictures depend on. A session that is given
// the same events makes the same frames (app/session/input_log.hpp records and replays them).
//
// Times are nanoseconds since the session's start. Poses are in the world frame, metres (base/space.hpp); pixels count from the
// output's upper left corner, x to the right and y down, as window systems have it. No window system's type or number is in
// here: whoever makes the window translates.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin {

// A key by its place on a US keyboard; input_keys.hpp has the names. The order is that of the names' table.
enum class Key : std::uint8_t {
    // clang-format off
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    digit_0, digit_1, digit_2, digit_3, digit_4, digit_5, digit_6, digit_7, digit_8, digit_9,
    f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12,
    escape, enter, tab, backspace, insert, delete_, left, right, up, down, page_up, page_down, home, end, space,
    apostrophe, comma, minus, period, slash, semicolon, equal, left_bracket, right_bracket, backslash, grave,
    shift, ctrl, alt, super, caps_lock, menu, pause, print_screen,  // left and right alike
    keypad_0, keypad_1, keypad_2, keypad_3, keypad_4, keypad_5, keypad_6, keypad_7, keypad_8, keypad_9,
    keypad_period, keypad_divide, keypad_multiply, keypad_subtract, keypad_add, keypad_enter,
    // clang-format on
};
inline constexpr std::size_t kKeyCount = static_cast<std::size_t>(Key::keypad_enter) + 1;

struct Modifiers {
    bool shift = false, ctrl = false, alt = false, super = false;
    friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

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
struct Scroll {  // in steps of a wheel; y > 0 away from the user
    Vec2 steps{0.0};
    Modifiers modifiers;
    friend bool operator==(const Scroll&, const Scroll&) = default;
};
struct TextInput {  // what was typed, for text fields; valid UTF-8
    std::string utf8;
    friend bool operator==(const TextInput&, const TextInput&) = default;
};
struct WindowResize {  // 0 by 0: minimised
    std::uint32_t width_px = 0, height_px = 0;
    friend bool operator==(const WindowResize&, const WindowResize&) = default;
};
struct WindowFocus {  // without focus all keys and buttons count as released
    bool gained = true;
    friend bool operator==(const WindowFocus&, const WindowFocus&) = default;
};
struct WindowClose {
    friend bool operator==(const WindowClose&, const WindowClose&) = default;
};
struct HeadInput {  // tracked false: the tracker has lost it; the pose is its last
    Pose pose_world;
    bool tracked = true;
};
struct WandInput {
    std::uint32_t wand = 0;
    Pose pose_world;
    bool tracked = true;
};
struct WandClick {
    std::uint32_t wand = 0, button = 0;
    bool pressed = true;
    friend bool operator==(const WandClick&, const WandClick&) = default;
};
struct WandStick {  // -1 to 1 each, x to the right, y forwards
    std::uint32_t wand = 0;
    Vec2 position{0.0};
    friend bool operator==(const WandStick&, const WandStick&) = default;
};
struct CommandInput {  // a named action with arguments: from the panel, or for users with a script
    std::string name;
    std::vector<std::string> arguments;
    friend bool operator==(const CommandInput&, const CommandInput&) = default;
};
struct FrameStart {  // a frame is begun now and expected to be seen at display_ns, which its poses are predicted to
    Nanoseconds display_ns = 0;
    friend bool operator==(const FrameStart&, const FrameStart&) = default;
};

[[nodiscard]] inline bool operator==(const HeadInput& a, const HeadInput& b) {
    return a.pose_world.position_m == b.pose_world.position_m && a.pose_world.orientation == b.pose_world.orientation &&
           a.tracked == b.tracked;
}
[[nodiscard]] inline bool operator==(const WandInput& a, const WandInput& b) {
    return a.wand == b.wand && HeadInput{a.pose_world, a.tracked} == HeadInput{b.pose_world, b.tracked};
}

using Input = std::variant<KeyInput, MouseMove, MouseClick, Scroll, TextInput, WindowResize, WindowFocus, WindowClose,
                           HeadInput, WandInput, WandClick, WandStick, CommandInput, FrameStart>;

struct InputEvent {
    Nanoseconds time_ns = 0;  // not negative, not falling from one event to the next
    Input input;
    friend bool operator==(const InputEvent&, const InputEvent&) = default;
};

// Whether an input may be recorded and acted on: numbers finite, a quaternion of unit length to 1e-6, text valid UTF-8, names
// and counts within the bounds of the log. A tracker's or a driver's nonsense is stopped by this.
[[nodiscard]] bool is_sensible(const Input& input);

inline constexpr std::uint32_t kMostWands = 8;
inline constexpr std::uint32_t kMostWandButtons = 32;
inline constexpr std::uint32_t kMostWindow_px = 65536;
inline constexpr double kMostInputNumber = 1e9;      // metres, pixels or steps: far from overflow
inline constexpr std::size_t kMostTextBytes = 1024;  // of a text, a name or an argument
inline constexpr std::size_t kMostCommandArguments = 15;
inline constexpr Nanoseconds kLongestSession_ns = 1'000'000 * kNanosecondsPerSecond;  // 11.6 days

}  // namespace burin

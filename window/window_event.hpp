// SPDX-License-Identifier: MIT
// Events of a window as plain data: nothing of the window library shows, so that events can be recorded and fed back.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace burin::window {

// The modifier keys held during an event.
struct Modifiers {
    bool shift = false, control = false, alt = false, super = false;
    [[nodiscard]] bool operator==(const Modifiers&) const = default;
};

enum class Press : std::uint8_t { down, repeat, up };

struct KeyEvent {
    // The key's position on the keyboard, named by what a US keyboard has there: "a", "7", "f5", "left", "left_shift",
    // "escape", "keypad_4", "unknown".
    std::string key;
    // The key's label on this keyboard ("z" on a German one for the key "y"); empty for keys without a character.
    std::string label;
    Press press = Press::down;
    Modifiers held;
};

// A character as the user meant it, after layout and dead keys; for text fields.
struct TextEvent {
    char32_t character = 0;
};

// A position in framebuffer pixels from the upper left corner; may lie outside the window while a button is held.
struct MouseMoveEvent {
    double x = 0.0, y = 0.0;
};

struct MouseButtonEvent {
    int button = 0;  // 0 left, 1 right, 2 middle
    bool down = false;
    double x = 0.0, y = 0.0;
    Modifiers held;
};

// Steps of the wheel; positive is away from the user, or to the left.
struct ScrollEvent {
    double x = 0.0, y = 0.0;
};

// The framebuffer's new size in pixels; 0 by 0 while minimised on some systems.
struct ResizeEvent {
    int width = 0, height = 0;
};

struct MoveEvent {  // the window's position on the desktop
    int x = 0, y = 0;
};

struct CloseEvent {};
struct FocusEvent {
    bool focused = false;
};
struct MinimiseEvent {
    bool minimised = false;
};
struct ExposeEvent {};  // the window's contents must be drawn again

struct MonitorEvent {
    std::string monitor;
    bool connected = false;
    bool fell_back_to_window = false;  // this window filled that monitor and is an ordinary window now
};

using WindowEvent = std::variant<KeyEvent, TextEvent, MouseMoveEvent, MouseButtonEvent, ScrollEvent, ResizeEvent,
                                 MoveEvent, CloseEvent, FocusEvent, MinimiseEvent, ExposeEvent, MonitorEvent>;

}  // namespace burin::window

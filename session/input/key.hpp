// SPDX-License-Identifier: MIT
// Keys and modifiers, as no window system numbers them. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>

namespace burin::session {

// A key by its label, a digit by its position (desk/present/key_reader.hpp); input_keys.hpp has the names. The
// order is that of the name table.
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

}  // namespace burin::session

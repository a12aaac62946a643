// SPDX-License-Identifier: MIT
#include "window/key_names.hpp"

#include <algorithm>
#include <array>

#include "window/window_system.hpp"

namespace burin::window {

namespace {

struct Named {
    int key;
    std::string_view name;
};

constexpr std::array kNamed{
    Named{GLFW_KEY_SPACE, "space"},
    Named{GLFW_KEY_APOSTROPHE, "'"},
    Named{GLFW_KEY_COMMA, ","},
    Named{GLFW_KEY_MINUS, "-"},
    Named{GLFW_KEY_PERIOD, "."},
    Named{GLFW_KEY_SLASH, "/"},
    Named{GLFW_KEY_SEMICOLON, ";"},
    Named{GLFW_KEY_EQUAL, "="},
    Named{GLFW_KEY_LEFT_BRACKET, "["},
    Named{GLFW_KEY_BACKSLASH, "\\"},
    Named{GLFW_KEY_RIGHT_BRACKET, "]"},
    Named{GLFW_KEY_GRAVE_ACCENT, "`"},
    Named{GLFW_KEY_WORLD_1, "world_1"},
    Named{GLFW_KEY_WORLD_2, "world_2"},
    Named{GLFW_KEY_ESCAPE, "escape"},
    Named{GLFW_KEY_ENTER, "enter"},
    Named{GLFW_KEY_TAB, "tab"},
    Named{GLFW_KEY_BACKSPACE, "backspace"},
    Named{GLFW_KEY_INSERT, "insert"},
    Named{GLFW_KEY_DELETE, "delete"},
    Named{GLFW_KEY_RIGHT, "right"},
    Named{GLFW_KEY_LEFT, "left"},
    Named{GLFW_KEY_DOWN, "down"},
    Named{GLFW_KEY_UP, "up"},
    Named{GLFW_KEY_PAGE_UP, "page_up"},
    Named{GLFW_KEY_PAGE_DOWN, "page_down"},
    Named{GLFW_KEY_HOME, "home"},
    Named{GLFW_KEY_END, "end"},
    Named{GLFW_KEY_CAPS_LOCK, "caps_lock"},
    Named{GLFW_KEY_SCROLL_LOCK, "scroll_lock"},
    Named{GLFW_KEY_NUM_LOCK, "num_lock"},
    Named{GLFW_KEY_PRINT_SCREEN, "print_screen"},
    Named{GLFW_KEY_PAUSE, "pause"},
    Named{GLFW_KEY_KP_DECIMAL, "keypad_decimal"},
    Named{GLFW_KEY_KP_DIVIDE, "keypad_divide"},
    Named{GLFW_KEY_KP_MULTIPLY, "keypad_multiply"},
    Named{GLFW_KEY_KP_SUBTRACT, "keypad_subtract"},
    Named{GLFW_KEY_KP_ADD, "keypad_add"},
    Named{GLFW_KEY_KP_ENTER, "keypad_enter"},
    Named{GLFW_KEY_KP_EQUAL, "keypad_equal"},
    Named{GLFW_KEY_LEFT_SHIFT, "left_shift"},
    Named{GLFW_KEY_LEFT_CONTROL, "left_control"},
    Named{GLFW_KEY_LEFT_ALT, "left_alt"},
    Named{GLFW_KEY_LEFT_SUPER, "left_super"},
    Named{GLFW_KEY_RIGHT_SHIFT, "right_shift"},
    Named{GLFW_KEY_RIGHT_CONTROL, "right_control"},
    Named{GLFW_KEY_RIGHT_ALT, "right_alt"},
    Named{GLFW_KEY_RIGHT_SUPER, "right_super"},
    Named{GLFW_KEY_MENU, "menu"},
};

constexpr std::string_view kCharacters = "abcdefghijklmnopqrstuvwxyz0123456789";
constexpr std::array<std::string_view, 25> kFunction{"f1",  "f2",  "f3",  "f4",  "f5",  "f6",  "f7",  "f8",  "f9",
                                                     "f10", "f11", "f12", "f13", "f14", "f15", "f16", "f17", "f18",
                                                     "f19", "f20", "f21", "f22", "f23", "f24", "f25"};
constexpr std::array<std::string_view, 10> kKeypad{"keypad_0", "keypad_1", "keypad_2", "keypad_3", "keypad_4",
                                                   "keypad_5", "keypad_6", "keypad_7", "keypad_8", "keypad_9"};

}  // namespace

std::string_view key_name(int key) {
    if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z)
        return kCharacters.substr(static_cast<std::size_t>(key - GLFW_KEY_A), 1);
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) {
        return kCharacters.substr(26 + static_cast<std::size_t>(key - GLFW_KEY_0), 1);
    }
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return kFunction[static_cast<std::size_t>(key - GLFW_KEY_F1)];
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return kKeypad[static_cast<std::size_t>(key - GLFW_KEY_KP_0)];
    const auto found = std::ranges::find(kNamed, key, &Named::key);
    return found != kNamed.end() ? found->name : "unknown";
}

}  // namespace burin::window

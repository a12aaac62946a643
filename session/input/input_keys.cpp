// SPDX-License-Identifier: MIT
#include "session/input/input_keys.hpp"

#include <algorithm>
#include <array>

namespace burin::session {
namespace {

constexpr std::array<std::string_view, kKeyCount> kKeyNames = {
    // clang-format off
    "a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p", "q", "r", "s", "t", "u", "v", "w",
    "x", "y", "z", "0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "f1", "f2", "f3", "f4", "f5", "f6", "f7", "f8",
    "f9", "f10", "f11", "f12", "escape", "enter", "tab", "backspace", "insert", "delete", "left", "right", "up", "down",
    "page-up", "page-down", "home", "end", "space", "apostrophe", "comma", "minus", "period", "slash", "semicolon",
    "equal", "left-bracket", "right-bracket", "backslash", "grave", "shift", "ctrl", "alt", "super", "caps-lock",
    "menu", "pause", "print-screen", "keypad-0", "keypad-1", "keypad-2", "keypad-3", "keypad-4", "keypad-5",
    "keypad-6", "keypad-7", "keypad-8", "keypad-9", "keypad-period", "keypad-divide", "keypad-multiply",
    "keypad-subtract", "keypad-add", "keypad-enter",
    // clang-format on
};
constexpr std::array<std::string_view, 5> kMouseButtonNames = {"left", "right", "middle", "back", "forward"};
static_assert(kKeyNames.back() == "keypad-enter" && kKeyNames[static_cast<std::size_t>(Key::digit_0)] == "0" &&
              kKeyNames[static_cast<std::size_t>(Key::shift)] == "shift");

template <typename Value, std::size_t N>
std::optional<Value> find(const std::array<std::string_view, N>& names, std::string_view name) {
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) return std::nullopt;
    return static_cast<Value>(at - names.begin());
}

}  // namespace

std::string_view name_of(Key key) { return kKeyNames.at(static_cast<std::size_t>(key)); }
std::string_view name_of(MouseButton button) { return kMouseButtonNames.at(static_cast<std::size_t>(button)); }
std::optional<Key> key_named(std::string_view name) { return find<Key>(kKeyNames, name); }
std::optional<MouseButton> mouse_button_named(std::string_view name) {
    return find<MouseButton>(kMouseButtonNames, name);
}
std::span<const std::string_view> key_names() { return kKeyNames; }
std::span<const std::string_view> mouse_button_names() { return kMouseButtonNames; }

std::string name_of(const Modifiers& modifiers) {
    std::string name;
    const auto add = [&](bool held, std::string_view part) {
        if (!held) return;
        if (!name.empty()) name += '+';
        name += part;
    };
    add(modifiers.ctrl, "ctrl");
    add(modifiers.alt, "alt");
    add(modifiers.shift, "shift");
    add(modifiers.super, "super");
    return name;
}

std::optional<Modifiers> modifiers_named(std::string_view name) {
    Modifiers modifiers;
    for (bool more = true; more;) {
        const std::size_t plus = name.find('+');
        const std::string_view part = name.substr(0, plus);
        bool* held = part == "ctrl"    ? &modifiers.ctrl
                     : part == "alt"   ? &modifiers.alt
                     : part == "shift" ? &modifiers.shift
                     : part == "super" ? &modifiers.super
                                       : nullptr;
        if (held == nullptr || *held) return std::nullopt;
        *held = true;
        more = plus != std::string_view::npos;
        if (more) name.remove_prefix(plus + 1);
    }
    return modifiers;
}

}  // namespace burin::session

// SPDX-License-Identifier: MIT
#include "app/session/input_keys.hpp"

#include <algorithm>
#include <array>

namespace burin {
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

constexpr std::size_t kLongestCompared = 64;

std::size_t edit_distance(std::string_view a, std::string_view b) {
    a = a.substr(0, kLongestCompared);
    b = b.substr(0, kLongestCompared);
    std::array<std::size_t, kLongestCompared + 1> row{};
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
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

std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names) {
    return *std::ranges::min_element(names, {}, [&](std::string_view name) { return edit_distance(wrong, name); });
}

}  // namespace burin

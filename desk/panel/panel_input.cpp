// SPDX-License-Identifier: MIT
#include "desk/panel/panel_input.hpp"

#include <imgui/imgui.h>

#include <array>
#include <cfloat>

namespace burin::session::panel {

namespace {

struct NamedKey {
    ImGuiKey theirs;
    Key ours;
};
constexpr std::array<NamedKey, 22> kKeys{{{ImGuiKey_Tab, Key::tab},
                                          {ImGuiKey_LeftArrow, Key::left},
                                          {ImGuiKey_RightArrow, Key::right},
                                          {ImGuiKey_UpArrow, Key::up},
                                          {ImGuiKey_DownArrow, Key::down},
                                          {ImGuiKey_PageUp, Key::page_up},
                                          {ImGuiKey_PageDown, Key::page_down},
                                          {ImGuiKey_Home, Key::home},
                                          {ImGuiKey_End, Key::end},
                                          {ImGuiKey_Insert, Key::insert},
                                          {ImGuiKey_Delete, Key::delete_},
                                          {ImGuiKey_Backspace, Key::backspace},
                                          {ImGuiKey_Space, Key::space},
                                          {ImGuiKey_Enter, Key::enter},
                                          {ImGuiKey_Escape, Key::escape},
                                          {ImGuiKey_KeyPadEnter, Key::keypad_enter},
                                          {ImGuiKey_A, Key::a},
                                          {ImGuiKey_C, Key::c},
                                          {ImGuiKey_V, Key::v},
                                          {ImGuiKey_X, Key::x},
                                          {ImGuiKey_Y, Key::y},
                                          {ImGuiKey_Z, Key::z}}};

// Kinds of events that one layout has received so far.
struct Told {
    bool button = false, moved_after_button = false, text = false, key = false;
};

void take_modifiers(const Modifiers& modifiers) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyShift = modifiers.shift;
    io.KeyCtrl = modifiers.ctrl;
    io.KeyAlt = modifiers.alt;
    io.KeySuper = modifiers.super;
}

// Hands an event to the toolkit if it can still belong to this layout; returns whether it did.
struct Hand {
    ImGuiIO& io;
    Told& told;

    // Motion after a button belongs to the next layout: a press happens where the mouse was.
    bool operator()(const MouseMove& move) const {
        if (told.button) return false;
        io.MousePos = {static_cast<float>(move.position_px.x), static_cast<float>(move.position_px.y)};
        return true;
    }
    bool operator()(const PointerGone&) const {
        if (told.button) return false;
        io.MousePos = {-FLT_MAX, -FLT_MAX};
        return true;
    }
    bool operator()(const MouseClick& click) const {
        if (told.button) return false;
        io.MouseDown[static_cast<std::size_t>(click.button)] = click.pressed;
        take_modifiers(click.modifiers);
        told.button = true;
        return true;
    }
    bool operator()(const Scroll& scroll) const {
        io.MouseWheel += static_cast<float>(scroll.steps.y);
        io.MouseWheelH += static_cast<float>(scroll.steps.x);
        return true;
    }
    bool operator()(const KeyInput& key) const {
        if (told.key || told.text) return false;
        io.KeysDown[static_cast<std::size_t>(key.key)] = key.motion != KeyMotion::release;
        take_modifiers(key.modifiers);
        told.key = true;
        return true;
    }
    bool operator()(const TextInput& text) const {
        if (told.key) return false;
        io.AddInputCharactersUTF8(text.utf8.c_str());
        told.text = true;
        return true;
    }
    bool operator()(const WindowFocus& focus) const {
        if (told.button || told.key) return false;
        if (focus.gained) return true;
        for (bool& down : io.MouseDown) down = false;
        for (bool& down : io.KeysDown) down = false;
        take_modifiers({});
        told.button = told.key = true;
        return true;
    }
};

}  // namespace

void PanelEvents::hand_over() {
    Told told;
    while (!waiting_.empty() && std::visit(Hand{ImGui::GetIO(), told}, waiting_.front())) waiting_.pop_front();
}

std::optional<PanelInput> panel_input(const Input& input, const Vec2& origin_px, const Vec2& px_per_panel_px) {
    if (const auto* move = std::get_if<MouseMove>(&input)) {
        return MouseMove{(move->position_px - origin_px) / px_per_panel_px};
    }
    if (const auto* click = std::get_if<MouseClick>(&input)) return *click;
    if (const auto* scroll = std::get_if<Scroll>(&input)) return *scroll;
    if (const auto* key = std::get_if<KeyInput>(&input)) return *key;
    if (const auto* text = std::get_if<TextInput>(&input)) return *text;
    if (const auto* focus = std::get_if<WindowFocus>(&input)) return *focus;
    return std::nullopt;
}

void name_keys() {
    ImGuiIO& io = ImGui::GetIO();
    for (const NamedKey& key : kKeys) io.KeyMap[key.theirs] = static_cast<int>(key.ours);
}

}  // namespace burin::session::panel

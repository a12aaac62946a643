// SPDX-License-Identifier: MIT
#include "session/present/session_window.hpp"

#include <algorithm>
#include <utility>

#include "session/input/input_keys.hpp"

namespace burin::session {
namespace {

// Maps a key's name from the window library to the log's, which differ where the log's are easier to type.
std::optional<Key> key_of(std::string name) {
    static const std::vector<std::pair<std::string, std::string>> others{{"'", "apostrophe"},
                                                                         {",", "comma"},
                                                                         {"-", "minus"},
                                                                         {".", "period"},
                                                                         {"/", "slash"},
                                                                         {";", "semicolon"},
                                                                         {"=", "equal"},
                                                                         {"[", "left-bracket"},
                                                                         {"]", "right-bracket"},
                                                                         {"\\", "backslash"},
                                                                         {"`", "grave"},
                                                                         {"left_shift", "shift"},
                                                                         {"right_shift", "shift"},
                                                                         {"left_control", "ctrl"},
                                                                         {"right_control", "ctrl"},
                                                                         {"left_alt", "alt"},
                                                                         {"right_alt", "alt"},
                                                                         {"left_super", "super"},
                                                                         {"right_super", "super"},
                                                                         {"keypad_decimal", "keypad-period"}};
    const auto other = std::ranges::find(others, name, &std::pair<std::string, std::string>::first);
    if (other != others.end()) return key_named(other->second);
    std::ranges::replace(name, '_', '-');
    return key_named(name);
}

Modifiers modifiers_of(const window::Modifiers& held) { return {held.shift, held.control, held.alt, held.super}; }

std::string utf8_of(char32_t c) {
    std::string text;
    const auto byte = [&](std::uint32_t value) { text.push_back(static_cast<char>(value)); };
    const auto code = static_cast<std::uint32_t>(c);
    if (code < 0x80) {
        byte(code);
    } else if (code < 0x800) {
        byte(0xc0 | (code >> 6));
        byte(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        byte(0xe0 | (code >> 12));
        byte(0x80 | ((code >> 6) & 0x3f));
        byte(0x80 | (code & 0x3f));
    } else {
        byte(0xf0 | (code >> 18));
        byte(0x80 | ((code >> 12) & 0x3f));
        byte(0x80 | ((code >> 6) & 0x3f));
        byte(0x80 | (code & 0x3f));
    }
    return text;
}

std::uint32_t pixels(int n) { return static_cast<std::uint32_t>(std::max(n, 0)); }

}  // namespace

Result<std::unique_ptr<SessionWindow>> SessionWindow::open(const std::string& title, const std::string& monitor,
                                                           ImageSize size,
                                                           std::optional<window::Window::Position> place) {
    window::WindowOptions wanted{
        .title = title, .width = static_cast<int>(size.width), .height = static_cast<int>(size.height)};
    wanted.scaled = true;
    if (!monitor.empty()) wanted.full_screen = monitor;
    if (place) {
        wanted.x = place->x;
        wanted.y = place->y;
    }
    auto opened = window::Window::create(wanted);
    if (!opened) return std::unexpected(opened.error());
    return std::unique_ptr<SessionWindow>(new SessionWindow(std::move(*opened)));
}

Result<gpu::SurfaceHandle> SessionWindow::make_surface(gpu::Device& device, std::uint32_t) {
    return window_.create_surface(device);
}

std::vector<Input> SessionWindow::inputs(double wait_s) {
    std::vector<Input> inputs;
    for (const window::WindowEvent& event : wait_s > 0.0 ? window_.wait(wait_s) : window_.poll()) {
        if (auto input = input_of(event)) inputs.push_back(std::move(*input));
    }
    return inputs;
}

std::optional<Input> SessionWindow::input_of(const window::WindowEvent& event) {
    if (const auto* e = std::get_if<window::KeyEvent>(&event)) {
        const std::optional<Key> key = key_of(e->key);
        if (!key) return std::nullopt;
        const KeyMotion motion = e->press == window::Press::down     ? KeyMotion::press
                                 : e->press == window::Press::repeat ? KeyMotion::repeat
                                                                     : KeyMotion::release;
        return KeyInput{*key, motion, modifiers_of(e->held)};
    }
    if (const auto* e = std::get_if<window::TextEvent>(&event)) return TextInput{utf8_of(e->character)};
    if (const auto* e = std::get_if<window::MouseMoveEvent>(&event)) return MouseMove{{e->x, e->y}};
    if (const auto* e = std::get_if<window::MouseButtonEvent>(&event)) {
        if (e->button > 4) return std::nullopt;
        return MouseClick{static_cast<MouseButton>(e->button), e->down, modifiers_of(e->held)};
    }
    if (const auto* e = std::get_if<window::ScrollEvent>(&event)) return Scroll{{e->x, e->y}, {}};
    if (const auto* e = std::get_if<window::ResizeEvent>(&event)) {
        show_again();
        return WindowResize{pixels(e->width), pixels(e->height)};
    }
    if (const auto* e = std::get_if<window::FocusEvent>(&event)) return WindowFocus{e->focused};
    if (std::holds_alternative<window::CloseEvent>(event)) return WindowClose{};
    if (std::holds_alternative<window::ExposeEvent>(event)) show_again();
    if (const auto* e = std::get_if<window::MonitorEvent>(&event)) {
        notify("monitor " + e->monitor + (e->connected ? " is there" : " has gone") +
               (e->fell_back_to_window ? ": the picture is in a window now" : ""));
    }
    return std::nullopt;
}

ImageSize SessionWindow::size() const {
    const window::Window::Size now = window_.framebuffer();
    return {pixels(now.width), pixels(now.height)};
}

SessionOutput::Position SessionWindow::on_monitor() const {
    const window::Window::Position at = window_.on_monitor();
    return {at.x, at.y};
}

double SessionWindow::refresh_Hz() const {
    const double told = window_.monitor().refresh_Hz;
    return told > 0.0 ? told : 60.0;
}

void SessionWindow::exchange_full_screen() {
    if (window_.full_screen()) {
        window_.leave_full_screen();
    } else if (const auto filled = window_.fill_monitor(std::to_string(window_.monitor().index)); !filled) {
        notify(filled.error().line());
    }
    show_again();
}

}  // namespace burin::session

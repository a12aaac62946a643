// SPDX-License-Identifier: MIT
#include "desk/present/session_window.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace burin::session {
namespace {

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
    BURIN_TRY(opened, window::Window::create(wanted));
    return std::unique_ptr<SessionWindow>(new SessionWindow(std::move(opened)));
}

Result<gpu::SurfaceHandle> SessionWindow::make_surface(gpu::Device& device, std::uint32_t) {
    return window_.create_surface(device);
}

std::vector<Input> SessionWindow::inputs(double wait_s) {
    std::vector<Input> inputs;
    for (const window::WindowEvent& event : wait_s > 0.0 ? window_.wait(wait_s) : window_.poll()) {
        if (const auto* key = std::get_if<window::KeyEvent>(&event)) {
            std::ranges::move(keys_.read(*key), std::back_inserter(inputs));
        } else if (const auto* text = std::get_if<window::TextEvent>(&event)) {
            std::ranges::move(keys_.read(*text), std::back_inserter(inputs));
        } else if (auto input = input_of(event)) {
            inputs.push_back(std::move(*input));
        }
    }
    return inputs;
}

std::optional<Input> SessionWindow::input_of(const window::WindowEvent& event) {
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

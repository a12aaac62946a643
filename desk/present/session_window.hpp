// SPDX-License-Identifier: MIT
// Window of a live session: its events as the session's input, and its surface.
// Main thread alone, except for window::wake().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "desk/present/key_reader.hpp"
#include "desk/present/session_output.hpp"
#include "session/input/input_event.hpp"
#include "window/window.hpp"

namespace burin::session {

class SessionWindow final : public SessionOutput {
public:
    // Opens a window that fills a monitor, or (empty) one on the desktop whose contents have this size. The Error for a
    // missing display says what to do.
    [[nodiscard]] static Result<std::unique_ptr<SessionWindow>> open(
        const std::string& title, const std::string& monitor, ImageSize size,
        std::optional<window::Window::Position> place = std::nullopt);
    ~SessionWindow() override { close_images(); }  // before the window

    // Returns what happened, waiting for at most so long (0: not at all).
    [[nodiscard]] std::vector<Input> inputs(double wait_s);

    [[nodiscard]] ImageSize size() const override;
    [[nodiscard]] Position on_monitor() const override;
    [[nodiscard]] double refresh_Hz() const override;
    void exchange_full_screen() override;
    void name(const std::string& title) { window_.set_title(title); }
    void hide() { window_.set_visible(false); }
    [[nodiscard]] double scale() const { return window_.display_scale(); }

private:
    explicit SessionWindow(window::Window window) : window_(std::move(window)) {}
    [[nodiscard]] Result<gpu::SurfaceHandle> make_surface(gpu::Device& device, std::uint32_t layers) override;
    // Of events other than those of keys and text.
    [[nodiscard]] std::optional<Input> input_of(const window::WindowEvent& event);

    window::Window window_;
    KeyReader keys_;
};

}  // namespace burin::session

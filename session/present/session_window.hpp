// SPDX-License-Identifier: MIT
// The window of a live session: its events as the session's input, and its surface.
// Main thread alone, but for window::wake().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/session/input_event.hpp"
#include "app/session/session_output.hpp"
#include "window/window.hpp"

namespace burin {

class SessionWindow final : public SessionOutput {
public:
    // Fills a monitor, or (empty) is a window on the desktop whose contents have this size. An Error without a display says what to do.
    [[nodiscard]] static Result<std::unique_ptr<SessionWindow>> open(
        const std::string& title, const std::string& monitor, ImageSize size,
        std::optional<window::Window::Position> place = std::nullopt);
    ~SessionWindow() override { close_images(); }  // before the window

    // What happened, waiting for at most so long (0: not at all).
    [[nodiscard]] std::vector<Input> inputs(double wait_s);

    [[nodiscard]] ImageSize size() const override;
    [[nodiscard]] Position on_monitor() const override;
    [[nodiscard]] double refresh_Hz() const override;
    void exchange_full_screen() override;

private:
    explicit SessionWindow(window::Window window) : window_(std::move(window)) {}
    [[nodiscard]] Result<gpu::SurfaceHandle> make_surface(gpu::Device& device, std::uint32_t layers) override;
    [[nodiscard]] std::optional<Input> input_of(const window::WindowEvent& event);

    window::Window window_;
};

}  // namespace burin

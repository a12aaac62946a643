// SPDX-License-Identifier: MIT
// The window of a live session: its events as the session's input, and its images as targets.
// Main thread alone, but for window::wake().
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "app/session/input_event.hpp"
#include "app/session/session_options.hpp"
#include "base/clock.hpp"
#include "gpu/swapchain.hpp"
#include "renderer/image.hpp"
#include "window/window.hpp"

namespace burin {

class SessionWindow {
public:
    // Fills a monitor, or (empty) is a window on the desktop whose contents have this size. An Error without a display says what to do.
    [[nodiscard]] static Result<SessionWindow> open(const std::string& title, const std::string& monitor,
                                                    ImageSize size,
                                                    std::optional<window::Window::Position> place = std::nullopt);
    // A device that can present to windows.
    [[nodiscard]] static Result<gpu::Device> open_device();

    // Its images on a device, of one layer or one for each eye; anew after a lost surface or device. On an Error there are none.
    [[nodiscard]] Result<void> open_images(gpu::Device& device, std::uint32_t layers);
    void close_images() { images_.reset(); }
    [[nodiscard]] std::uint32_t layers() const { return images_ ? images_->layers() : 0; }

    // What happened, waiting for at most so long (0: not at all).
    [[nodiscard]] std::vector<Input> inputs(double wait_s);

    [[nodiscard]] gpu::SwapchainFrame acquire();
    // Waiting for the display since the last call: acquire() blocks while all images are in its queue, until it takes the next one.
    struct Blocked {
        Nanoseconds for_ns = 0;
        std::optional<Nanoseconds> until_ns;  // the last time, where the display itself ended it: a vblank
    };
    [[nodiscard]] Blocked take_blocked() { return std::exchange(blocked_, {}); }
    // As Swapchain.
    [[nodiscard]] std::uint64_t presented() const { return images_ ? images_->presented() : 0; }
    [[nodiscard]] std::optional<bool> was_shown(std::uint64_t picture) const {
        return images_ ? images_->was_shown(picture) : std::nullopt;
    }
    gpu::FrameAnswer present(const gpu::SwapchainFrame& frame) { return images_->present(frame); }
    gpu::FrameAnswer abandon(const gpu::SwapchainFrame& frame) { return images_->abandon(frame); }
    [[nodiscard]] VkFormat format() const { return images_->format(); }
    [[nodiscard]] ImageSize size() const;
    [[nodiscard]] std::optional<std::uint64_t> vblank_count() const { return images_->vblank_count(); }
    [[nodiscard]] window::Window::Position on_monitor() const { return window_.on_monitor(); }
    [[nodiscard]] double refresh_Hz() const;
    [[nodiscard]] bool needs_showing();  // the window's contents were lost since the last call
    void show_again() { exposed_ = true; }
    void exchange_full_screen();
    // For people: monitors that came and went, since the last call.
    [[nodiscard]] std::vector<std::string> take_messages();

private:
    explicit SessionWindow(window::Window window) : window_(std::move(window)) {}
    [[nodiscard]] std::optional<Input> input_of(const window::WindowEvent& event);

    window::Window window_;  // outlives its images
    std::optional<gpu::Swapchain> images_;
    bool exposed_ = true;
    MonotonicClock clock_;
    bool display_blocks_ = false;
    Blocked blocked_;
    std::vector<std::string> messages_;
};

}  // namespace burin

// SPDX-License-Identifier: MIT
// What a screen's pictures reach: a window (session_window.hpp), or a display driven without any (direct_output.hpp). They differ in where
// their surface comes from, in their size and in their refresh rate; images, waiting for the display and losses are here.
// Main thread alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "gpu/swapchain.hpp"
#include "renderer/image.hpp"

namespace burin {

class SessionOutput {
public:
    virtual ~SessionOutput() = default;
    SessionOutput(const SessionOutput&) = delete;
    SessionOutput& operator=(const SessionOutput&) = delete;

    [[nodiscard]] virtual ImageSize size() const = 0;     // pixels
    [[nodiscard]] virtual double refresh_Hz() const = 0;  // above 0
    struct Position {
        int x = 0, y = 0;
    };
    [[nodiscard]] virtual Position on_monitor() const { return {}; }  // of its upper left pixel
    virtual void exchange_full_screen() = 0;
    // For people, since the last call.
    [[nodiscard]] std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

    // Its images on a device, of one layer or one for each eye. On an Error there are none.
    [[nodiscard]] Result<void> open_images(gpu::Device& device, std::uint32_t layers);
    // The same after a lost surface or device.
    [[nodiscard]] virtual Result<void> reopen_images(gpu::Device& device, std::uint32_t layers) {
        return open_images(device, layers);
    }
    // Once a frame: what was lost may be there again.
    virtual void look_after(gpu::Device&) {}
    void close_images() { images_.reset(); }
    [[nodiscard]] std::uint32_t layers() const { return images_ ? images_->layers() : 0; }  // 0: there are no images

    // Without images nobody would see a picture: `minimised`.
    [[nodiscard]] gpu::SwapchainFrame acquire();
    // Waiting for the display since the last call: acquire() blocks while all images are in its queue, until it takes the next one.
    struct Blocked {
        Nanoseconds for_ns = 0;
        std::optional<Nanoseconds> until_ns;  // the last time, where the display itself ended it: a vblank
    };
    [[nodiscard]] Blocked take_blocked() { return std::exchange(blocked_, {}); }
    // Of a frame that acquire() gave; as Swapchain.
    gpu::FrameAnswer present(const gpu::SwapchainFrame& frame) { return images_->present(frame); }
    gpu::FrameAnswer abandon(const gpu::SwapchainFrame& frame) { return images_->abandon(frame); }
    [[nodiscard]] VkFormat format() const { return images_->format(); }
    // As Swapchain; without images there is nothing to know.
    [[nodiscard]] std::uint64_t presented() const { return images_ ? images_->presented() : 0; }
    [[nodiscard]] std::optional<bool> was_shown(std::uint64_t picture) const;
    [[nodiscard]] std::optional<std::uint64_t> vblank_count() const;

    [[nodiscard]] bool needs_showing() {
        return std::exchange(exposed_, false);
    }  // the contents were lost since the last call
    void show_again() { exposed_ = true; }

protected:
    SessionOutput() = default;
    [[nodiscard]] virtual Result<gpu::SurfaceHandle> make_surface(gpu::Device& device, std::uint32_t layers) = 0;
    void tell(std::string message) { messages_.push_back(std::move(message)); }

private:
    std::optional<gpu::Swapchain> images_;
    bool exposed_ = true;
    MonotonicClock clock_;
    bool display_blocks_ = false;
    Blocked blocked_;
    std::vector<std::string> messages_;
};

}  // namespace burin

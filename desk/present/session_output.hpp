// SPDX-License-Identifier: MIT
// Output of a screen's pictures: a window (session_window.hpp), or a display driven without any (direct_output.hpp).
// These differ in the origin of their surface, in size and in refresh rate; images, waiting for the display and losses
// are handled here. Main thread alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/image.hpp"
#include "gpu/swapchain.hpp"

namespace burin::session {

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
    // Returns messages for the user since the last call.
    [[nodiscard]] std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

    // Opens the images on a device, with one layer, or with one for each eye. After an Error there are none.
    [[nodiscard]] Result<void> open_images(gpu::Device& device, std::uint32_t layers);
    // Reopens the images after a lost surface or device.
    [[nodiscard]] virtual Result<void> reopen_images(gpu::Device& device, std::uint32_t layers) {
        return open_images(device, layers);
    }
    // Checks, once a frame, whether what was lost is present again.
    virtual void look_after(gpu::Device&) {}
    void close_images() { images_.reset(); }
    [[nodiscard]] std::uint32_t layers() const { return images_ ? images_->layers() : 0; }  // 0: there are no images

    // Acquires an image; without images the answer is `minimised`, since nobody would see a picture.
    [[nodiscard]] gpu::SwapchainFrame acquire();
    // Waiting for the display since the last call: acquire() blocks while all images are in its queue, until it takes
    // the next one.
    struct Blocked {
        Nanoseconds for_ns = 0;
        std::optional<Nanoseconds> until_ns;  // end of the last wait; a vblank, where the display ended it
    };
    [[nodiscard]] Blocked take_blocked() { return std::exchange(blocked_, {}); }
    // Present or abandon a frame that acquire() gave, as Swapchain does.
    gpu::FrameAnswer present(const gpu::SwapchainFrame& frame) { return images_->present(frame); }
    gpu::FrameAnswer abandon(const gpu::SwapchainFrame& frame) { return images_->abandon(frame); }
    [[nodiscard]] VkFormat format() const { return images_->format(); }
    // Report as Swapchain does; without images, nothing.
    [[nodiscard]] std::uint64_t presented() const { return images_ ? images_->presented() : 0; }
    [[nodiscard]] std::optional<bool> was_shown(std::uint64_t picture) const;
    [[nodiscard]] std::optional<std::uint64_t> vblank_count() const;

    // Returns whether the contents were lost since the last call.
    [[nodiscard]] bool needs_showing() { return std::exchange(exposed_, false); }
    void show_again() { exposed_ = true; }

protected:
    SessionOutput() = default;
    [[nodiscard]] virtual Result<gpu::SurfaceHandle> make_surface(gpu::Device& device, std::uint32_t layers) = 0;
    void notify(std::string message) { messages_.push_back(std::move(message)); }

private:
    std::optional<gpu::Swapchain> images_;
    bool exposed_ = true;
    MonotonicClock clock_;
    bool display_blocks_ = false;
    Blocked blocked_;
    std::vector<std::string> messages_;
};

}  // namespace burin::session

// SPDX-License-Identifier: MIT
// Presents images to a surface: a window's (window/) or that of a display without a window system
// (gpu/direct_display.hpp).
//
//   SwapchainFrame frame = swapchain.acquire(window_width, window_height);
//   if (frame.answer == FrameAnswer::presented) {                     // an image is there to be drawn
//       ... record into frame.views ...                               // final layout PRESENT_SRC_KHR
//       auto submission = std::move(*commands).submit(frame.sync);
//       FrameAnswer answer = submission ? swapchain.present(frame) : swapchain.abandon(frame);
//   }
//
// What each answer asks of the caller:
//   presented     nothing; after acquire(): draw, submit with frame.sync, present.
//   resized       no image this time. width() and height() may have changed: make targets anew, acquire again.
//   minimised     nobody would see an image (the window has no area, or nobody takes images from the queue): wait for
//                 the window's events, not for time.
//   surface_lost  the surface is gone: drop this object, make a new surface from the window, and a new swapchain.
//   device_lost   the GPU is gone: drop all that was made on the device, open a new Device.
// Acquire one image at a time. A frame that was acquired must be presented or abandoned.
//
// Always FIFO: no tearing, and the only mode that stereo presentation is known to work with. On a machine whose window
// system has no refresh (Xvfb) FIFO does not throttle: pace frames by the clock.
// Two layers (quad buffer: one swapchain image holds both eyes' views) are granted by the surface's capabilities; a
// driver may accept layers that it cannot show.
// Ownership: owns the surface; must be destroyed before the window. Thread and lifetime: as Device.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/commands.hpp"

namespace burin::gpu {

enum class FrameAnswer { presented, resized, minimised, surface_lost, device_lost };
[[nodiscard]] const char* name_of(FrameAnswer answer);

struct SwapchainOptions {
    std::uint32_t width = 0, height = 0;  // pixels of the window; the surface's own size overrides it where it has one
    std::uint32_t layers = 1;             // 2: one for each eye; an Error where the surface has only one
    bool count_vblanks = false;           // where the device can; see vblank_count()
};

struct SwapchainFrame {
    FrameAnswer answer = FrameAnswer::minimised;
    std::uint32_t image = 0;
    VkImage raw = VK_NULL_HANDLE;
    std::array<VkImageView, 2> views{};  // 2D views of each layer; the second is null with one layer
    std::uint32_t width = 0, height = 0;
    // Number of presentations since this image was shown, which tells what it still holds: 1 means the previous frame;
    // 0 means undefined contents and layout, draw all of it. Otherwise its layout is PRESENT_SRC_KHR.
    std::uint64_t age = 0;
    QueueSync sync;  // for the submission that draws it
};

class Swapchain {
public:
    // Creates a swapchain and takes the surface. An Error when the device cannot present to it, or when two layers are
    // asked for and it has one. A window without area gives a swapchain that answers `minimised`.
    [[nodiscard]] static Result<Swapchain> create(Device& device, SurfaceHandle surface,
                                                  const SwapchainOptions& options);
    Swapchain(Swapchain&&) noexcept = default;
    Swapchain& operator=(Swapchain&& other) noexcept;
    ~Swapchain() { release(); }

    // Waits until an image is free, at most 0.1 s. Takes the window's present framebuffer size.
    [[nodiscard]] SwapchainFrame acquire(std::uint32_t window_width, std::uint32_t window_height);
    FrameAnswer present(const SwapchainFrame& frame);
    // Gives back an image that was not drawn. The next acquire() rebuilds the images.
    FrameAnswer abandon(const SwapchainFrame& frame);

    [[nodiscard]] VkFormat format() const { return format_.format; }
    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] std::uint32_t layers() const { return layers_; }
    [[nodiscard]] std::uint64_t presented() const { return presented_; }  // number of images presented so far
    [[nodiscard]] bool can_copy_from() const { return can_copy_; }  // images may be read back (tests, screenshots)
    // Returns the number of refreshes of the display so far; nothing where that is unknown (most window systems).
    [[nodiscard]] std::optional<std::uint64_t> vblank_count() const;
    // Tells whether the image with this number (as counted by presented()) has been on the display; nothing without
    // Capabilities::present_wait, or when its swapchain is gone. Does not wait.
    [[nodiscard]] std::optional<bool> was_shown(std::uint64_t picture) const;

private:
    struct Slot {  // one image
        VkImage image = VK_NULL_HANDLE;
        std::array<ImageViewHandle, 2> views;
        SemaphoreHandle drawn;           // signalled by the submission, waited for by the presentation
        std::uint64_t presented_as = 0;  // number of its last presentation, 0: none
    };
    struct Ready {  // signalled when an image may be drawn to
        SemaphoreHandle semaphore;
        std::uint64_t used_by = 0;  // serial of the submission that waits for it
    };
    explicit Swapchain(std::shared_ptr<Core> core) : core_(std::move(core)) {}
    void release();
    [[nodiscard]] Result<void> check_surface(std::uint32_t layers);
    [[nodiscard]] Result<void> choose_format();
    [[nodiscard]] VkResult rebuild();
    [[nodiscard]] VkResult take_images();
    [[nodiscard]] VkResult create_swapchain(const VkSurfaceCapabilitiesKHR& caps);
    void drop_images();
    [[nodiscard]] FrameAnswer answer_of(VkResult result);
    [[nodiscard]] FrameAnswer rebuilt();
    [[nodiscard]] bool counts_vblanks() const;

    std::shared_ptr<Core> core_;  // empty once moved from
    SurfaceHandle surface_;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    std::vector<Slot> slots_;
    std::vector<Ready> ready_;
    std::size_t next_ready_ = 0, taken_ready_ = 0;
    std::uint32_t wanted_width_ = 0, wanted_height_ = 0, width_ = 0, height_ = 0, layers_ = 1;
    std::uint64_t presented_ = 0;
    std::uint64_t presented_before_ = 0;  // presentations of the earlier VkSwapchainKHRs
    bool stale_ = false;                  // the images no longer fit the surface
    bool can_copy_ = false, count_vblanks_ = false;
};

}  // namespace burin::gpu

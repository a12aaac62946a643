// SPDX-License-Identifier: MIT
#include "desk/present/session_output.hpp"

#include "base/try.hpp"

namespace burin::session {
namespace {

// Shorter waits are the driver's own work.
constexpr Nanoseconds kBlocks_ns = 1'000'000;

}  // namespace

Result<void> SessionOutput::open_images(gpu::Device& device, std::uint32_t layers) {
    images_.reset();
    BURIN_TRY(surface, make_surface(device, layers));
    const ImageSize now = size();
    BURIN_TRY(images, gpu::Swapchain::create(
                          device, std::move(surface),
                          {.width = now.width, .height = now.height, .layers = layers, .count_vblanks = true}));
    images_ = std::move(images);
    // A software device copies on its own, whatever the display does.
    display_blocks_ = !device.info().is_software();
    exposed_ = true;
    return {};
}

gpu::SwapchainFrame SessionOutput::acquire() {
    if (!images_) return {};
    const ImageSize now = size();
    const Nanoseconds before_ns = clock_.now_ns();
    const gpu::SwapchainFrame frame = images_->acquire(now.width, now.height);
    const Nanoseconds until_ns = clock_.now_ns();
    if (frame.answer == gpu::FrameAnswer::presented && until_ns - before_ns >= kBlocks_ns) {
        blocked_.for_ns += until_ns - before_ns;
        if (display_blocks_) blocked_.until_ns = until_ns;
    }
    return frame;
}

std::optional<bool> SessionOutput::was_shown(std::uint64_t picture) const {
    return images_ ? images_->was_shown(picture) : std::nullopt;
}

std::optional<std::uint64_t> SessionOutput::vblank_count() const {
    return images_ ? images_->vblank_count() : std::nullopt;
}

}  // namespace burin::session

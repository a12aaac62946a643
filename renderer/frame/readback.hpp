// SPDX-License-Identifier: MIT
// Brings both eyes' finished pictures (frame_targets.hpp) to the host.
// Ownership: move-only. Thread: as gpu::Device.
#pragma once

#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "renderer/image.hpp"

namespace burin {

class Readback {
public:
    // For pictures of this size; nothing is done where it is so already.
    [[nodiscard]] Result<void> fit(gpu::Device& device, ImageSize size);
    // Of an image of two layers of 4 bytes a pixel, in layout SHADER_READ_ONLY_OPTIMAL before and after.
    void copy(const gpu::Device& device, gpu::Commands& commands, VkImage picture);
    // Once the commands of copy() are done.
    [[nodiscard]] StereoImage pictures() const;

private:
    gpu::Buffer buffer_;
    ImageSize size_;
};

}  // namespace burin

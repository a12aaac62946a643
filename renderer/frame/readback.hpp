// SPDX-License-Identifier: MIT
// Reads both eyes' finished pictures (frame_targets.hpp) back to the host.
// Ownership: move-only. Thread: as gpu::Device.
#pragma once

#include "base/image.hpp"
#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"

namespace burin::renderer {

class Readback {
public:
    // Allocates the buffer for pictures of this size; does nothing if it has this size already.
    [[nodiscard]] Result<void> fit(gpu::Device& device, ImageSize size);
    // Records the copy of an image of two layers of 4 bytes a
    // pixel, in layout SHADER_READ_ONLY_OPTIMAL before and after.
    void copy(const gpu::Device& device, gpu::Commands& commands, VkImage picture);
    // Returns the pictures; call it once the commands of copy() have finished.
    [[nodiscard]] StereoImage pictures() const;

private:
    gpu::Buffer buffer_;
    ImageSize size_;
};

}  // namespace burin::renderer

// SPDX-License-Identifier: MIT
// Pictures in memory: sRGB, 8 bits a channel, red green blue alpha, rows from the top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace burin {

struct ImageSize {
    std::uint32_t width = 0;  // pixels
    std::uint32_t height = 0;
};

struct Image {
    ImageSize size;
    std::vector<std::uint8_t> rgba;  // 4 * width * height bytes; alpha is 255

    // The four bytes of a pixel; (0, 0) is the upper left one.
    [[nodiscard]] const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const {
        return rgba.data() + 4 * (static_cast<std::size_t>(y) * size.width + x);
    }
};

// What a frame cost and drew. Times are the GPU's own; 0 where it has no timestamps.
struct RenderStats {
    double gpu_s = 0.0;           // the whole frame without the copy back
    double shadow_gpu_s = 0.0;    // of it, the shadow map
    std::uint64_t triangles = 0;  // of the workpiece, in one view
    std::uint32_t draws = 0;      // draw calls of both passes
    std::uint32_t patches = 0;
    std::uint64_t uploaded_bytes = 0;  // changed patches brought to the GPU for this frame
};

struct StereoImage {
    Image left, right;  // the views of the left and of the right eye, of the same size
    RenderStats stats;
};

// Left eye's view on the left, right eye's on the right: for parallel viewing and for displays that take side by side.
[[nodiscard]] Image side_by_side(const StereoImage& stereo);

}  // namespace burin

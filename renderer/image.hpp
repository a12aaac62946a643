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

    bool operator==(const ImageSize&) const = default;
};

// Which of the two eyes' pictures are drawn. The other one's pixels are then undefined.
enum class Views : std::uint8_t { both, left, right };
inline constexpr std::size_t kViewChoices = 3;

// A part of a picture; (0, 0) is its upper left pixel.
struct PixelRect {
    std::uint32_t x = 0, y = 0;
    std::uint32_t width = 0, height = 0;  // 0: nothing

    [[nodiscard]] bool empty() const { return width == 0 || height == 0; }
    [[nodiscard]] bool operator==(const PixelRect&) const = default;
};
[[nodiscard]] constexpr PixelRect all_of(ImageSize size) { return {0, 0, size.width, size.height}; }
// The smallest one that holds both.
[[nodiscard]] PixelRect around(const PixelRect& a, const PixelRect& b);
// What lies in both.
[[nodiscard]] PixelRect common(const PixelRect& a, const PixelRect& b);

struct Image {
    ImageSize size;
    std::vector<std::uint8_t> rgba;  // 4 * width * height bytes; alpha is 255

    // The four bytes of a pixel; (0, 0) is the upper left one.
    [[nodiscard]] const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const {
        return rgba.data() + 4 * (static_cast<std::size_t>(y) * size.width + x);
    }
};

struct StereoImage {
    Image left, right;  // the views of the left and of the right eye, of the same size
};

// Left eye's view on the left, right eye's on the right: for parallel viewing and for displays that take side by side.
[[nodiscard]] Image side_by_side(const StereoImage& stereo);

}  // namespace burin

// SPDX-License-Identifier: MIT
// Images in memory: sRGB, 8 bits a channel, red green blue alpha, rows from the top. Plain data; any thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/error.hpp"

namespace burin {

struct ImageSize {
    std::uint32_t width = 0;  // pixels
    std::uint32_t height = 0;

    bool operator==(const ImageSize&) const = default;
};
[[nodiscard]] constexpr bool is_empty(ImageSize size) { return size.width == 0 || size.height == 0; }

// The eyes whose views are rendered. The pixels of the other view are then undefined.
enum class Views : std::uint8_t { both, left, right };
inline constexpr std::size_t kViewChoices = 3;

// A rectangle of an image; (0, 0) is the upper left pixel.
struct PixelRect {
    std::uint32_t x = 0, y = 0;
    std::uint32_t width = 0, height = 0;  // 0: empty

    [[nodiscard]] bool empty() const { return width == 0 || height == 0; }
    [[nodiscard]] bool operator==(const PixelRect&) const = default;
};
[[nodiscard]] constexpr PixelRect all_of(ImageSize size) { return {0, 0, size.width, size.height}; }
// Returns the smallest rectangle that holds both.
[[nodiscard]] inline PixelRect around(const PixelRect& a, const PixelRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    const std::uint32_t x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

// Returns the intersection of both.
[[nodiscard]] inline PixelRect common(const PixelRect& a, const PixelRect& b) {
    const std::uint32_t x0 = std::max(a.x, b.x), y0 = std::max(a.y, b.y);
    const std::uint32_t x1 = std::min(a.x + a.width, b.x + b.width), y1 = std::min(a.y + a.height, b.y + b.height);
    return x1 > x0 && y1 > y0 ? PixelRect{x0, y0, x1 - x0, y1 - y0} : PixelRect{};
}

struct Image {
    ImageSize size;
    std::vector<std::uint8_t> rgba;  // 4 * width * height bytes; alpha is 255

    // Returns the four bytes of a pixel; (0, 0) is the upper left one.
    [[nodiscard]] const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const {
        return rgba.data() + 4 * (static_cast<std::size_t>(y) * size.width + x);
    }
};

struct StereoImage {
    Image left, right;  // the views of the left and of the right eye, of the same size
};

// Puts the left eye's view on the left, the right eye's on the right: for parallel viewing and for displays that take
// side by side.
[[nodiscard]] inline Image side_by_side(const StereoImage& stereo) {
    const ImageSize size = stereo.left.size;
    BURIN_CHECK(stereo.right.size.width == size.width && stereo.right.size.height == size.height);
    Image both{{2 * size.width, size.height}, {}};
    both.rgba.reserve(2 * stereo.left.rgba.size());
    const std::size_t row_bytes = std::size_t{4} * size.width;
    for (std::uint32_t y = 0; y < size.height; ++y) {
        for (const Image* eye : {&stereo.left, &stereo.right}) {
            const std::uint8_t* row = eye->rgba.data() + y * row_bytes;
            both.rgba.insert(both.rgba.end(), row, row + row_bytes);
        }
    }
    return both;
}

}  // namespace burin

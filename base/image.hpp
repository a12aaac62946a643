// SPDX-License-Identifier: MIT
#include "renderer/image.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace burin {

PixelRect around(const PixelRect& a, const PixelRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    const std::uint32_t x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

PixelRect common(const PixelRect& a, const PixelRect& b) {
    const std::uint32_t x0 = std::max(a.x, b.x), y0 = std::max(a.y, b.y);
    const std::uint32_t x1 = std::min(a.x + a.width, b.x + b.width), y1 = std::min(a.y + a.height, b.y + b.height);
    return x1 > x0 && y1 > y0 ? PixelRect{x0, y0, x1 - x0, y1 - y0} : PixelRect{};
}

Image side_by_side(const StereoImage& stereo) {
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

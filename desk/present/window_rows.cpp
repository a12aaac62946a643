// SPDX-License-Identifier: MIT
#include "desk/present/window_rows.hpp"

#include <algorithm>

namespace burin::session {
namespace {

// Pixels between windows, and above each for its title.
constexpr int kWindowGap_px = 4, kWindowTitle_px = 40;

// Returns the windows at so many hundredths of their sizes, in rows as wide as the monitor.
std::vector<PlacedWindow> rows_of(std::span<const ImageSize> sizes, int monitor_width, std::uint32_t hundredths) {
    std::vector<PlacedWindow> placed;
    int x = 0, y = kWindowTitle_px, tallest = 0;
    for (const ImageSize& whole : sizes) {
        const ImageSize size{std::max(1u, whole.width * hundredths / 100),
                             std::max(1u, whole.height * hundredths / 100)};
        const int width = static_cast<int>(size.width);
        if (x > 0 && x + width > monitor_width) {
            x = 0;
            y += tallest + kWindowTitle_px;
            tallest = 0;
        }
        placed.push_back({x, y, size});
        x += width + kWindowGap_px;
        tallest = std::max(tallest, static_cast<int>(size.height));
    }
    return placed;
}

}  // namespace

std::vector<PlacedWindow> side_by_side(std::span<const ImageSize> sizes, ImageSize monitor) {
    const auto fits = [&](const PlacedWindow& one) {
        return one.x + static_cast<int>(one.size.width) <= static_cast<int>(monitor.width) &&
               one.y + static_cast<int>(one.size.height) <= static_cast<int>(monitor.height);
    };
    std::vector<PlacedWindow> placed;
    for (std::uint32_t hundredths = 100; hundredths >= 10; --hundredths) {
        placed = rows_of(sizes, static_cast<int>(monitor.width), hundredths);
        if (std::ranges::all_of(placed, fits)) break;
    }
    return placed;
}

}  // namespace burin::session

// SPDX-License-Identifier: MIT
#include "renderer/output/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "shaders/shared/srgb.h"

namespace burin::renderer {

namespace {

struct Glyph {
    char letter;
    std::array<std::uint8_t, 7> rows;  // five bits each, the left one highest
};

constexpr std::array<Glyph, 41> kGlyphs{{
    {'A', {0x0e, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11}}, {'B', {0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e}},
    {'C', {0x0e, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0e}}, {'D', {0x1e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1e}},
    {'E', {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f}}, {'F', {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x10}},
    {'G', {0x0e, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0f}}, {'H', {0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11}},
    {'I', {0x0e, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e}}, {'J', {0x07, 0x02, 0x02, 0x02, 0x02, 0x12, 0x0c}},
    {'K', {0x11, 0x12, 0x14, 0x18, 0x14, 0x12, 0x11}}, {'L', {0x10, 0x10, 0x10, 0x10, 0x10, 0x10, 0x1f}},
    {'M', {0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11}}, {'N', {0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x11}},
    {'O', {0x0e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e}}, {'P', {0x1e, 0x11, 0x11, 0x1e, 0x10, 0x10, 0x10}},
    {'Q', {0x0e, 0x11, 0x11, 0x11, 0x15, 0x12, 0x0d}}, {'R', {0x1e, 0x11, 0x11, 0x1e, 0x14, 0x12, 0x11}},
    {'S', {0x0f, 0x10, 0x10, 0x0e, 0x01, 0x01, 0x1e}}, {'T', {0x1f, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04}},
    {'U', {0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e}}, {'V', {0x11, 0x11, 0x11, 0x11, 0x11, 0x0a, 0x04}},
    {'W', {0x11, 0x11, 0x11, 0x15, 0x15, 0x1b, 0x11}}, {'X', {0x11, 0x11, 0x0a, 0x04, 0x0a, 0x11, 0x11}},
    {'Y', {0x11, 0x11, 0x0a, 0x04, 0x04, 0x04, 0x04}}, {'Z', {0x1f, 0x01, 0x02, 0x04, 0x08, 0x10, 0x1f}},
    {'0', {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e}}, {'1', {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e}},
    {'2', {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f}}, {'3', {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e}},
    {'4', {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02}}, {'5', {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e}},
    {'6', {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e}}, {'7', {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08}},
    {'8', {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e}}, {'9', {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c}},
    {'.', {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c}}, {':', {0x00, 0x0c, 0x0c, 0x00, 0x0c, 0x0c, 0x00}},
    {'-', {0x00, 0x00, 0x00, 0x1f, 0x00, 0x00, 0x00}}, {'/', {0x01, 0x01, 0x02, 0x04, 0x08, 0x10, 0x10}},
    {'%', {0x18, 0x19, 0x02, 0x04, 0x08, 0x13, 0x03}},
}};

constexpr int kAdvance = 6;  // five columns and one between letters

}  // namespace

Rgb8 grey_of_light(double share) {
    const auto value =
        static_cast<std::uint8_t>(std::lround(255.0 * shared::srgb_of_component(std::clamp(share, 0.0, 1.0))));
    return {value, value, value};
}

Canvas::Canvas(ImageSize size, const Rgb8& background)
    : image_{size, std::vector<std::uint8_t>(std::size_t{4} * size.width * size.height, 255)} {
    BURIN_CHECK(size.width > 0 && size.height > 0);
    fill(0, 0, width(), height(), background);
}

void Canvas::fill(int x, int y, int fill_width, int fill_height, const Rgb8& colour) {
    const int x1 = std::min(x + fill_width, width()), y1 = std::min(y + fill_height, height());
    const int x0 = std::max(x, 0);
    for (int row = std::max(y, 0); row < y1; ++row) {
        for (int column = x0; column < x1; ++column) {
            const std::size_t at =
                4 * (static_cast<std::size_t>(row) * image_.size.width + static_cast<std::size_t>(column));
            std::ranges::copy(colour, image_.rgba.begin() + static_cast<std::ptrdiff_t>(at));
        }
    }
}

void Canvas::frame(int x, int y, int frame_width, int frame_height, int thickness, const Rgb8& colour) {
    fill(x, y, frame_width, thickness, colour);
    fill(x, y + frame_height - thickness, frame_width, thickness, colour);
    fill(x, y, thickness, frame_height, colour);
    fill(x + frame_width - thickness, y, thickness, frame_height, colour);
}

void Canvas::ring(double centre_x, double centre_y, double radius, double thickness, Units units, const Rgb8& colour) {
    const double reach_x = (radius + thickness) / units.per_pixel_x, reach_y = (radius + thickness) / units.per_pixel_y;
    const int x0 = std::max(0, static_cast<int>(centre_x - reach_x)),
              y0 = std::max(0, static_cast<int>(centre_y - reach_y));
    const int x1 = std::min(width(), static_cast<int>(centre_x + reach_x) + 1);
    const int y1 = std::min(height(), static_cast<int>(centre_y + reach_y) + 1);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const double distance =
                std::hypot((x + 0.5 - centre_x) * units.per_pixel_x, (y + 0.5 - centre_y) * units.per_pixel_y);
            if (std::abs(distance - radius) <= 0.5 * thickness) fill(x, y, 1, 1, colour);
        }
    }
}

int Canvas::text_width(std::string_view words, int scale) {
    return words.empty() ? 0 : scale * (kAdvance * static_cast<int>(words.size()) - 1);
}

void Canvas::text(int x, int y, int scale, std::string_view words, const Rgb8& colour) {
    for (const char letter : words) {
        const auto glyph = std::ranges::find(kGlyphs, letter, &Glyph::letter);
        for (int row = 0; glyph != kGlyphs.end() && row < 7; ++row) {
            for (int column = 0; column < 5; ++column) {
                if ((glyph->rows[static_cast<std::size_t>(row)] >> (4 - column) & 1) == 0) continue;
                fill(x + column * scale, y + row * scale, scale, scale, colour);
            }
        }
        x += kAdvance * scale;
    }
}

void Canvas::text_centred(int middle_x, int y, int scale, std::string_view words, const Rgb8& colour) {
    text(middle_x - text_width(words, scale) / 2, y, scale, words, colour);
}

}  // namespace burin::renderer

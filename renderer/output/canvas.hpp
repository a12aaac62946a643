// SPDX-License-Identifier: MIT
// Draws rectangles, rings and capital letters into an image on the CPU, without antialiasing. Everything is clipped to
// the image. Thread: as the image.
#pragma once

#include <array>
#include <string_view>

#include "base/image.hpp"

namespace burin::renderer {

using Rgb8 = std::array<std::uint8_t, 3>;  // sRGB

// Returns the grey whose light is this share of white's, 0 to 1.
[[nodiscard]] Rgb8 grey_of_light(double share);

class Canvas {
public:
    // size is at least one pixel each way (BURIN_CHECK).
    Canvas(ImageSize size, const Rgb8& background);

    void fill(int x, int y, int width, int height, const Rgb8& colour);
    void frame(int x, int y, int width, int height, int thickness, const Rgb8& colour);
    // Draws the pixels whose centres lie within half a thickness of the
    // ring. Radius and thickness are in units, the centre is in pixels.
    struct Units {
        double per_pixel_x = 1.0, per_pixel_y = 1.0;
    };
    void ring(double centre_x, double centre_y, double radius, double thickness, Units units, const Rgb8& colour);
    // Draws A to Z, digits and . : - / % in cells of 5 x 7 dots, each `scale` pixels wide, with one column between
    // them; other characters stay blank.
    void text(int x, int y, int scale, std::string_view words, const Rgb8& colour);
    void text_centred(int middle_x, int y, int scale, std::string_view words, const Rgb8& colour);
    [[nodiscard]] static int text_width(std::string_view words, int scale);
    [[nodiscard]] static constexpr int text_height(int scale) { return 7 * scale; }

    [[nodiscard]] int width() const { return static_cast<int>(image_.size.width); }
    [[nodiscard]] int height() const { return static_cast<int>(image_.size.height); }
    [[nodiscard]] Image take() { return std::move(image_); }

private:
    Image image_;
};

}  // namespace burin::renderer

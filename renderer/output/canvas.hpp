// SPDX-License-Identifier: MIT
// Drawing into a picture by plain code: rectangles, rings and capitals, without smooth edges. Everything is clipped to the
// picture. Thread: as the picture.
#pragma once

#include <array>
#include <string_view>

#include "renderer/image.hpp"

namespace burin {

using Rgb8 = std::array<std::uint8_t, 3>;  // sRGB

// A grey that gives this share of white's light, 0 to 1.
[[nodiscard]] Rgb8 grey_of_light(double share);

class Canvas {
public:
    // At least one pixel each way (BURIN_CHECK).
    Canvas(ImageSize size, const Rgb8& background);

    void fill(int x, int y, int width, int height, const Rgb8& colour);
    void frame(int x, int y, int width, int height, int thickness, const Rgb8& colour);
    // Pixels whose centres lie within half a thickness of the ring; all lengths in units, places in pixels.
    struct Units {
        double per_pixel_x = 1.0, per_pixel_y = 1.0;
    };
    void ring(double centre_x, double centre_y, double radius, double thickness, Units units, const Rgb8& colour);
    // A to Z, digits and . : - / % of 5 x 7 pixels, each `scale` wide, one column between them; others stay blank.
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

}  // namespace burin

// SPDX-License-Identifier: MIT
#include "renderer/output/test_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "renderer/output/canvas.hpp"

namespace burin::renderer {

namespace {

constexpr Rgb8 kBlack{0, 0, 0}, kWhite{255, 255, 255}, kMiddleGrey{119, 119, 119}, kSoftWhite{214, 214, 214};
constexpr Rgb8 kLeftColour{40, 90, 200}, kRightColour{200, 60, 40};

constexpr std::array<double, 6> kGhostingSteps{0.005, 0.01, 0.02, 0.04, 0.08, 0.16};

struct Pair {
    Canvas left, right;
    Canvas& of(wall::Eye eye) { return eye == wall::Eye::left ? left : right; }
    template <typename Draw>
    void both(const Draw& draw) {
        draw(left);
        draw(right);
    }
    StereoImage take() {
        StereoImage images;
        images.left = left.take();
        images.right = right.take();
        return images;
    }
};

// Returns the largest whole scale at which the words fit a width and a height; at least 1.
int scale_for(std::string_view words, int width, int height) {
    const int by_width = width / std::max(1, Canvas::text_width(words, 1));
    return std::max(1, std::min(by_width, height / Canvas::text_height(1)));
}

void draw_letter(Canvas& c, wall::Eye eye) {
    const bool is_left = eye == wall::Eye::left;
    const Rgb8& colour = is_left ? kLeftColour : kRightColour;
    const int middle = is_left ? c.width() / 4 : c.width() - c.width() / 4;
    const char* word = is_left ? "LEFT" : "RIGHT";
    const int scale = scale_for("L", c.width() / 4, 4 * c.height() / 10);
    c.text_centred(middle, c.height() / 10, scale, is_left ? "L" : "R", colour);
    const int small = scale_for("RIGHT", c.width() / 3, c.height() / 10);
    c.text_centred(middle, 6 * c.height() / 10, small, word, colour);
    // Level bars in the left eye, upright ones in the right: they make a lattice only for those who see with both eyes.
    const int x = c.width() / 2 - c.width() / 20, size = c.width() / 10, bar = std::max(1, size / 7);
    for (int i = 0; i < 7; i += 2) {
        if (is_left) {
            c.fill(x, c.height() / 10 + i * bar, 7 * bar, bar, colour);
        } else {
            c.fill(x + i * bar, c.height() / 10, bar, 7 * bar, colour);
        }
    }
}

StereoImage eye_order(const PatternScreen& screen) {
    Pair pair{Canvas(screen.pixels, kMiddleGrey), Canvas(screen.pixels, kMiddleGrey)};
    const int w = pair.left.width(), h = pair.left.height();
    draw_letter(pair.left, wall::Eye::left);
    draw_letter(pair.right, wall::Eye::right);
    // Crossed parallax: what appears further right to the left eye stands before the screen.
    const int shift = std::max(1, w / 100);
    for (const wall::Eye eye : {wall::Eye::left, wall::Eye::right}) {
        const int offset = eye == wall::Eye::left ? shift : -shift;
        Canvas& c = pair.of(eye);
        c.frame(w / 2 - w / 12 + offset, 4 * h / 10, w / 6, h / 6, std::max(1, w / 200), kSoftWhite);
        const std::string_view words = "IN FRONT";
        const int scale = scale_for(words, w / 8, h / 20);
        c.text_centred(w / 2 + offset, 4 * h / 10 + h / 12 - Canvas::text_height(scale) / 2, scale, words, kSoftWhite);
    }
    pair.both([&](Canvas& c) {
        const std::string_view words = "CLOSE ONE EYE: THE OTHER READS ITS OWN NAME";
        c.text_centred(w / 2, 8 * h / 10, scale_for(words, 9 * w / 10, h / 20), words, kSoftWhite);
        c.frame(0, 0, w, h, 1, kSoftWhite);
    });
    return pair.take();
}

std::string percent_text(double share) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), share < 0.01 ? "%.1f%%" : "%.0f%%", 100.0 * share);
    return text.data();
}

// Draws one eye's row of pairs, between two heights.
void ghosting_row(Pair& pair, wall::Eye eye, int top, int height) {
    const int w = pair.left.width(), steps = static_cast<int>(kGhostingSteps.size());
    const std::string title =
        std::string(eye == wall::Eye::left ? "LEFT" : "RIGHT") + " EYE: CLOSE THE OTHER. WHERE ARE BOTH HALVES ALIKE";
    pair.both([&](Canvas& c) {
        c.fill(0, top, w, height, kBlack);
        c.text_centred(w / 2, top + height / 20, scale_for(title, 9 * w / 10, height / 10), title, grey_of_light(0.1));
    });
    const int cell = w / steps, patch_width = 3 * cell / 8, patch_top = top + 3 * height / 10,
              patch_height = 4 * height / 10;
    for (int i = 0; i < steps; ++i) {
        const double share = kGhostingSteps[static_cast<std::size_t>(i)];
        const int x = i * cell + cell / 8;
        pair.of(eye).fill(x, patch_top, patch_width, patch_height, grey_of_light(share));
        pair.of(wall::other(eye)).fill(x + patch_width, patch_top, patch_width, patch_height, kWhite);
        const std::string label = percent_text(share);
        pair.both([&](Canvas& c) {
            c.text_centred(x + patch_width, patch_top + patch_height + height / 20,
                           scale_for("0.5%", patch_width, height / 8), label, grey_of_light(0.1));
        });
    }
}

// Patches that must look the same whichever eye they are in: black, white and grey against each other in the two eyes.
void crossed_patches(Pair& pair, int top, int height) {
    constexpr std::array<std::array<Rgb8, 2>, 4> kCrossed{
        {{kBlack, kWhite}, {kWhite, kBlack}, {kMiddleGrey, kWhite}, {kWhite, kMiddleGrey}}};
    const int w = pair.left.width(), cell = w / 4;
    for (int i = 0; i < 4; ++i) {
        pair.left.fill(i * cell + cell / 8, top, 3 * cell / 4, height, kCrossed[static_cast<std::size_t>(i)][0]);
        pair.right.fill(i * cell + cell / 8, top, 3 * cell / 4, height, kCrossed[static_cast<std::size_t>(i)][1]);
    }
}

StereoImage ghosting(const PatternScreen& screen) {
    Pair pair{Canvas(screen.pixels, kMiddleGrey), Canvas(screen.pixels, kMiddleGrey)};
    const int h = pair.left.height();
    ghosting_row(pair, wall::Eye::left, 0, 4 * h / 10);
    crossed_patches(pair, 4 * h / 10 + h / 20, h / 10);
    ghosting_row(pair, wall::Eye::right, 6 * h / 10, h - 6 * h / 10);
    return pair.take();
}

// Returns the pixel at a position given in millimetres from the middle of the screen.
int pixel_at(double from_middle_mm, double side_mm, int side_px) {
    return static_cast<int>(std::floor((0.5 + from_middle_mm / side_mm) * side_px));
}

void draw_grid(Canvas& c, const PatternScreen& s, double spacing_mm) {
    for (int k = 0; k * spacing_mm < 0.5 * std::max(s.width_mm, s.height_mm); ++k) {
        const Rgb8& colour = k == 0 ? kWhite : (k % 5 == 0 ? kSoftWhite : grey_of_light(0.4));
        for (const double at_mm : {k * spacing_mm, -k * spacing_mm}) {
            if (std::abs(at_mm) < 0.5 * s.width_mm)
                c.fill(pixel_at(at_mm, s.width_mm, c.width()), 0, 1, c.height(), colour);
            if (std::abs(at_mm) < 0.5 * s.height_mm)
                c.fill(0, pixel_at(at_mm, s.height_mm, c.height()), c.width(), 1, colour);
        }
    }
}

// Circles around whole squares: a large one in the middle and
// one towards each corner. Ovals reveal a wrong aspect ratio.
void draw_circles(Canvas& c, const PatternScreen& s, double spacing_mm) {
    const Canvas::Units mm{s.width_mm / c.width(), s.height_mm / c.height()};
    const double thickness_mm = 1.5 * std::max(mm.per_pixel_x, mm.per_pixel_y);
    const double whole_height = std::floor(0.5 * s.height_mm / spacing_mm),
                 whole_width = std::floor(0.5 * s.width_mm / spacing_mm);
    const double small_mm = spacing_mm;
    c.ring(0.5 * c.width(), 0.5 * c.height(), std::min(whole_width, whole_height) * spacing_mm, thickness_mm, mm,
           kWhite);
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            const double x_mm = x * (whole_width - 1.0) * spacing_mm, y_mm = y * (whole_height - 1.0) * spacing_mm;
            c.ring((0.5 + x_mm / s.width_mm) * c.width(), (0.5 + y_mm / s.height_mm) * c.height(), small_mm,
                   thickness_mm, mm, kWhite);
        }
    }
}

// Draws the outermost pixels, and a square of a different colour in each corner.
void draw_border(Canvas& c) {
    const int side = std::max(3, std::min(c.width(), c.height()) / 24);
    c.fill(1, 1, side, side, {220, 40, 40});
    c.fill(c.width() - 1 - side, 1, side, side, {40, 200, 40});
    c.fill(1, c.height() - 1 - side, side, side, {60, 90, 230});
    c.fill(c.width() - 1 - side, c.height() - 1 - side, side, side, {220, 200, 40});
    c.frame(0, 0, c.width(), c.height(), 1, kWhite);
}

StereoImage geometry(const PatternScreen& screen) {
    Pair pair{Canvas(screen.pixels, kMiddleGrey), Canvas(screen.pixels, kMiddleGrey)};
    const double spacing_mm = grid_spacing_mm(screen);
    std::array<char, 64> label{};
    std::snprintf(label.data(), label.size(), "SQUARES OF %g MM", spacing_mm);
    pair.both([&](Canvas& c) {
        draw_grid(c, screen, spacing_mm);
        draw_circles(c, screen, spacing_mm);
        const int scale = scale_for(label.data(), c.width() / 3, c.height() / 24);
        const int text_width = Canvas::text_width(label.data(), scale), text_height = Canvas::text_height(scale);
        c.fill(c.width() / 2 - text_width / 2 - scale, c.height() / 2 - 3 * text_height - scale, text_width + 2 * scale,
               text_height + 2 * scale, kMiddleGrey);
        c.text_centred(c.width() / 2, c.height() / 2 - 3 * text_height, scale, label.data(), kWhite);
        c.text_centred(c.width() / 2, 2 * scale, scale, "TOP", kWhite);
        draw_border(c);
    });
    return pair.take();
}

}  // namespace

std::span<const double> ghosting_steps() { return kGhostingSteps; }

double grid_spacing_mm(const PatternScreen& screen) {
    const double most = std::min(screen.width_mm, screen.height_mm) / 6.0;
    const double decade = std::pow(10.0, std::floor(std::log10(most) + 1e-9));
    for (const double step : {5.0, 2.0}) {
        if (step * decade <= most * (1.0 + 1e-9)) return step * decade;
    }
    return decade;
}

StereoImage draw_test_pattern(wall::TestPattern pattern, const PatternScreen& screen) {
    BURIN_CHECK(pattern != wall::TestPattern::none && screen.width_mm > 0.0 && screen.height_mm > 0.0);
    switch (pattern) {
        case wall::TestPattern::ghosting: return ghosting(screen);
        case wall::TestPattern::geometry: return geometry(screen);
        default: return eye_order(screen);
    }
}

}  // namespace burin::renderer

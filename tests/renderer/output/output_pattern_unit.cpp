// SPDX-License-Identifier: MIT
// The test patterns' claims, measured on their pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "picture/png.hpp"
#include "renderer/output/canvas.hpp"
#include "renderer/output/test_pattern.hpp"
#include "shaders/shared/srgb.h"
#include "tests/renderer/output/output_pictures.hpp"

namespace burin::renderer {

namespace {

const PatternScreen kWall{{1440, 1080}, 3048.0, 2286.0};

bool is_white(const std::uint8_t* p) { return p[0] == 255 && p[1] == 255 && p[2] == 255; }

// To look at: BURIN_PATTERN_FOLDER=some/folder.
void save(const StereoImage& images, const std::string& name) {
    if (const char* folder = std::getenv("BURIN_PATTERN_FOLDER")) {
        EXPECT_TRUE(picture::write_png(std::string(folder) + "/" + name + ".png", side_by_side(images)));
    }
}

}  // namespace

TEST(GeometryPattern, HasSquaresOfTheSizeItNames) {
    const StereoImage images = draw_test_pattern(wall::TestPattern::geometry, kWall);
    save(images, "geometry");
    const double spacing_mm = grid_spacing_mm(kWall);
    EXPECT_EQ(spacing_mm, 200.0);
    // Along a row and a column that cross neither circle nor words: the lines' places, by their pixels.
    const std::uint32_t row = 1080 / 2 + static_cast<std::uint32_t>(0.5 * 200.0 / 2286.0 * 1080);
    const std::uint8_t* ground = images.left.pixel(1440 / 2 + 30, row);
    std::vector<std::uint32_t> columns;
    for (std::uint32_t x = 1440 / 2; x < 1440 / 2 + 450; ++x) {
        if (images.left.pixel(x, row)[0] != ground[0]) columns.push_back(x);
    }
    ASSERT_EQ(columns.size(), 5u);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const double exact = 1440.0 * (0.5 + static_cast<double>(k) * spacing_mm / 3048.0);
        EXPECT_NEAR(columns[k] + 0.5, exact, 0.51);
    }
}

TEST(GeometryPattern, MarksTheOutermostPixelsAndIsTheSameForBothEyes) {
    for (const ImageSize size : {ImageSize{640, 480}, ImageSize{101, 77}, ImageSize{3, 2}, ImageSize{1, 1}}) {
        const StereoImage images = draw_test_pattern(wall::TestPattern::geometry, {size, 400.0, 300.0});
        EXPECT_EQ(images.left.rgba, images.right.rgba);
        for (const std::uint32_t x : {0u, size.width / 2, size.width - 1}) {
            EXPECT_TRUE(is_white(images.left.pixel(x, 0)));
            EXPECT_TRUE(is_white(images.left.pixel(x, size.height - 1)));
        }
        for (const std::uint32_t y : {0u, size.height / 2, size.height - 1}) {
            EXPECT_TRUE(is_white(images.left.pixel(0, y)));
            EXPECT_TRUE(is_white(images.left.pixel(size.width - 1, y)));
        }
    }
}

TEST(GeometryPattern, ChoosesRoundSpacings) {
    EXPECT_EQ(grid_spacing_mm({{1, 1}, 520.0, 320.0}), 50.0);
    EXPECT_EQ(grid_spacing_mm({{1, 1}, 300.0, 120.0}), 20.0);
    EXPECT_EQ(grid_spacing_mm({{1, 1}, 60.0, 60.0}), 10.0);
}

TEST(GhostingPattern, PairsAKnownGreyOfOneEyeWithWhiteOfTheOther) {
    const StereoImage images = draw_test_pattern(wall::TestPattern::ghosting, kWall);
    save(images, "ghosting");
    const auto steps = ghosting_steps();
    const std::uint32_t cell = 1440 / static_cast<std::uint32_t>(steps.size());
    for (const wall::Eye eye : {wall::Eye::left, wall::Eye::right}) {
        const Image &own = eye == wall::Eye::left ? images.left : images.right,
                    &others = eye == wall::Eye::left ? images.right : images.left;
        const std::uint32_t y = eye == wall::Eye::left ? 1080 * 2 / 10 : 1080 * 8 / 10;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const std::uint32_t grey_x = static_cast<std::uint32_t>(i) * cell + cell / 4,
                                white_x = grey_x + 3 * cell / 8;
            EXPECT_NEAR(shared::linear_of_component(*own.pixel(grey_x, y) / 255.0), steps[i], 0.0035)
                << "half a step of sRGB";
            EXPECT_EQ(*others.pixel(grey_x, y), 0);
            EXPECT_EQ(*own.pixel(white_x, y), 0);
            EXPECT_TRUE(is_white(others.pixel(white_x, y)));
        }
    }
}

TEST(EyeOrderPattern, GivesEachEyeItsOwnLetterAndAFrameBeforeTheScreen) {
    const StereoImage images = draw_test_pattern(wall::TestPattern::eye_order, kWall);
    save(images, "eye_order");
    // The letters: left half of the left picture, right half of the right one, nothing in the other.
    const auto coloured = [](const Image& image, std::uint32_t x0, std::uint32_t x1) {
        int count = 0;
        for (std::uint32_t y = 0; y < image.size.height; ++y) {
            for (std::uint32_t x = x0; x < x1; ++x)
                count += std::abs(int{image.pixel(x, y)[0]} - int{image.pixel(x, y)[2]}) > 60;
        }
        return count;
    };
    EXPECT_GT(coloured(images.left, 0, 600), 10000);
    EXPECT_EQ(coloured(images.left, 840, 1440), 0);
    EXPECT_GT(coloured(images.right, 840, 1440), 10000);
    EXPECT_EQ(coloured(images.right, 0, 600), 0);
    // The frame's left side, on a row through it that meets nothing else.
    const auto first_bright = [](const Image& image) {
        const std::uint32_t y = 1080 * 4 / 10 + 12;
        for (std::uint32_t x = 500; x < 900; ++x) {
            if (image.pixel(x, y)[0] > 200 && image.pixel(x, y)[2] > 200) return x;
        }
        return 0u;
    };
    EXPECT_GT(first_bright(images.left), first_bright(images.right)) << "crossed parallax stands before the screen";
}

TEST(TestPattern, IsDrawnAtAnySize) {
    for (const wall::TestPattern pattern :
         {wall::TestPattern::eye_order, wall::TestPattern::ghosting, wall::TestPattern::geometry}) {
        for (const ImageSize size : {ImageSize{1, 1}, ImageSize{1, 50}, ImageSize{50, 1}, ImageSize{13, 7}}) {
            const StereoImage images = draw_test_pattern(pattern, {size, 1000.0, 10.0});
            EXPECT_EQ(images.left.rgba.size(), std::size_t{4} * size.width * size.height);
            EXPECT_EQ(images.right.rgba.size(), images.left.rgba.size());
        }
    }
}

TEST(Canvas, ClipsWhatReachesBeyondIt) {
    Canvas canvas({8, 8}, {0, 0, 0});
    canvas.fill(-5, -5, 7, 7, {255, 0, 0});
    canvas.fill(6, 6, 100, 100, {0, 255, 0});
    canvas.ring(100.0, 100.0, 300.0, 4.0, {}, {0, 0, 255});
    canvas.text(5, 5, 3, "A?Z", {9, 9, 9});
    const Image image = canvas.take();
    EXPECT_EQ(image.pixel(1, 1)[0], 255);
    EXPECT_EQ(image.pixel(2, 2)[0], 0);
    EXPECT_EQ(image.pixel(7, 7)[1], 255);
}

}  // namespace burin::renderer

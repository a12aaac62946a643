// SPDX-License-Identifier: MIT
// Which pixel of which eye is shown where, against closed forms.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>

#include "picture/png.hpp"
#include "renderer/output/compose.hpp"
#include "shaders/shared/output_rules.h"
#include "tests/renderer/output/output_pictures.hpp"

namespace burin::renderer {

namespace {

// The source of a target's pixel: the eye (0, 1; -1: none) and its pixel. Written from the modes' definitions.
struct Source {
    int eye = 0;
    std::uint32_t x = 0, y = 0;
};

Source source_of(wall::StereoMode mode, std::uint32_t x, std::uint32_t y, ImageSize eye, int monitor_x, int monitor_y) {
    const auto odd = [](long n) { return static_cast<int>(((n % 2) + 2) % 2); };
    switch (mode) {
        case wall::StereoMode::side_by_side: return {x < eye.width ? 0 : 1, x < eye.width ? x : x - eye.width, y};
        case wall::StereoMode::top_bottom: return {y < eye.height ? 0 : 1, x, y < eye.height ? y : y - eye.height};
        case wall::StereoMode::row_interlaced: return {odd(long{monitor_y} + y), x, y};
        case wall::StereoMode::column_interlaced: return {odd(long{monitor_x} + x), x, y};
        case wall::StereoMode::checkerboard: return {odd(long{monitor_x} + x + monitor_y + y), x, y};
        case wall::StereoMode::right: return {1, x, y};
        default: return {0, x, y};
    }
}

constexpr std::array kCopying{wall::StereoMode::side_by_side,   wall::StereoMode::top_bottom,
                              wall::StereoMode::row_interlaced, wall::StereoMode::column_interlaced,
                              wall::StereoMode::checkerboard,   wall::StereoMode::left,
                              wall::StereoMode::right,          wall::StereoMode::mono};

bool is_red(const std::uint8_t* p) { return p[0] == 255 && p[1] == 0; }
bool is_green(const std::uint8_t* p) { return p[0] == 0 && p[1] == 255; }

}  // namespace

TEST(StereoMode, IsFoundByItsNameHoweverItIsWritten) {
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        const auto found = wall::parse_stereo_mode(file_name_of(mode));
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, mode);
        EXPECT_FALSE(wall::title_of(mode).empty() || wall::purpose_of(mode).empty());
    }
    EXPECT_EQ(wall::parse_stereo_mode("Side-by-Side HALF").value(), wall::StereoMode::side_by_side_half);
    EXPECT_EQ(wall::parse_test_pattern("eye order").value(), wall::TestPattern::eye_order);
}

TEST(StereoMode, SuggestsTheNearestNameForAnUnknownOne) {
    const auto refused = wall::parse_stereo_mode("anaglif_red_cyan");
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("anaglif_red_cyan")) << refused.error().line();
    EXPECT_TRUE(refused.error().remedy.contains("did you mean anaglyph_red_cyan?")) << refused.error().line();
    EXPECT_FALSE(wall::parse_stereo_mode(""));
    EXPECT_FALSE(wall::parse_test_pattern(std::string(1 << 16, 'x')));
}

RC_GTEST_PROP(StereoMode, FillsAWindowPixelForPixelSaveForAnOddRest, ()) {
    const auto mode = wall::stereo_modes()[*rc::gen::inRange<std::size_t>(0, wall::kStereoModes)];
    const ImageSize window{*rc::gen::inRange(2u, 5000u), *rc::gen::inRange(2u, 5000u)};
    const ImageSize back = wall::output_size(mode, wall::eye_size(mode, window));
    RC_ASSERT(back.width <= window.width && window.width - back.width <= 1);
    RC_ASSERT(back.height <= window.height && window.height - back.height <= 1);
}

// Each copying mode, pixel by pixel, for eyes of even and odd sizes, at any place of the monitor, with and without
// exchanged eyes.
RC_GTEST_PROP(Compose, CopiesEachPixelFromItsPlaceInItsEye, ()) {
    wall::OutputSettings settings;
    settings.mode = kCopying[*rc::gen::inRange<std::size_t>(0, kCopying.size())];
    settings.swap_eyes = *rc::gen::arbitrary<bool>();
    settings.first_eye = *rc::gen::arbitrary<bool>() ? wall::Eye::left : wall::Eye::right;
    const ImageSize eye{*rc::gen::inRange(1u, 24u), *rc::gen::inRange(1u, 24u)};
    wall::OutputPlace place{.size = wall::output_size(settings.mode, eye)};
    place.monitor_x = *rc::gen::inRange(-9, 9);
    place.monitor_y = *rc::gen::inRange(-9, 9);
    const Image shown = compose(map_of(eye, wall::Eye::left), map_of(eye, wall::Eye::right), settings, place);
    const bool by_turns = wall::needs_of(settings.mode).monitor_pixels;
    const bool exchanged = (settings.swap_eyes && settings.mode != wall::StereoMode::mono) !=
                           (by_turns && settings.first_eye == wall::Eye::right);
    for (std::uint32_t y = 0; y < place.size.height; ++y) {
        for (std::uint32_t x = 0; x < place.size.width; ++x) {
            Source from = source_of(settings.mode, x, y, eye, place.monitor_x, place.monitor_y);
            if (exchanged) from.eye = 1 - from.eye;
            const std::uint8_t* p = shown.pixel(x, y);
            RC_ASSERT(p[0] == from.x);
            RC_ASSERT(p[1] == from.y);
            RC_ASSERT(p[2] == (from.eye == 0 ? 60 : 200));
        }
    }
}

TEST(Compose, GivesEachEyeItsShareOfThePixels) {
    const ImageSize eye{7, 5};
    const Image red = filled(eye, 255, 0, 0), green = filled(eye, 0, 255, 0);
    const auto count = [&](wall::StereoMode mode, const wall::OutputPlace& place) {
        wall::OutputSettings settings;
        settings.mode = mode;
        const Image shown = compose(red, green, settings, place);
        std::array<int, 3> pixels{};  // left's, right's, nobody's
        for (std::size_t i = 0; i < shown.rgba.size(); i += 4) {
            const std::uint8_t* p = shown.rgba.data() + i;
            ++pixels[is_red(p) ? 0 : is_green(p) ? 1 : 2];
        }
        return pixels;
    };
    using Shares = std::array<int, 3>;
    EXPECT_EQ(count(wall::StereoMode::side_by_side, {.size = {14, 5}}), (Shares{35, 35, 0}));
    EXPECT_EQ(count(wall::StereoMode::side_by_side_half, {.size = eye}), (Shares{15, 15, 5}))
        << "the odd column is nobody's";
    EXPECT_EQ(count(wall::StereoMode::top_bottom, {.size = {7, 10}}), (Shares{35, 35, 0}));
    EXPECT_EQ(count(wall::StereoMode::top_bottom_half, {.size = eye}), (Shares{14, 14, 7}));
    EXPECT_EQ(count(wall::StereoMode::row_interlaced, {.size = eye}), (Shares{21, 14, 0}));
    EXPECT_EQ(count(wall::StereoMode::row_interlaced, {.size = eye, .monitor_y = 3}), (Shares{14, 21, 0}));
    EXPECT_EQ(count(wall::StereoMode::column_interlaced, {.size = eye}), (Shares{20, 15, 0}));
    EXPECT_EQ(count(wall::StereoMode::checkerboard, {.size = eye}), (Shares{18, 17, 0}));
    EXPECT_EQ(count(wall::StereoMode::left, {.size = eye}), (Shares{35, 0, 0}));
    EXPECT_EQ(count(wall::StereoMode::right, {.size = eye}), (Shares{0, 35, 0}));
    EXPECT_EQ(count(wall::StereoMode::mono, {.size = eye}), (Shares{35, 0, 0}));
    for (const wall::StereoMode mode :
         {wall::StereoMode::frame_sequential, wall::StereoMode::two_layers, wall::StereoMode::two_windows}) {
        EXPECT_EQ(count(mode, {.size = eye, .eye = wall::Eye::left}), (Shares{35, 0, 0}));
        EXPECT_EQ(count(mode, {.size = eye, .eye = wall::Eye::right}), (Shares{0, 35, 0}));
    }
}

// Half the light of white is the sRGB value 188; averaging the values would give 128.
TEST(Compose, AveragesHalfSizesInLinearLight) {
    Image columns = filled({8, 6}, 0, 0, 0), rows = columns;
    for (std::uint32_t y = 0; y < 6; ++y) {
        for (std::uint32_t x = 0; x < 8; ++x) {
            for (int c = 0; c < 3; ++c) {
                pixel_of(columns, x, y)[c] = x % 2 == 0 ? 0 : 255;
                pixel_of(rows, x, y)[c] = y % 2 == 0 ? 0 : 255;
            }
        }
    }
    wall::OutputSettings settings;
    settings.mode = wall::StereoMode::side_by_side_half;
    EXPECT_EQ(greatest_difference(compose(columns, columns, settings, {.size = {8, 6}}), filled({8, 6}, 188, 188, 188)),
              0);
    settings.mode = wall::StereoMode::top_bottom_half;
    EXPECT_EQ(greatest_difference(compose(rows, rows, settings, {.size = {8, 6}}), filled({8, 6}, 188, 188, 188)), 0);
}

TEST(Anaglyph, KeepsWhiteAndGreysNeutralAndSendsEachEyeToItsOwnColours) {
    for (const wall::StereoMode mode : {wall::StereoMode::anaglyph_red_cyan, wall::StereoMode::anaglyph_green_magenta,
                                        wall::StereoMode::anaglyph_amber_blue}) {
        const Vec3 left = shared::anaglyph_light(mode_number(mode), 0, Vec3{1.0}),
                   right = shared::anaglyph_light(mode_number(mode), 1, Vec3{1.0});
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(left[c] + right[c], 1.0, 0.002) << file_name_of(mode);
        // Of one eye's white, what falls on the other eye's filter colours is small.
        for (int c = 0; c < 3; ++c) EXPECT_TRUE((left[c] > 0.9) != (right[c] > 0.9)) << file_name_of(mode) << c;
        EXPECT_EQ(left.x > 0.9, mode != wall::StereoMode::anaglyph_green_magenta);
        EXPECT_EQ(left.y > 0.9, mode != wall::StereoMode::anaglyph_red_cyan);
        EXPECT_LT(left.z, 0.0);
    }
}

TEST(Anaglyph, ShowsTheLeftEyesLightThroughTheLeftFilterAlsoWhenExchanged) {
    wall::OutputSettings settings;
    settings.mode = wall::StereoMode::anaglyph_red_cyan;
    const Image white = filled({1, 1}, 255, 255, 255), black = filled({1, 1}, 0, 0, 0);
    const Image left = compose(white, black, settings, {.size = {1, 1}});
    EXPECT_EQ(*left.pixel(0, 0), 255);  // 1.05 of red, cut off
    EXPECT_EQ(left.pixel(0, 0)[1], 0);
    settings.swap_eyes = true;
    EXPECT_EQ(compose(black, white, settings, {.size = {1, 1}}).rgba, left.rgba);
    settings.swap_eyes = false;
    const Image grey = filled({1, 1}, 128, 128, 128);
    EXPECT_LE(greatest_difference(compose(grey, grey, settings, {.size = {1, 1}}), grey), 1);
}

TEST(Compose, PutsTheOverlayAtZeroParallaxInEveryMode) {
    const ImageSize eye{12, 8};
    Overlay panel{filled({4, 3}, 90, 180, 30), {2, 4, 4, 3}};
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        const Image both_drawn = [&] {
            Image left = map_of(eye, wall::Eye::left), right = map_of(eye, wall::Eye::right);
            for (std::uint32_t y = 4; y < 7; ++y) {
                for (std::uint32_t x = 2; x < 6; ++x) {
                    std::copy_n(panel.image.rgba.data(), 3, pixel_of(left, x, y));
                    std::copy_n(panel.image.rgba.data(), 3, pixel_of(right, x, y));
                }
            }
            return compose(left, right, settings, {.size = wall::output_size(mode, eye), .eye = wall::Eye::right});
        }();
        const Image overlaid = compose(map_of(eye, wall::Eye::left), map_of(eye, wall::Eye::right), settings,
                                       {.size = wall::output_size(mode, eye), .eye = wall::Eye::right}, &panel);
        EXPECT_EQ(greatest_difference(both_drawn, overlaid), 0) << file_name_of(mode);
    }
}

// Half covered by white, in both ways of giving colours: linear light, and the toolkit's values.
TEST(Compose, MixesAClearOverlayInLinearLight) {
    const Image black = filled({1, 1}, 0, 0, 0);
    wall::OutputSettings settings;
    Overlay panel{{{1, 1}, {188, 188, 188, 128}}, {0, 0, 1, 1}};
    EXPECT_NEAR(*compose(black, black, settings, {.size = {1, 1}}, &panel).pixel(0, 0), 188, 0);
    panel = {{{1, 1}, {128, 128, 128, 128}}, {0, 0, 1, 1}, wall::OverlayColour::coded};
    EXPECT_NEAR(*compose(black, black, settings, {.size = {1, 1}}, &panel).pixel(0, 0), 188, 1);
    panel.place.x = -1;
    EXPECT_EQ(*compose(black, black, settings, {.size = {1, 1}}, &panel).pixel(0, 0), 0) << "outside the picture";
}

RC_GTEST_PROP(ChangedParts, HoldEveryPixelThatChangesAndDoNotOverlap, ()) {
    wall::OutputSettings settings;
    settings.mode = wall::stereo_modes()[*rc::gen::inRange<std::size_t>(0, wall::kStereoModes)];
    const ImageSize eye{*rc::gen::inRange(1u, 20u), *rc::gen::inRange(1u, 20u)};
    wall::OutputPlace place{.size = wall::output_size(settings.mode, eye)};
    if (*rc::gen::inRange(0, 5) == 0) place.size.width += 1;
    PixelRect changed{*rc::gen::inRange(0u, eye.width), *rc::gen::inRange(0u, eye.height), 0, 0};
    changed.width = *rc::gen::inRange(0u, eye.width - changed.x + 1);
    changed.height = *rc::gen::inRange(0u, eye.height - changed.y + 1);
    Image left = filled(eye, 10, 10, 10), right = filled(eye, 20, 20, 20);
    const Image before = compose(left, right, settings, place);
    for (std::uint32_t y = changed.y; y < changed.y + changed.height; ++y) {
        for (std::uint32_t x = changed.x; x < changed.x + changed.width; ++x) {
            std::fill_n(pixel_of(left, x, y), 3, std::uint8_t{255});
            std::fill_n(pixel_of(right, x, y), 3, std::uint8_t{240});
        }
    }
    const Image after = compose(left, right, settings, place);
    const ChangedParts parts = changed_parts(changed, eye, settings, place);
    const bool exact = place.size.width == wall::output_size(settings.mode, eye).width && place.size.width > 1 &&
                       place.size.height > 1;
    for (std::uint32_t y = 0; y < place.size.height; ++y) {
        for (std::uint32_t x = 0; x < place.size.width; ++x) {
            int inside = 0;
            for (int i = 0; i < parts.count; ++i) {
                const PixelRect& p = parts.parts[i];
                RC_ASSERT(p.x + p.width <= place.size.width && p.y + p.height <= place.size.height);
                inside += x >= p.x && x < p.x + p.width && y >= p.y && y < p.y + p.height ? 1 : 0;
            }
            const bool differs = !std::equal(before.pixel(x, y), before.pixel(x, y) + 3, after.pixel(x, y));
            RC_ASSERT(inside <= 1);
            RC_ASSERT(inside == 1 || !differs);
            RC_ASSERT(!exact || differs == (inside == 1));
        }
    }
}

// The kept pictures are a look at what the tests above have shown to be right; they catch what nobody thought of.
// BURIN_WRITE_GOLDEN=1 writes them anew.
TEST(Compose, GivesTheKeptPictures) {
    const ImageSize eye{33, 21};
    const Image left = marked_gradient(eye, wall::Eye::left), right = marked_gradient(eye, wall::Eye::right);
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        const Image shown = compose_all(left, right, settings);
        if (std::getenv("BURIN_WRITE_GOLDEN") != nullptr) {
            ASSERT_TRUE(picture::write_png(golden_path(mode), shown));
        }
        EXPECT_EQ(greatest_difference(read_png(golden_path(mode)), shown), 0) << file_name_of(mode);
    }
}

}  // namespace burin::renderer

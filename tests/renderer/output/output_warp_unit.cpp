// SPDX-License-Identifier: MIT
// Homographies and edge blending, against closed forms.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "renderer/output/compose.hpp"
#include "shaders/shared/srgb.h"
#include "tests/renderer/output/output_pictures.hpp"
#include "wall/output_settings.hpp"

namespace burin::renderer {

namespace {

const std::array<Vec2, 4> kPicture{Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}};

// A quad that leans no more than a quarter of the picture at each corner.
std::array<Vec2, 4> some_quad() {
    std::array<Vec2, 4> corners = kPicture;
    for (Vec2& p : corners) {
        p.x += 0.01 * *rc::gen::inRange(-20, 20);
        p.y += 0.01 * *rc::gen::inRange(-20, 20);
    }
    return corners;
}

}  // namespace

RC_GTEST_PROP(Homography, LeadsEachCornerOfTheOutputToThePicturesOwn, ()) {
    const auto corners = some_quad();
    const auto h = wall::homography_onto(corners);
    RC_ASSERT(h.has_value());
    for (std::size_t i = 0; i < 4; ++i) RC_ASSERT(glm::length(wall::warped(*h, corners[i]) - kPicture[i]) < 1e-9);
    // Straight lines stay straight: the diagonals meet where the picture's do.
    const Vec2 a = corners[0], b = corners[2] - a, c = corners[1], d = corners[3] - c;
    const double t = ((c.x - a.x) * d.y - (c.y - a.y) * d.x) / (b.x * d.y - b.y * d.x);
    RC_ASSERT(glm::length(wall::warped(*h, a + t * b) - Vec2{0.5, 0.5}) < 1e-9);
}

TEST(Homography, RefusesCornersThatMakeNoPicture) {
    EXPECT_FALSE(wall::homography_onto({Vec2{0, 0}, Vec2{0.5, 0}, Vec2{1, 0}, Vec2{0, 1}})) << "three on a line";
    EXPECT_FALSE(wall::homography_onto({Vec2{0, 0}, Vec2{1, 1}, Vec2{1, 0}, Vec2{0, 1}})) << "crossed over";
    EXPECT_FALSE(wall::homography_onto({Vec2{1, 0}, Vec2{0, 0}, Vec2{0, 1}, Vec2{1, 1}})) << "mirrored";
    EXPECT_FALSE(wall::homography_onto({Vec2{0, 0}, Vec2{0, 0}, Vec2{0, 0}, Vec2{0, 0}}));
    EXPECT_FALSE(wall::homography_onto({Vec2{NAN, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}));
    EXPECT_FALSE(wall::homography_from_rows({{{1, 0, 0}, {2, 0, 0}, {0, 0, 1}}}));
}

TEST(Homography, FromRowsIsTheWayBack) {
    // out = (0.5 x + 0.25, 0.5 y + 0.125): the picture at half size.
    const auto h = wall::homography_from_rows({{{0.5, 0, 0.25}, {0, 0.5, 0.125}, {0, 0, 1}}});
    ASSERT_TRUE(h);
    EXPECT_LT(glm::length(wall::warped(*h, {0.25, 0.125}) - Vec2{0, 0}), 1e-12);
    EXPECT_LT(glm::length(wall::warped(*h, {0.75, 0.625}) - Vec2{1, 1}), 1e-12);
    const auto scaled = wall::homography_from_rows({{{-0.5, 0, -0.25}, {0, -0.5, -0.125}, {0, 0, -1}}});
    ASSERT_TRUE(scaled) << "a factor of the whole matrix means nothing, its sign neither";
    EXPECT_LT(glm::length(wall::warped(*scaled, {0.75, 0.625}) - Vec2{1, 1}), 1e-12);
}

TEST(Homography, OfNothingCopiesThePicture) {
    const ImageSize eye{17, 11};
    const Image left = map_of(eye, wall::Eye::left), right = map_of(eye, wall::Eye::right);
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        const wall::OutputPlace place{.size = wall::output_size(mode, eye)};
        const bool halves_odd =
            mode == wall::StereoMode::side_by_side_half || mode == wall::StereoMode::top_bottom_half;
        if (halves_odd) continue;  // there the plain way leaves the odd column out, and the warp fits it in
        const Image plain = compose(left, right, settings, place);
        settings.homography = wall::Homography(1.0);
        EXPECT_EQ(greatest_difference(compose(left, right, settings, place), plain), 0) << file_name_of(mode);
    }
}

// A picture whose light rises evenly to the right and downwards: what lies between pixels is then known, and with it
// what a warped picture shows at each place.
TEST(Homography, ShowsEachPlaceOfThePictureWhereItBelongs) {
    const ImageSize eye{64, 48};
    Image picture = filled(eye, 0, 0, 0);
    const auto byte_of = [](double light) {
        return static_cast<std::uint8_t>(std::lround(255.0 * shared::srgb_of_component(light)));
    };
    for (std::uint32_t y = 0; y < eye.height; ++y) {
        for (std::uint32_t x = 0; x < eye.width; ++x) {
            pixel_of(picture, x, y)[0] = byte_of(0.2 + 0.6 * (x + 0.5) / eye.width);
            pixel_of(picture, x, y)[1] = byte_of(0.2 + 0.6 * (y + 0.5) / eye.height);
        }
    }
    const std::array<Vec2, 4> corners{Vec2{0.1, 0.05}, Vec2{0.95, 0.15}, Vec2{0.85, 0.9}, Vec2{0.05, 0.95}};
    wall::OutputSettings settings;
    settings.homography = wall::homography_onto(corners).value();
    const Image shown = compose(picture, picture, settings, {.size = {80, 60}});
    int compared = 0;
    for (std::uint32_t y = 0; y < 60; ++y) {
        for (std::uint32_t x = 0; x < 80; ++x) {
            const Vec2 uv = wall::warped(*settings.homography, {(x + 0.5) / 80, (y + 0.5) / 60});
            const double edge = std::min({uv.x, 1.0 - uv.x, uv.y, 1.0 - uv.y});
            if (edge < -0.02) {
                EXPECT_EQ(*shown.pixel(x, y), 0);
            } else if (edge > 0.02) {
                EXPECT_NEAR(*shown.pixel(x, y), 255.0 * shared::srgb_of_component(0.2 + 0.6 * uv.x), 1.0);
                EXPECT_NEAR(shown.pixel(x, y)[1], 255.0 * shared::srgb_of_component(0.2 + 0.6 * uv.y), 1.0);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 2000);
}

RC_GTEST_PROP(EdgeFade, OfTwoNeighboursAddsUpToOne, ()) {
    const double width = 0.01 * *rc::gen::inRange(1, 100), t = 0.001 * *rc::gen::inRange(0, 1001);
    wall::EdgeFade left, right;
    left.right = width;
    right.left = width;
    left.curve = right.curve = 1.0 + 0.1 * *rc::gen::inRange(0, 40);
    // The same place of the wall on both pictures: the overlap is the last of one and the first of the other.
    const double share =
        wall::light_share(left, {1.0 - width + t * width, 0.5}) + wall::light_share(right, {t * width, 0.5});
    RC_ASSERT(std::abs(share - 1.0) < 1e-9);
}

TEST(EdgeFade, GivesConstantLightOverTwoOverlappingProjectors) {
    constexpr std::uint32_t kWidth = 100, kOverlap = 20;
    const Image grey = filled({kWidth, 4}, 180, 180, 180);
    for (const double gamma : {1.8, 2.2, 2.6}) {
        wall::OutputSettings left, right;
        left.blend.gamma = right.blend.gamma = gamma;
        left.blend.right = right.blend.left = static_cast<double>(kOverlap) / kWidth;
        const wall::OutputPlace place{.size = {kWidth, 4}};
        const Image first = compose(grey, grey, left, place), second = compose(grey, grey, right, place);
        const auto light = [gamma](std::uint8_t value) { return std::pow(value / 255.0, gamma); };
        const double whole = light(180), one_step = light(181) - whole;
        for (std::uint32_t i = 0; i < kOverlap; ++i) {
            const double sum = light(*first.pixel(kWidth - kOverlap + i, 1)) + light(*second.pixel(i, 1));
            EXPECT_NEAR(sum, whole, 1.01 * one_step) << "half a step of each projector's values";
        }
        EXPECT_EQ(*first.pixel(0, 0), 180);
        EXPECT_EQ(*second.pixel(kWidth - 1, 0), 180);
    }
}

TEST(OutputSettings, WithImpossibleNumbersAreRefusedByName) {
    wall::OutputSettings settings;
    EXPECT_TRUE(wall::check_output(settings));
    settings.blend.left = 1.5;
    EXPECT_TRUE(wall::check_output(settings).error().line().contains("edge blend"));
    settings.blend.left = NAN;
    EXPECT_FALSE(wall::check_output(settings));
    settings.blend = {};
    settings.blend.gamma = 0.0;
    EXPECT_FALSE(wall::check_output(settings));
    settings.blend = {};
    settings.homography = wall::Homography(0.0);
    EXPECT_TRUE(wall::check_output(settings).error().line().contains("homography"));
}

}  // namespace burin::renderer

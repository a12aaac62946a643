// SPDX-License-Identifier: MIT
// Are things where they belong, in both eyes?
#include <algorithm>

#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {

namespace {

// How far the line from the eye through a point passes outside a ball, in metres at the ball's distance; negative: it
// hits.
double miss(const Vec3& eye, const Vec3& through, const Vec3& center, double radius) {
    const Vec3 d = glm::normalize(through - eye);
    const Vec3 to = center - eye;
    return glm::length(to - glm::dot(to, d) * d) - radius;
}

double mean_x(const Image& image, const std::uint8_t* background) {
    double sum = 0.0, count = 0.0;
    for (std::uint32_t y = 0; y < image.size.height; ++y) {
        for (std::uint32_t x = 0; x < image.size.width; ++x) {
            if (same_colour(image.pixel(x, y), background, 2)) continue;
            sum += x;
            count += 1.0;
        }
    }
    return sum / count;
}

int count_reddish(const Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) count += image.rgba[i] > 2 * image.rgba[i + 1] + 20 ? 1 : 0;
    return count;
}

}  // namespace

using Geometry = PictureTest;

// A ball seen from an eye covers exactly the pixels whose lines of sight hit it, an ellipse on the screen; only pixels
// whose centre lies within one pixel of its outline may differ. Everywhere else is the untouched background.
TEST_F(Geometry, ABallCoversThePixelsThatTheClosedFormPredictsInBothEyes) {
    picture::Picture picture = bare_scene();
    picture.viewer.head_world = {{0.09, 0.24, 0.5}, glm::angleAxis(0.2, Vec3{0, 0, 1})};
    // Placed by all three transforms at once.
    picture.world_from_object = {{-0.05, 0.12, 0.02}, glm::angleAxis(0.7, glm::normalize(Vec3{1, 2, 3})), 2.0};
    picture.lattice_origin_object = {0.01, 0.005, -0.02};
    const Vec3 center_patch{0.004, 0.003, 0.012};
    set(0, ball_surface(center_patch, 0.025, kGrey, 128));
    const Vec3 center = picture.world_from_object * (picture.lattice_origin_object + center_patch);
    constexpr double radius = 0.05;

    const StereoImage pictures = render(picture);
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    const std::array<std::pair<const Image*, Vec3>, 2> views{
        {{&pictures.left, eyes.left_world}, {&pictures.right, eyes.right_world}}};
    for (const auto& [image, eye] : views) {
        const std::uint8_t* background = image->pixel(kTestSize.width - 1, 0);
        int covered = 0;
        for (std::uint32_t y = 0; y < kTestSize.height; ++y) {
            for (std::uint32_t x = 0; x < kTestSize.width; ++x) {
                const double outside = miss(eye, pixel_centre_world(picture, x, y), center, radius);
                if (std::abs(outside) < pixel_m(picture)) continue;
                const bool drawn = !same_colour(image->pixel(x, y), background);
                ASSERT_EQ(drawn, outside < 0.0) << "at " << x << ", " << y;
                covered += drawn ? 1 : 0;
            }
        }
        EXPECT_GT(covered, 2000);
    }
}

TEST_F(Geometry, WhatStandsInFrontOfTheWallHasCrossedDisparity) {
    picture::Picture picture = bare_scene();
    for (const double z : {0.15, -0.3}) {
        set(0, ball_surface({0.0, 0.15, z}, 0.02));
        const StereoImage pictures = render(picture);
        const std::uint8_t* background = pictures.left.pixel(0, 0);
        const double disparity_px = mean_x(pictures.right, background) - mean_x(pictures.left, background);
        const double predicted_m = -picture.viewer.interpupillary_m * z / (0.6 - z);
        EXPECT_NEAR(disparity_px, predicted_m / pixel_m(picture), 0.25) << "at z = " << z;
    }
}

// A ball before the screen, at several places from its middle to its edge: its parallax is what the formula of
// shaders/shared/parallax_fade.h leaves of it, worked out here from where lines of sight meet the screen.
TEST_F(Geometry, ParallaxFadesTowardsTheEdges) {
    constexpr double kBand = 0.4, kZ = 0.1;
    for (const double strength : {0.5, 1.0}) {
        for (const double x : {0.0, 0.06, 0.11, 0.13, 0.15}) {
            picture::Picture picture = bare_scene();
            picture.edge_fade_band = kBand;
            const Vec3 center{x, 0.15, kZ};
            set(0, ball_surface(center, 0.005));
            const auto disparity_px = [&](double fade) {
                picture.edge_fade = fade;
                const StereoImage pictures = render(picture);
                const std::uint8_t* background = pictures.left.pixel(0, 0);
                return mean_x(pictures.right, background) - mean_x(pictures.left, background);
            };
            const wall::Eyes eyes = wall::eyes_of(picture.viewer);
            const auto seen = [&](const Vec3& eye) {
                return 2.0 * point_on_screen(picture.screen, eye, center).x / picture.wall.width_m - 1.0;
            };
            const double m = seen(middle_of(eyes)), d = 0.5 * (seen(eyes.right_world) - seen(eyes.left_world));
            const double band = std::max(kBand, 1.125 * std::abs(d));
            const double t = std::clamp((band - (1.0 - std::abs(m))) / band, 0.0, 1.0);
            const double left_m = (1.0 - strength * t * t * (3.0 - 2.0 * t)) * 2.0 * d * 0.5 * picture.wall.width_m;
            // The outline of a ball aside is an ellipse around a place a little farther out, in whole pixels.
            constexpr double kTolerance_px = 0.35;
            EXPECT_NEAR(disparity_px(strength), left_m / pixel_m(picture), kTolerance_px) << strength << " at " << x;
            EXPECT_NEAR(disparity_px(0.0), d * picture.wall.width_m / pixel_m(picture), kTolerance_px);
        }
    }
}

// Everything but the room is behind the screen or away from its edges: the fade changes no bit.
TEST_F(Geometry, TheFadeOfParallaxLeavesTheMiddleAndWhatIsBehindTheScreenAsTheyAre) {
    picture::Picture picture = bare_scene();
    picture.show_grid = picture.show_wall_frame = true;
    picture.tool = {0.012, {0.02, 0.16, 0.05}, {0.9, 0.4, 0.1}, {{0.02, 0.16, 0.05}, Quat{1, 0, 0, 0}}, true};
    picture.box = {{{0.0, 0.15, 0.02}, Quat{1, 0, 0, 0}}, {0.06, 0.05, 0.04}, {0.3, 0.6, 0.8}, true};
    picture.bubble = {{-0.18, 0.1, -0.1}, 0.03, {0.4, 0.7, 0.6}, true};
    set(0, ball_surface({0.0, 0.15, 0.0}, 0.04));
    set(1, ball_surface({0.19, 0.15, -0.1}, 0.07));
    const StereoImage without = render(picture);
    picture.edge_fade = 1.0;
    const StereoImage with = render(picture);
    EXPECT_TRUE(with.left.rgba == without.left.rgba);
    EXPECT_TRUE(with.right.rgba == without.right.rgba);
}

TEST_F(Geometry, RefusesAFadeThatIsNone) {
    picture::Picture picture = bare_scene();
    for (const double strength : {-0.1, 1.1, std::nan("")}) {
        picture.edge_fade = strength;
        EXPECT_FALSE(renderer().render(picture)) << strength;
    }
}

// A block narrower than the distance of the eyes, straight ahead and long: its left side is seen by the left eye alone.
TEST_F(Geometry, TheLeftEyeSeesTheLeftSide) {
    picture::Picture picture = bare_scene();
    Surface cube;
    const double h = 0.02, depth = 0.15;
    cube.quad({0, 0.15, depth}, {h, 0, 0}, {0, h, 0}, kGreen);
    cube.quad({-h, 0.15, 0}, {0, 0, depth}, {0, h, 0}, kRed);    // faces -x
    cube.quad({h, 0.15, 0}, {0, 0, -depth}, {0, h, 0}, kGreen);  // faces +x
    set(0, cube);
    const StereoImage pictures = render(picture);
    EXPECT_GT(count_reddish(pictures.left), 10);
    EXPECT_EQ(count_reddish(pictures.right), 0);
}

// Both eyes at the place of the left one: the left picture must not depend on where the other eye is.
TEST_F(Geometry, TwoViewsInOnePassEqualViewsDrawnAlone) {
    picture::Picture picture = bare_scene();
    picture.show_grid = picture.show_wall_frame = true;
    picture.tool = {0.015, {0.03, 0.2, 0.05}, {0.9, 0.4, 0.1}, {{0.03, 0.2, 0.05}, Quat{1, 0, 0, 0}}, true};
    set(0, ball_surface({0.0, 0.15, 0.0}, 0.06));
    const StereoImage both = render(picture);
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    picture.viewer.interpupillary_m = 0.0;
    picture.viewer.head_world.position_m = eyes.left_world;
    EXPECT_TRUE(render(picture).left.rgba == both.left.rgba);
    EXPECT_TRUE(render(picture).right.rgba == both.left.rgba);
    picture.viewer.head_world.position_m = eyes.right_world;
    EXPECT_TRUE(render(picture).left.rgba == both.right.rgba);
    EXPECT_FALSE(both.left.rgba == both.right.rgba);
}

// From a few centimetres before the eyes to far behind the wall.
TEST_F(Geometry, NothingIsClipped) {
    picture::Picture picture = bare_scene();
    for (const double z : {0.53, 0.3, -2.0, -30.0}) {
        const double radius = 0.03 * (0.6 - z);  // the same angle at every distance
        set(0, ball_surface({0.0, 0.15, z}, radius));
        const StereoImage pictures = render(picture);
        const Vec3 eye = wall::eyes_of(picture.viewer).left_world;
        for (std::uint32_t y = 0; y < kTestSize.height; ++y) {
            for (std::uint32_t x = 0; x < kTestSize.width; ++x) {
                const double angle = miss(eye, pixel_centre_world(picture, x, y), {0.0, 0.15, z}, radius) / (0.6 - z);
                if (std::abs(angle) < 0.004) continue;
                const bool drawn = !same_colour(pictures.left.pixel(x, y), pictures.left.pixel(0, 0));
                ASSERT_EQ(drawn, angle < 0.0) << "at " << x << ", " << y << ", z = " << z;
            }
        }
    }
}

TEST_F(Geometry, RefusesAViewerBehindTheScreen) {
    picture::Picture picture = bare_scene();
    picture.viewer.head_world.position_m.z = -0.5;
    const auto refused = renderer().render(picture);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("behind"), std::string::npos) << refused.error().line();
}

TEST_F(Geometry, RefusesPicturesWithoutPixelsOrTooLarge) {
    EXPECT_FALSE(Renderer::create(device(), {0, 100}));
    EXPECT_FALSE(Renderer::create(device(), {100, 100000}));
}

}  // namespace burin::renderer

// SPDX-License-Identifier: MIT
// Do things look as they should: colour, edges, transparency, shadow?
#include <algorithm>
#include <set>

#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {

namespace {

double linear_value(double srgb) {
    const double c = srgb / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double srgb_value(double linear) {
    return 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

// The pixel at which the left eye sees a point.
std::array<std::uint32_t, 2> pixel_of(const picture::Picture& picture, const Vec3& p) {
    const Vec2 at = point_on_screen(picture.screen, wall::eyes_of(picture.viewer).left_world, p);
    return {static_cast<std::uint32_t>(at.x / picture.wall.width_m * kTestSize.width),
            static_cast<std::uint32_t>((1.0 - at.y / picture.wall.height_m) * kTestSize.height)};
}

const std::uint8_t* seen_at(const Image& image, const picture::Picture& picture, const Vec3& p) {
    const auto [x, y] = pixel_of(picture, p);
    return image.pixel(x, y);
}

bool in_view(const picture::Picture& picture, const Vec3& p) {
    const Vec2 at = point_on_screen(picture.screen, wall::eyes_of(picture.viewer).left_world, p);
    return at.x > 0.0 && at.y > 0.0 && at.x < picture.wall.width_m && at.y < picture.wall.height_m;
}

int brightness(const std::uint8_t* pixel) { return pixel[0] + pixel[1] + pixel[2]; }

}  // namespace

using Picture = PictureTest;

TEST_F(Picture, OfNothingIsTheBackgroundColour) {
    picture::Picture picture = bare_scene();
    picture.background = {0.5, 0.25, 0.75};
    const StereoImage pictures = render(picture);
    for (const Image* image : {&pictures.left, &pictures.right}) {
        for (std::size_t i = 0; i < image->rgba.size(); i += 4) {
            ASSERT_NEAR(image->rgba[i], 0.50 * 255, 1.0);
            ASSERT_NEAR(image->rgba[i + 1], 0.25 * 255, 1.0);
            ASSERT_NEAR(image->rgba[i + 2], 0.75 * 255, 1.0);
            ASSERT_EQ(image->rgba[i + 3], 255);
        }
    }
}

TEST_F(Picture, HasTheSameBitsEachTime) {
    picture::Picture picture = bare_scene();
    picture.show_grid = picture.show_wall_frame = true;
    picture.box = {{{0.05, 0.15, 0.03}, Quat{1, 0, 0, 0}}, {0.12, 0.1, 0.08}, {0.3, 0.6, 0.8}, true};
    picture.tool = {0.012, {0.05, 0.2, 0.03}, {0.9, 0.4, 0.1}, {{0.05, 0.2, 0.03}, Quat{1, 0, 0, 0}}, true};
    picture.pedestal = {{0, 0.05, -0.1}, 0.08, {0.7, 0.7, 0.7}, true};
    const Surface ball = ball_surface({0, 0.15, -0.1}, 0.07);
    set(0, ball);
    const StereoImage first = render(picture), second = render(picture);
    EXPECT_TRUE(first.left.rgba == second.left.rgba);
    EXPECT_TRUE(first.right.rgba == second.right.rgba);
    auto fresh = Renderer::create(device(), kTestSize);
    ASSERT_TRUE(fresh);
    fresh->surface().set_patch(5, ball.vertices, ball.indices);
    const auto third = fresh->render(picture);
    ASSERT_TRUE(third);
    EXPECT_TRUE(first.left.rgba == third->left.rgba);
    EXPECT_TRUE(first.right.rgba == third->right.rgba);
}

// Four samples a pixel give three steps between the two sides of an edge, and light is mixed linearly: a half covered
// pixel of black and white is sRGB 188, not 128.
TEST_F(Picture, HasSmoothEdgesMixedInLinearLight) {
    picture::Picture picture = bare_scene();
    picture.background = {0.8, 0.8, 0.8};
    Surface slanted;
    const Quat turn = glm::angleAxis(0.15, Vec3{0, 0, 1});
    slanted.quad({0, 0.15, 0}, turn * Vec3{0.1, 0, 0}, turn * Vec3{0, 0.08, 0}, kBlack);
    set(0, slanted);
    const StereoImage pictures = render(picture);
    const double inside = *seen_at(pictures.left, picture, {0, 0.15, 0}), outside = *pictures.left.pixel(0, 0);
    ASSERT_GT(outside - inside, 80.0);
    std::array<int, 3> steps{};
    int strays = 0;
    for (std::size_t i = 0; i < pictures.left.rgba.size(); i += 4) {
        const double value = pictures.left.rgba[i];
        if (value < inside + 25.0 || value > outside - 8.0) continue;  // a side, not an edge
        bool found = false;
        for (std::size_t step = 0; step < 3 && !found; ++step) {
            const double covered = static_cast<double>(step + 1) / 4.0;
            found =
                std::abs(value - srgb_value(covered * linear_value(inside) + (1.0 - covered) * linear_value(outside))) <
                6.0;
            if (found) ++steps[step];
        }
        strays += found ? 0 : 1;
    }
    for (const int count : steps) EXPECT_GT(count, 20);
    EXPECT_LT(strays, 5);
}

TEST_F(Picture, ShowsTheToolBeforeAndNotBehindTheSurface) {
    picture::Picture picture = bare_scene();
    Surface plate;
    plate.quad({0, 0.15, 0}, {0.1, 0, 0}, {0, 0.1, 0}, kGreen);
    set(0, plate);
    const Vec3 left_eye = wall::eyes_of(picture.viewer).left_world;
    for (const double z : {0.05, -0.05}) {
        picture.tool = {
            0.02, {0.0, 0.15, z}, {1.0, 0.0, 0.0}, {{0, 0.15, z}, glm::angleAxis(1.2, Vec3{1, 0, 0})}, true};
        const StereoImage pictures = render(picture);
        const Vec3 facing = picture.tool.center_world + 0.02 * glm::normalize(left_eye - picture.tool.center_world);
        const std::uint8_t* pixel = seen_at(pictures.left, picture, facing);
        EXPECT_EQ(pixel[0] > pixel[1] + 40, z > 0.0) << "red " << int{pixel[0]} << " green " << int{pixel[1]};
    }
}

TEST_F(Picture, ShowsThroughTheWorkspaceBox) {
    picture::Picture picture = bare_scene();
    picture.background = {0.5, 0.5, 0.5};
    const Vec3 in_box{0.05, 0.15, 0.0}, beside_tool{0.02, 0.13, 0.0};
    picture.tool = {0.012, in_box, {1.0, 0.3, 0.0}, {in_box, glm::angleAxis(-1.5, Vec3{1, 0, 0})}, true};  // shaft up
    const StereoImage without = render(picture);
    picture.box = {{{0.05, 0.15, 0.0}, Quat{1, 0, 0, 0}}, {0.12, 0.12, 0.06}, {0.1, 0.4, 1.0}, true};
    const StereoImage with = render(picture);

    const std::uint8_t* tinted = seen_at(with.left, picture, beside_tool);
    const std::uint8_t* plain = seen_at(without.left, picture, beside_tool);
    EXPECT_GT(int{tinted[2]} - int{tinted[0]}, int{plain[2]} - int{plain[0]} + 8) << "the box tints what is behind it";
    EXPECT_GT(tinted[0], 60) << "but does not hide it";
    const std::uint8_t* tool = seen_at(with.left, picture, in_box);
    EXPECT_GT(int{tool[0]} - int{tool[2]}, 40) << "the tool inside stays recognisable";
    EXPECT_FALSE(same_colour(tool, seen_at(without.left, picture, in_box), 2)) << "seen through the near face";
    EXPECT_TRUE(same_colour(with.left.pixel(2, 2), without.left.pixel(2, 2))) << "outside nothing changes";
}

TEST_F(Picture, ABoxOfEdgesAloneTintsNothingWithin) {
    picture::Picture picture = bare_scene();
    const Vec3 middle{0.05, 0.15, 0.0}, size{0.12, 0.12, 0.06};
    const StereoImage without = render(picture);
    picture.box = {{middle, Quat{1, 0, 0, 0}}, size, {0.1, 0.4, 1.0}, true, 0.0};
    const StereoImage with = render(picture);
    EXPECT_TRUE(same_colour(seen_at(with.left, picture, middle), seen_at(without.left, picture, middle)));
    const Vec3 edge = middle + 0.5 * size * Vec3(0, 1, 1);
    EXPECT_FALSE(same_colour(seen_at(with.left, picture, edge), seen_at(without.left, picture, edge), 20));
}

TEST_F(Picture, ShowsTheProposedBoxBesideTheWorkspacesOwn) {
    picture::Picture picture = bare_scene();
    picture.background = {0.5, 0.5, 0.5};
    const Vec3 own{-0.08, 0.15, 0.0}, proposed{0.08, 0.15, 0.0}, size{0.1, 0.1, 0.06};
    picture.box = {{own, Quat{1, 0, 0, 0}}, size, {0.2, 0.4, 1.0}, true};
    const StereoImage without = render(picture);
    picture.proposed_box.center_world.position_m = proposed;
    picture.proposed_box.size_m = size;
    picture.proposed_box.visible = true;
    const StereoImage with = render(picture);
    EXPECT_TRUE(same_colour(seen_at(with.left, picture, own), seen_at(without.left, picture, own)));
    const std::uint8_t* tinted = seen_at(with.left, picture, proposed);
    EXPECT_GT(int{tinted[0]} - int{tinted[2]}, 15) << "of its own, warm colour";
    EXPECT_GT(tinted[2], 60) << "clear";
}

TEST_F(Picture, ShowsTheBubbleAsAClearBallDenserAtItsRim) {
    picture::Picture picture = bare_scene();
    picture.background = {0.5, 0.5, 0.5};
    const StereoImage without = render(picture);
    picture.bubble = {{0.0, 0.15, 0.0}, 0.05, {0.0, 0.8, 0.3}, true};
    const StereoImage with = render(picture);
    const auto tint = [&](const Vec3& p) {
        const std::uint8_t *now = seen_at(with.left, picture, p), *before = seen_at(without.left, picture, p);
        return (int{now[1]} - int{now[0]}) - (int{before[1]} - int{before[0]});
    };
    const int middle = tint({0.0, 0.15, 0.0}), rim = tint({0.0, 0.15 + 0.047, 0.0}), outside = tint({0.0, 0.22, 0.0});
    EXPECT_GT(middle, 10);
    EXPECT_GT(rim, middle + 5);
    EXPECT_EQ(outside, 0);
}

TEST_F(Picture, TheToolsShadowFallsOnTheSurfaceBelowAndJoinsItAtContact) {
    picture::Picture picture = bare_scene();
    picture.viewer.head_world.position_m = {0.0, 0.45, 0.5};
    Surface table;
    table.quad({0, 0.02, -0.05}, {0.15, 0, 0}, {0, 0, -0.12}, kGrey);
    set(0, table);
    const StereoImage without = render(picture);
    std::array<double, 2> nearest_m{};
    for (std::size_t i = 0; i < 2; ++i) {
        const double height_m = i == 0 ? 0.016 : 0.06;  // touching, lifted
        const Vec3 center{0.0, 0.02 + height_m, 0.0};
        picture.tool = {0.016, center, {0.9, 0.5, 0.1}, {center, glm::angleAxis(-1.5, Vec3{1, 0, 0})}, true};
        const StereoImage with = render(picture);
        int darkened = 0;
        double nearest = 1.0;
        for (double x = -0.12; x <= 0.12; x += 0.001) {
            for (double z = -0.15; z <= 0.05; z += 0.001) {
                const Vec3 p{x, 0.02, z};
                if (!in_view(picture, p)) continue;
                const int before = brightness(seen_at(without.left, picture, p));
                const int after = brightness(seen_at(with.left, picture, p));
                if (after < before - 60) {
                    ++darkened;
                    nearest = std::min(nearest, glm::length(Vec2{x, z}));
                }
            }
        }
        EXPECT_GT(darkened, 100);
        nearest_m[i] = nearest;
    }
    EXPECT_LT(nearest_m[0], 0.016) << "at contact the shadow begins under the tool";
}

TEST_F(Picture, StaysMidGreyInTheRoom) {
    picture::Picture picture;  // the wall and the room as they come
    const StereoImage pictures = render(picture);
    for (const Image* image : {&pictures.left, &pictures.right}) {
        for (std::size_t i = 0; i < image->rgba.size(); i += 4) {
            ASSERT_GT(image->rgba[i], 30) << "black leaks least but shows ghosts most";
            ASSERT_LT(image->rgba[i], 200);
        }
    }
}

}  // namespace burin::renderer

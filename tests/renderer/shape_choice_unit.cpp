// SPDX-License-Identifier: MIT
#include "renderer/frame/scene_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "wall/wall.hpp"

namespace burin::renderer {
namespace {

constexpr ImageSize kSize{640, 480};

picture::Picture scene_with_tool(double radius_m) {
    picture::Picture picture;
    picture.wall = {0.4, 0.3};
    picture.screen = wall::screen_of(picture.wall);
    picture.viewer.head_world.position_m = {0.0, 0.15, 0.6};
    picture.show_wall_frame = false;
    picture.tool = {radius_m, {0.1, 0.2, 0.0}, {0.8, 0.4, 0.2}, {{0.1, 0.2, 0.0}, Quat{1, 0, 0, 0}}, true};
    return picture;
}

}  // namespace

TEST(BallFor, LiesOffByAQuarterOfAPixelAtMost) {
    const picture::Primitives primitives = picture::make_primitives();
    for (double radius_px = 0.5; radius_px < 400.0; radius_px *= 1.3) {
        const picture::PrimitiveRange& ball = ball_for(primitives, radius_px);
        if (ball == primitives.balls.back()) continue;
        for (std::uint32_t i = 0; i < ball.index_count; i += 6) {  // a quad's: a, b, c, a, c, d
            const auto at = [&](std::uint32_t corner) {
                const auto& v = primitives.vertices[primitives.indices[ball.first_index + i + corner]];
                return Vec3(v.x, v.y, v.z);
            };
            for (const std::uint32_t corner : {0u, 1u}) {
                const double off = 1.0 - 0.5 * glm::length(at(corner) + at(corner + 1));
                ASSERT_LE(off * radius_px, 0.25 + 1e-4) << radius_px;
            }
        }
    }
    EXPECT_EQ(ball_for(primitives, 1e6), primitives.balls.back());
    EXPECT_LT(ball_for(primitives, 5.0).index_count, 2000u);
}

TEST(ShapesIn, AreThoseThatThePartShows) {
    const picture::Primitives primitives = picture::make_primitives();
    const picture::Picture picture = scene_with_tool(0.01);
    const auto sum = [](const picture::Shapes& s) { return s.solid.size() + s.tool.size() + s.hidden.size(); };
    const std::size_t all = sum(picture::shapes_of(picture, primitives));
    ASSERT_GE(all, 3u) << "a ball, its stylus, and its outline";
    const auto count = [&](const PixelRect& part, const Savings& savings) {
        const ShownShapes shown = shapes_in(part, picture, primitives, kSize, savings);
        EXPECT_EQ(sum(shown.shapes) + shown.left_out, all);
        return sum(shown.shapes);
    };
    EXPECT_EQ(count(all_of(kSize), {}), all);
    EXPECT_EQ(count({460, 140, 40, 40}, {}), all);  // about (0.1 m, 0.2 m)
    EXPECT_EQ(count({0, 300, 100, 100}, {}), 0u);
    Savings none;
    none.cull_beside = false;
    EXPECT_EQ(count({0, 300, 100, 100}, none), all);
}

TEST(ShapesIn, BallsAreTheSameWhateverThePart) {
    const picture::Primitives primitives = picture::make_primitives();
    for (const double radius_m : {0.002, 0.01, 0.3}) {
        picture::Picture picture = scene_with_tool(radius_m);
        picture.tool.center_world.x = 0.2;  // cut by the picture's edge
        const picture::PrimitiveRange whole =
            shapes_in(all_of(kSize), picture, primitives, kSize, {}).shapes.tool.front().range;
        const picture::PrimitiveRange part =
            shapes_in({600, 140, 40, 40}, picture, primitives, kSize, {}).shapes.tool.front().range;
        EXPECT_EQ(whole, part);
        EXPECT_EQ(whole == primitives.balls.back(), radius_m > 0.1);
    }
}

}  // namespace burin::renderer

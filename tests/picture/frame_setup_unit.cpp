// SPDX-License-Identifier: MIT
#include "picture/frame_setup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "wall/projection.hpp"

namespace burin::picture {

namespace {

Workpiece ball_at(const Vec3& center, double radius) { return {{center, radius}, {center, radius}}; }

double depth_of(const Picture& picture, const Workpiece& workpiece, const Vec3& p) {
    const shared::FrameUniforms frame = frame_uniforms(picture, workpiece);
    const glm::vec4 clip = frame.clip_from_world[0] * glm::vec4(glm::vec3(p), 1.0f);
    return static_cast<double>(clip.z / clip.w);
}

}  // namespace

TEST(DepthRange, CutsNothingOffNeitherNearTheEyeNorFarBehindTheWall) {
    Picture picture;
    picture.viewer.head_world.position_m = {0, 1.5, 1.0};
    for (const Vec3& center :
         {Vec3{0, 1.5, 0.93}, Vec3{0, 1.5, 0.5}, Vec3{0, 1, 0}, Vec3{0, 1, -10}, Vec3{0, 1, -400}}) {
        const Workpiece workpiece = ball_at(center, 0.02);
        for (const double side : {-0.02, 0.02}) {
            const double depth = depth_of(picture, workpiece, center + Vec3{0, 0, side});
            EXPECT_GT(depth, 0.0) << center.z;
            EXPECT_LT(depth, 1.0) << center.z;
        }
    }
}

TEST(DepthRange, HoldsTheWorkspacesBoxesAndBubbleToo) {
    Picture picture;
    picture.viewer.head_world.position_m = {0, 1.5, 1.0};
    const Vec3 close{0.0, 1.5, 0.97};
    const double away = depth_of(picture, Workpiece{}, close);
    EXPECT_LT(away, 0.0) << "nearer than what is usually there: cut off";
    const auto shown = [&](auto&& show) {
        Picture with = picture;
        show(with);
        return depth_of(with, Workpiece{}, close) > 0.0;
    };
    EXPECT_TRUE(shown([&](Picture& s) { s.box = {{close, Quat{1, 0, 0, 0}}, Vec3(0.02), {}, true}; }));
    EXPECT_TRUE(shown([&](Picture& s) { s.proposed_box = {{close, Quat{1, 0, 0, 0}}, Vec3(0.02), {}, true}; }));
    EXPECT_TRUE(shown([&](Picture& s) { s.bubble = {close, 0.01, {}, true}; }));
    EXPECT_TRUE(shown([&](Picture& s) { s.contact = {close, {0, 1, 0}, {0, 1, 0}, 0.02, {}, true}; }));
}

TEST(DepthRange, StaysTheSameWhileThingsMoveInTheUsualRange) {
    Picture picture;
    const DepthRange a = depth_range(picture, ball_at({0, 1, 0.5}, 0.1));
    const DepthRange b = depth_range(picture, ball_at({0.3, 1, -1.5}, 0.3));
    EXPECT_EQ(a.near_m, b.near_m);
    EXPECT_EQ(a.far_m, b.far_m);
}

// What the tool's shadow is bounded by must hold all that casts it.
TEST(BallsOf, HoldEveryVertexOfTheToolAndLittleElse) {
    const Primitives primitives = make_primitives();
    for (const double radius_m : {0.002, 0.01, 0.066}) {
        Picture picture;
        picture.show_wall_frame = false;
        picture.tool.visible = true;
        picture.tool.radius_m = radius_m;
        picture.tool.center_world = {0.1, 1.2, -0.3};
        picture.tool.stylus_world = {picture.tool.center_world, glm::angleAxis(0.8, glm::normalize(Vec3{1, 2, -1}))};
        const std::array balls = balls_of(picture.tool);
        for (const Shape& shape : shapes_of(picture, primitives).solid) {
            for (std::uint32_t k = 0; k < shape.range.index_count; ++k) {
                const shared::SurfaceVertex& v = primitives.vertices[primitives.indices[shape.range.first_index + k]];
                const Vec3 p(Mat4(shape.constants.world_from_local) * glm::dvec4(v.x, v.y, v.z, 1.0));
                const bool held = std::ranges::any_of(balls, [&](const Ball& ball) {
                    return glm::length(p - ball.center_world) <= ball.radius_m + 1e-6;  // float's rounding
                });
                ASSERT_TRUE(held) << radius_m;
            }
        }
        for (const Ball& ball : balls) EXPECT_LT(ball.radius_m, 0.5 * ball_of(picture.tool).radius_m);
        picture.tool.visible = false;
        for (const Ball& ball : balls_of(picture.tool)) EXPECT_EQ(ball.radius_m, 0.0);
    }
}

TEST(WorldFromPatch, AddsTheLatticesOriginBeforePlacingTheObject) {
    Picture picture;
    picture.world_from_object = {{1, 2, 3}, glm::angleAxis(0.5, Vec3{0, 1, 0}), 2.0};
    picture.lattice_origin_object = {0.1, -0.2, 0.3};
    const Vec3 p{0.4, 0.5, 0.6};
    const Vec3 expected = picture.world_from_object * (picture.lattice_origin_object + p);
    const Vec3 got(world_from_patch(picture) * glm::dvec4(p, 1.0));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], expected[i], 1e-12);
}

// Values of IEC 61966-2-1, worked out by hand.
TEST(LinearOf, FollowsTheSrgbCurve) {
    EXPECT_NEAR(linear_of({0.0, 0.5, 1.0}).x, 0.0, 1e-12);
    EXPECT_NEAR(linear_of({0.0, 0.5, 1.0}).y, 0.21404114, 1e-8);
    EXPECT_NEAR(linear_of({0.0, 0.5, 1.0}).z, 1.0, 1e-12);
    EXPECT_NEAR(linear_of({0.04, 0.0, 0.0}).x, 0.04 / 12.92, 1e-12);
}

}  // namespace burin::picture

// SPDX-License-Identifier: MIT
#include "renderer/frame_setup.hpp"

#include <gtest/gtest.h>

#include <array>

#include "renderer/projection.hpp"

namespace burin {

namespace {

Workpiece ball_at(const Vec3& center, double radius) { return {{center, radius}, {center, radius}}; }

double depth_of(const Scene& scene, const Workpiece& workpiece, const Vec3& p) {
    const shared::FrameUniforms frame = frame_uniforms(scene, workpiece, 1024);
    const glm::vec4 clip = frame.clip_from_world[0] * glm::vec4(glm::vec3(p), 1.0f);
    return static_cast<double>(clip.z / clip.w);
}

}  // namespace

TEST(DepthRange, CutsNothingOffNeitherNearTheEyeNorFarBehindTheWall) {
    Scene scene;
    scene.viewer.head_world.position_m = {0, 1.5, 1.0};
    for (const Vec3& center :
         {Vec3{0, 1.5, 0.93}, Vec3{0, 1.5, 0.5}, Vec3{0, 1, 0}, Vec3{0, 1, -10}, Vec3{0, 1, -400}}) {
        const Workpiece workpiece = ball_at(center, 0.02);
        for (const double side : {-0.02, 0.02}) {
            const double depth = depth_of(scene, workpiece, center + Vec3{0, 0, side});
            EXPECT_GT(depth, 0.0) << center.z;
            EXPECT_LT(depth, 1.0) << center.z;
        }
    }
}

TEST(DepthRange, HoldsTheWorkspacesBoxesAndBubbleToo) {
    Scene scene;
    scene.viewer.head_world.position_m = {0, 1.5, 1.0};
    const Vec3 close{0.0, 1.5, 0.97};
    const double away = depth_of(scene, Workpiece{}, close);
    EXPECT_LT(away, 0.0) << "nearer than what is usually there: cut off";
    const auto shown = [&](auto&& show) {
        Scene with = scene;
        show(with);
        return depth_of(with, Workpiece{}, close) > 0.0;
    };
    EXPECT_TRUE(shown([&](Scene& s) { s.box = {{close, Quat{1, 0, 0, 0}}, Vec3(0.02), {}, true}; }));
    EXPECT_TRUE(shown([&](Scene& s) { s.proposed_box = {{close, Quat{1, 0, 0, 0}}, Vec3(0.02), {}, true}; }));
    EXPECT_TRUE(shown([&](Scene& s) { s.bubble = {close, 0.01, {}, true}; }));
}

TEST(DepthRange, StaysTheSameWhileThingsMoveInTheUsualRange) {
    Scene scene;
    const DepthRange a = depth_range(scene, ball_at({0, 1, 0.5}, 0.1));
    const DepthRange b = depth_range(scene, ball_at({0.3, 1, -1.5}, 0.3));
    EXPECT_EQ(a.near_m, b.near_m);
    EXPECT_EQ(a.far_m, b.far_m);
}

TEST(ShadowFrame, HoldsAllThatCastsAShadow) {
    Scene scene;
    scene.tool.visible = true;
    scene.tool.radius_m = 0.03;
    scene.tool.center_world = scene.tool.stylus_world.position_m = {0.4, 1.5, 0.3};
    const Workpiece workpiece = ball_at({0, 1, -0.2}, 0.3);
    const shared::FrameUniforms frame = frame_uniforms(scene, workpiece, 2048);
    ASSERT_EQ(frame.shadow_scale.w, 1.0f);
    const auto inside = [&](const Vec3& p) {
        const glm::vec4 s = frame.shadow_from_world * glm::vec4(glm::vec3(p), 1.0f);
        for (int i = 0; i < 3; ++i) {
            EXPECT_GT(s[i], 0.0f);
            EXPECT_LT(s[i], 1.0f);
        }
    };
    for (int i = 0; i < 3; ++i) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 offset(0.0);
            offset[i] = side;
            inside(Vec3{0, 1, -0.2} + 0.3 * offset);
            inside(scene.tool.center_world + 0.03 * offset);
        }
    }
}

TEST(ShadowFrame, IsNotUsedWhenNothingCastsAShadow) {
    EXPECT_EQ(frame_uniforms(Scene{}, Workpiece{}, 2048).shadow_scale.w, 0.0f);
}

TEST(WorldFromPatch, AddsTheLatticesOriginBeforePlacingTheObject) {
    Scene scene;
    scene.world_from_object = {{1, 2, 3}, glm::angleAxis(0.5, Vec3{0, 1, 0}), 2.0};
    scene.lattice_origin_object = {0.1, -0.2, 0.3};
    const Vec3 p{0.4, 0.5, 0.6};
    const Vec3 expected = scene.world_from_object * (scene.lattice_origin_object + p);
    const Vec3 got(world_from_patch(scene) * glm::dvec4(p, 1.0));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], expected[i], 1e-12);
}

// Values of IEC 61966-2-1, worked out by hand.
TEST(LinearOf, FollowsTheSrgbCurve) {
    EXPECT_NEAR(linear_of({0.0, 0.5, 1.0}).x, 0.0, 1e-12);
    EXPECT_NEAR(linear_of({0.0, 0.5, 1.0}).y, 0.21404114, 1e-8);
    EXPECT_NEAR(linear_of({0.0, 0.5, 1.0}).z, 1.0, 1e-12);
    EXPECT_NEAR(linear_of({0.04, 0.0, 0.0}).x, 0.04 / 12.92, 1e-12);
}

}  // namespace burin

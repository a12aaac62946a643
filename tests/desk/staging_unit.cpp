// SPDX-License-Identifier: MIT
// From the haptic thread's tool state to what is drawn of tool and workspace.
#include "haptics/tool_state.hpp"
#include "picture/picture.hpp"
#include "session/held/staging.hpp"

#include <gtest/gtest.h>

namespace burin::session {
namespace {

const Vec3 kWorkspace_m{0.16, 0.12, 0.07};
const Similarity kWorldFromObject{{0.1, 1.2, -0.4}, glm::angleAxis(0.3, glm::normalize(Vec3(0, 1, 1))), 5.0};

haptics::ToolState paused_tool() {
    haptics::ToolState tool;
    tool.tick = 17;
    tool.hip_object_m = {0.02, 0.0, 0.05};
    tool.proxy_object_m = {0.02, 0.0, 0.06};
    tool.workspace.phase = haptics::WorkspacePhase::paused;
    tool.workspace.object_from_device = {{-0.1, 0.02, 0.05}, glm::angleAxis(0.5, Vec3(0, 0, 1)), 0.5};
    tool.workspace.proposed_visible = true;
    tool.workspace.proposed_center_object_m = tool.hip_object_m;
    return tool;
}

picture::Picture staged(const Staging& staging) {
    picture::Picture scene;
    stage(scene, staging, kWorldFromObject);
    return scene;
}

bool near(const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-12; }

}  // namespace

TEST(Staging, ShowsNothingBeforeTheFirstTick) {
    haptics::ToolState tool = paused_tool();
    tool.workspace.bubble_radius_object_m = 0.02;
    tool.tick = 0;
    const picture::Picture scene = staged(staging_of(tool, 0.01, kWorkspace_m));
    EXPECT_FALSE(scene.tool.visible || scene.box.visible || scene.proposed_box.visible || scene.bubble.visible);
}

TEST(Staging, ShowsTheToolOnTheSurfaceAndTheWorkspaceAroundTheDevicesMiddle) {
    haptics::ToolState tool = paused_tool();
    tool.workspace.proposed_visible = false;
    const picture::Picture scene = staged(staging_of(tool, 0.01, kWorkspace_m));
    EXPECT_TRUE(near(scene.tool.center_world, kWorldFromObject * tool.proxy_object_m)) << "not where the hand is";
    EXPECT_DOUBLE_EQ(scene.tool.radius_m, 0.05);
    ASSERT_TRUE(scene.box.visible);
    EXPECT_GT(scene.box.face_opacity, 0.0);
    EXPECT_FALSE(scene.proposed_box.visible);
    EXPECT_FALSE(scene.bubble.visible);
    // A corner of the device's workspace, the two ways round.
    const Similarity world_from_device = kWorldFromObject * tool.workspace.object_from_device;
    EXPECT_TRUE(near(scene.box.center_world * (0.5 * scene.box.size_m), world_from_device * (0.5 * kWorkspace_m)));
}

TEST(Staging, WhileModellingPausesAClearBoxStandsAroundTheToolAndTheOldOneIsLines) {
    const haptics::ToolState tool = paused_tool();
    const picture::Picture scene = staged(staging_of(tool, 0.01, kWorkspace_m));
    ASSERT_TRUE(scene.proposed_box.visible);
    EXPECT_TRUE(near(scene.proposed_box.center_world.position_m, kWorldFromObject * tool.hip_object_m));
    EXPECT_EQ(scene.proposed_box.size_m, scene.box.size_m);
    EXPECT_EQ(scene.proposed_box.center_world.orientation, scene.box.center_world.orientation);
    EXPECT_GT(scene.proposed_box.face_opacity, 0.0);
    EXPECT_EQ(scene.box.face_opacity, 0.0);
    EXPECT_NE(scene.proposed_box.colour, scene.box.colour);
}

TEST(Staging, TheBubbleLiesAroundTheWorkspacesMiddle) {
    haptics::ToolState tool = paused_tool();
    tool.workspace.bubble_radius_object_m = 0.0125;
    const picture::Picture scene = staged(staging_of(tool, 0.01, kWorkspace_m));
    ASSERT_TRUE(scene.bubble.visible);
    EXPECT_TRUE(near(scene.bubble.center_world, scene.box.center_world.position_m));
    EXPECT_DOUBLE_EQ(scene.bubble.radius_m, 0.0625);
}

// The device lies turned in the workpiece, and that in the world: the arrow must point to where the hand is pushed.
TEST(Staging, ShowsTheContactUnderTheBallAndTheForceAsTheHandFeelsIt) {
    haptics::ToolState tool = paused_tool();
    tool.workspace.proposed_visible = false;
    tool.flags = haptics::kTickInContact;
    tool.contact_normal_object = {0.0, 0.6, 0.8};
    tool.given.force_device_N = {0.5, -1.0, 2.0};
    Staging staging = staging_of(tool, 0.01, kWorkspace_m);
    EXPECT_FALSE(staged(staging).contact.visible) << "unless asked for";
    staging.contact_shown = true;
    const picture::Picture scene = staged(staging);
    ASSERT_TRUE(scene.contact.visible);
    EXPECT_TRUE(near(scene.contact.point_world, kWorldFromObject * (tool.proxy_object_m - Vec3(0.0, 0.006, 0.008))));
    const Vec3 to_tool = scene.tool.center_world - scene.contact.point_world;
    EXPECT_TRUE(near(to_tool, scene.tool.radius_m * scene.contact.normal_world)) << "the ball rests on the point";
    // A step of the device along the force, seen in the world.
    const Similarity world_from_device = kWorldFromObject * tool.workspace.object_from_device;
    const Vec3 step = world_from_device * tool.given.force_device_N - world_from_device * Vec3(0.0);
    EXPECT_NEAR(glm::dot(glm::normalize(step), glm::normalize(scene.contact.force_N)), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(scene.contact.force_N), glm::length(tool.given.force_device_N), 1e-12);
    tool.flags = 0;
    staging = staging_of(tool, 0.01, kWorkspace_m);
    staging.contact_shown = true;
    EXPECT_FALSE(staged(staging).contact.visible);
}

}  // namespace burin::session

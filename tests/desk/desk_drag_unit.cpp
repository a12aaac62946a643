// SPDX-License-Identifier: MIT
// The middle mouse button: turns and moves the scene, and turns the stylus.
#include <gtest/gtest.h>

#include "tests/desk/used_desk.hpp"

namespace burin::session {

TEST(DeskInput, TheMiddleButtonTurnsTheSceneAboutItsPivotAndPansWithShift) {
    UsedDesk desk;
    desk.view.pivot_world = {0.2, 1.0, -0.5};
    desk.world_from_scene = {{0.2, 0.9, -0.4}, {1, 0, 0, 0}, 2.0};
    const Vec3 pivot_scene = inverse(desk.world_from_scene) * desk.view.pivot_world;
    desk.step({MouseMove{{0.0, 0.0}}, MouseClick{MouseButton::middle, true, {}}});
    const DeskStep turned = desk.step({MouseMove{{100.0, 30.0}}});
    EXPECT_LT(apart(desk.world_from_scene * pivot_scene, desk.view.pivot_world), 1e-12);
    EXPECT_EQ(turned.target.position_device_m, Vec3(0.0));  // the stylus rests meanwhile
    // To the right the near side goes to the right.
    const Vec3 near_side = desk.view.pivot_world + Vec3(0.0, 0.0, 0.1);
    EXPECT_GT((turned.scene_change * near_side).x, near_side.x + 0.03);
    EXPECT_LT((turned.scene_change * near_side).y, near_side.y);  // and down goes down
    desk.step({MouseClick{MouseButton::middle, false, {}}});
    desk.view.world_m_per_px = 0.002;
    desk.step({MouseClick{MouseButton::middle, true, {.shift = true}}});
    const DeskStep panned = desk.step({MouseMove{{110.0, 25.0}}});
    EXPECT_LT(apart(panned.scene_change.position_m, {0.02, 0.01, 0.0}), 1e-12);
    EXPECT_EQ(panned.scene_change.scale, 1.0);
}

TEST(DeskInput, TheMiddleButtonAndCtrlTurnTheStylusAboutItsTipAndWithShiftAboutItsShaft) {
    UsedDesk desk;
    const Vec3 shaft = desk.settings.rest_device * Vec3(0.0, 1.0, 0.0);
    EXPECT_EQ(desk.step({}).target.orientation_device, desk.settings.rest_device);
    desk.step({MouseMove{{0.0, 0.0}}, MouseClick{MouseButton::middle, true, {.ctrl = true}}});
    const DeskStep turned = desk.step({MouseMove{{60.0, 0.0}}});
    EXPECT_EQ(turned.target.position_device_m, Vec3(0.0)) << "the tip rests";
    EXPECT_EQ(turned.scene_change, Similarity{});
    ASSERT_EQ(turned.way.size(), 1u) << "the hand is told of it";
    EXPECT_EQ(turned.way[0].orientation_device, turned.target.orientation_device);
    const Vec3 now = turned.target.orientation_device * Vec3(0.0, 1.0, 0.0);
    EXPECT_NEAR(now.y, shaft.y, 1e-12) << "to the right turns about the screen's upright";
    EXPECT_GT(now.x, shaft.x) << "the near end goes to the right";
    desk.step({MouseClick{MouseButton::middle, false, {}}});
    desk.step({MouseClick{MouseButton::middle, true, {.shift = true, .ctrl = true}}});
    const DeskStep rolled = desk.step({MouseMove{{120.0, 0.0}}});
    EXPECT_LT(apart(rolled.target.orientation_device * Vec3(0.0, 1.0, 0.0), now), 1e-12);
    EXPECT_GT(apart(rolled.target.orientation_device * Vec3(1.0, 0.0, 0.0),
                    turned.target.orientation_device * Vec3(1.0, 0.0, 0.0)),
              0.1);
    desk.step({MouseClick{MouseButton::middle, false, {}}});
    const DeskStep home = desk.step({KeyInput{Key::home, KeyMotion::press, {}}});
    EXPECT_EQ(home.target.orientation_device, desk.settings.rest_device);
}

TEST(DeskInput, ADragThereAndBackChangesNothing) {
    UsedDesk desk;
    desk.view.pivot_world = {0.2, 1.0, -0.5};
    desk.step({MouseMove{{0.0, 0.0}}, MouseClick{MouseButton::middle, true, {}}});
    desk.step({MouseMove{{77.0, 0.0}}});
    desk.step({MouseMove{{0.0, 0.0}}});
    for (const Vec3& p : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 2.0, 0.5)})
        EXPECT_LT(apart(desk.world_from_scene * p, p), 1e-12);
}

}  // namespace burin::session

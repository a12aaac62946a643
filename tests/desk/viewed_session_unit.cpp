// SPDX-License-Identifier: MIT
// A session before the eyes of a viewer who leads it with the mouse.
#include <gtest/gtest.h>

#include "haptics/tick.hpp"
#include "tests/desk/viewed.hpp"

namespace burin::session {

TEST(ViewedSession, BeginsWithTheWorkpieceInViewAndTheHandBeforeIt) {
    const Viewed viewed = block_before_desk();
    const SessionState& state = viewed.state;
    const picture::Picture scene = *scene_of(viewed.seen(), 0, Vec3(-0.1), {});
    const wall::Eyes eyes = wall::eyes_of(scene.viewer);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? 0.1 : -0.1, corner & 2 ? 0.1 : -0.1, corner & 4 ? 0.1 : -0.1};
        const Vec3 at = state.world_from_object * p;
        EXPECT_LT(at.z, eyes.left_world.z - 0.3);
        EXPECT_GT(at.y, 0.0);
    }
    const Vec3 hand = state.led().world_from_device * viewed.viewer.desk.target_device_m;
    EXPECT_GT(hand.z, (state.world_from_object * Vec3(0.0, 0.0, 0.1)).z) << "in front of the workpiece";
    EXPECT_TRUE(haptics::parameters_are_sensible(parameters_of(state, viewed.room)));
}

TEST(ViewedSession, EveryToolIsFeltAndDrawnAsItsShape) {
    haptics::ToolState tool;
    tool.tick = 1;
    tool.proxy_object_m = {0.01, 0.02, 0.1};
    tool.tool_orientation_object = glm::angleAxis(0.4, glm::normalize(Vec3(1, -2, 1)));
    for (const char* spec :
         {"cylinder:0.008,0.03", "cone:0.002,0.01,0.03", "bullnose:0.008,0.003,0.03", "box:0.016,0.02,0.03"}) {
        Viewed viewed = block_before_desk();
        const SessionOrders orders = viewed.step({{0, CommandInput{"tool", {spec}}}});
        ASSERT_TRUE(orders.messages.empty()) << spec;
        ASSERT_EQ(orders.carving.size(), 1u);
        const haptics::TickParameters p = parameters_of(viewed.state, viewed.room);
        EXPECT_TRUE(haptics::parameters_are_sensible(p)) << spec;
        EXPECT_TRUE(p.shape.touches()) << spec;
        const picture::PictureTool drawn = scene_of(viewed.seen(), 0, Vec3(-0.1), tool)->tool;
        ASSERT_NE(drawn.mesh, nullptr) << spec;
        // The drawn tool stands where and as the hand holds it, as large as the scene is.
        const Similarity expected =
            viewed.state.world_from_object * Similarity{tool.proxy_object_m, tool.tool_orientation_object, 1.0};
        EXPECT_EQ(drawn.world_from_mesh, expected) << spec;
        const Vec3 up = expected.orientation * Vec3(0.0, 1.0, 0.0);
        EXPECT_LT(glm::length(drawn.stylus_world.orientation * Vec3(0.0, 0.0, 1.0) - up), 1e-12) << spec;
        // The hand's shaft begins at the top of the tool.
        const double top_m = glm::dot(drawn.stylus_world.position_m - expected.position_m, up) / expected.scale;
        EXPECT_NEAR(top_m, drawn.mesh->bounds.hi.y, 1e-6) << spec;
    }
}

TEST(ViewedSession, TheNextStereoModeComesRoundToTheFirst) {
    Viewed viewed = block_before_desk();
    SessionOrders orders;
    const wall::StereoMode first = viewed.viewer.output.mode;
    int steps = 0;
    do {
        ASSERT_TRUE(viewed.run(orders, "next-stereo-mode"));
        EXPECT_NE(viewed.viewer.output.mode, wall::StereoMode::two_windows) << "one window cannot show it";
    } while (viewed.viewer.output.mode != first && ++steps < 100);
    EXPECT_EQ(steps, 12) << "thirteen modes";
}

TEST(ViewedSession, TurningTheSceneTakesTheWorkpieceAndNotTheHand) {
    Viewed viewed = block_before_desk();
    const Room& room = viewed.room;
    const SessionState state = viewed.state;
    const std::vector<InputEvent> events{{0, MouseMove{{100, 100}}},
                                         {0, MouseClick{MouseButton::middle, true, {}}},
                                         {0, MouseMove{{160, 100}}},
                                         {0, MouseClick{MouseButton::middle, false, {}}}};
    EXPECT_TRUE(viewed.step(events, {.dt_s = 0.02, .tool = {}}, {.eye_size = {1280, 720}}).parameters);
    EXPECT_NE(viewed.state.world_from_object.orientation, state.world_from_object.orientation);
    const Vec3 middle = state.world_from_object * room.workpiece_object.center();
    EXPECT_LT(glm::length(viewed.state.world_from_object * room.workpiece_object.center() - middle), 1e-9);
    // The hand's workspace stays where it was in the room.
    const Similarity before = state.world_from_object * parameters_of(state, room).workspace.object_from_device;
    const Similarity after =
        viewed.state.world_from_object * parameters_of(viewed.state, room).workspace.object_from_device;
    EXPECT_LT(glm::length(before.position_m - after.position_m), 1e-9);
    EXPECT_NEAR(std::abs(glm::dot(before.orientation, after.orientation)), 1.0, 1e-12);
}

// What is led is followed by the ticks as a body that moves, and what a command places is not.
TEST(ViewedSession, ADragMovesTheWorkpieceAndACommandPlacesIt) {
    Viewed viewed = block_before_desk();
    const SessionState state = viewed.state;
    const auto step = [&](const std::vector<InputEvent>& events) {
        static_cast<void>(viewed.step(events, {.dt_s = 0.02, .tool = {}}, {.eye_size = {1280, 720}}));
        return viewed.state;
    };
    const std::vector<InputEvent> drag{{0, MouseMove{{100, 100}}},
                                       {0, MouseClick{MouseButton::middle, true, {}}},
                                       {0, MouseMove{{104, 100}}},
                                       {0, MouseClick{MouseButton::middle, false, {}}}};
    const auto placed = [&](const SessionState& now) { return parameters_of(now, viewed.room).workspace.placed; };
    EXPECT_GT(placed(state), 0u) << "0 would never be followed";
    const SessionState dragged = step(drag);
    ASSERT_NE(dragged.world_from_object, state.world_from_object);
    EXPECT_EQ(placed(dragged), placed(state));
    const std::vector<InputEvent> reset{{0, CommandInput{"reset-view", {}}}};
    const SessionState back = step(reset);
    ASSERT_EQ(back.world_from_object, state.world_from_object);
    EXPECT_EQ(placed(back), placed(dragged) + 1);
    EXPECT_EQ(placed(step(reset)), placed(back)) << "it stood there already";
    const std::vector<InputEvent> other{{0, CommandInput{"friction", {"0.3"}}}};
    EXPECT_EQ(placed(step(other)), placed(back));
}

TEST(ViewedSession, WhatTheViewerKeepsIsReadWhereItsCommandSetIt) {
    for (const QuantityDescriptor& quantity : quantities()) {
        if (!is_of_a_viewer(SetQuantity{quantity.quantity, 0.0})) continue;
        Viewed viewed = block_before_desk();
        SessionOrders orders;
        const double middle = quantity.by_ratio ? std::sqrt(quantity.from * quantity.to) : 0.5 * quantity.to;
        ASSERT_TRUE(viewed.run(orders, std::string(quantity.name), {std::to_string(middle)})) << quantity.name;
        EXPECT_NEAR(value_of(viewed.state, viewed.viewer, quantity.quantity), middle, 1e-3 * middle) << quantity.name;
        EXPECT_FALSE(orders.parameters) << quantity.name;
        EXPECT_TRUE(orders.carving.empty()) << quantity.name;
    }
}

}  // namespace burin::session

// SPDX-License-Identifier: MIT
// Meshes of a world: what a hand feels of them, and what it costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

using test::object_at;
using test::shared_mesh;
using test::TouchedScene;

constexpr double kHalf_m = 0.02;

// Cubes of 4 cm on a grid of 6 cm, the first in the middle of all; ids from 1.
std::vector<SceneObject> cubes(int count) {
    const auto cube = shared_mesh(geometry::test::cube(kHalf_m));
    std::vector<SceneObject> objects{object_at(1, cube, Vec3(0.0))};
    for (int i = 0; objects.size() < static_cast<std::size_t>(count); ++i) {
        const Vec3 at = 0.06 * Vec3(i % 11 - 5, i / 11 % 11 - 5, i / 121 - 5);
        if (at != Vec3(0.0)) objects.push_back(object_at(objects.size() + 1, cube, at));
    }
    return objects;
}

// On the first cube's top, 1 mm deep.
const Vec3 kOnTop(0.003, kHalf_m + TouchedScene::kRadius_m - 0.001, 0.002);

TEST(MeshPart, AThousandObjectsCostATickAtMostTwiceWhatOneDoes) {
    TouchedScene alone(cubes(1)), crowd(cubes(1000));
    haptics::ContactWork of_one, of_all;
    double force_one_N = 0.0, force_all_N = 0.0;
    for (int i = 0; i < 600; ++i) {
        const Vec3 hand = kOnTop + Vec3(0.005 * std::sin(0.01 * i), 0.0, 0.0);
        const haptics::TickRecord one = alone.tick(hand), all = crowd.tick(hand);
        of_one += one.contact.work, of_all += all.contact.work;
        force_one_N = one.gate.given.force_device_N.y, force_all_N = all.gate.given.force_device_N.y;
    }
    EXPECT_NEAR(force_one_N, 0.001 * TouchedScene::kStiffness_N_per_m, 0.01);
    EXPECT_EQ(force_all_N, force_one_N);
    EXPECT_LE(haptics::cost_ns(of_all), 2.0 * haptics::cost_ns(of_one));
    EXPECT_LE(of_all.triangles_seen, 2 * of_one.triangles_seen);
}

TEST(MeshPart, TheCostOfAQueryDoesNotGrowWithWhatRests) {
    const auto looks = [](std::size_t far_away) {
        std::vector<SceneObject> objects = cubes(1000);
        for (std::size_t i = 0; i < far_away; ++i) {
            objects.push_back(objects[i % 1000]);
            objects.back().id = objects.size();
            objects.back().name = "far " + std::to_string(i);
            objects.back().pose.position_m += Vec3(2.0 + static_cast<double>(i / 1000), 0.0, 0.0);
        }
        TouchedScene scene(objects);
        (void)scene.tick(kOnTop);
        return scene.part->looks();
    };
    const std::uint64_t of_thousand = looks(0), of_four = looks(3000);
    EXPECT_LT(of_thousand, 120u) << "of 1000 boxes";
    // Two levels more, of two nodes each.
    EXPECT_LE(of_four, of_thousand + 4) << of_thousand;
}

TEST(MeshPart, TwentyMovingAmongAThousandRestingAreAllFollowed) {
    std::vector<SceneObject> objects = cubes(1000);
    for (SceneObject& object : objects) object.pose.position_m.x += 5.0;
    const auto plate = shared_mesh(geometry::test::cube(0.003));
    for (int i = 0; i < 20; ++i) {
        objects.push_back(object_at(objects.size() + 1, plate, {0.01 * (i % 5), 0.0, 0.01 * (i / 5)}));
        objects.back().motion = test::up_and_down(0.02);
    }
    // Held over each of the twenty in turn, in the middle of its way: what is followed pushes the hand smoothly.
    for (int i = 0; i < 20; ++i) {
        TouchedScene scene(objects);
        double most_N = 0.0, steepest_N = 0.0, last_N = 0.0;
        std::size_t moving = 0;
        const Vec3 hand(0.01 * (i % 5), 0.003 + TouchedScene::kRadius_m + 0.004, 0.01 * (i / 5));
        for (int t = 0; t < 450; ++t) {
            const haptics::TickRecord record = scene.tick(hand);
            const double force_N = record.gate.given.force_device_N.y;
            most_N = std::max(most_N, force_N);
            if (last_N > 0.3) steepest_N = std::max(steepest_N, std::abs(force_N - last_N));
            last_N = force_N;
            moving = std::max(moving, static_cast<std::size_t>(std::ranges::count_if(scene.slot.newest().meshes,
                                                                                     &geometry::TouchedMesh::moves)));
        }
        EXPECT_GE(moving, 8u) << "its neighbours move too";
        EXPECT_GT(most_N, 1.5) << i;
        // 600 N/m at 30 mm/s: 0.018 N a tick. A jump once a publication would be ten times that.
        EXPECT_LT(steepest_N, 0.05) << i;
    }
}

TEST(MeshPart, EachObjectFeelsAsItsMaterialSays) {
    std::vector<SceneObject> objects = cubes(2);
    objects[0].material.stiffness_N_per_m = 300.0;
    objects[1].pose.position_m = {0.3, 0.0, 0.0};
    TouchedScene scene(objects);
    const auto pressed_N = [&](double x_m) {
        haptics::TickRecord record;
        for (int i = 0; i < 400; ++i) record = scene.tick(kOnTop + Vec3(x_m, 0.0, 0.0));
        return record.gate.given.force_device_N.y;
    };
    EXPECT_NEAR(pressed_N(0.0), 0.3, 0.003);
    EXPECT_NEAR(pressed_N(0.3), 0.6, 0.006);
    ASSERT_TRUE(scene.part->edit(1, SetMaterial{{.stiffness_N_per_m = 450.0}}));
    scene.materials.write(scene.parameters.materials);
    EXPECT_NEAR(pressed_N(0.0), 0.45, 0.005);
    EXPECT_NEAR(pressed_N(0.3), 0.6, 0.006) << "the other keeps its own";
}

TEST(MeshPart, EditsOfPoseScaleAndFeelingAreFeltFromTheNextUpdateOn) {
    TouchedScene scene(cubes(1));
    const auto pressed_N = [&](double y_m) {
        haptics::TickRecord record;
        scene.state = {};  // the hand has come from above
        for (int i = 0; i < 400; ++i) record = scene.tick({0.003, y_m + TouchedScene::kRadius_m - 0.001, 0.002});
        return record.gate.given.force_device_N.y;
    };
    EXPECT_NEAR(pressed_N(kHalf_m), 0.6, 0.006);
    ASSERT_TRUE(scene.part->edit(1, SetPose{{{0.0, 0.1, 0.0}}}));
    EXPECT_EQ(pressed_N(kHalf_m), 0.0);
    EXPECT_NEAR(pressed_N(0.1 + kHalf_m), 0.6, 0.006);
    ASSERT_TRUE(scene.part->edit(1, SetScale{2.0}));
    EXPECT_NEAR(pressed_N(0.1 + 2.0 * kHalf_m), 0.6, 0.006);
    ASSERT_TRUE(scene.part->edit(1, SetFelt{false}));
    EXPECT_EQ(pressed_N(0.1 + 2.0 * kHalf_m), 0.0);
    ASSERT_TRUE(scene.part->edit(1, SetFelt{true}));
    EXPECT_NEAR(pressed_N(0.1 + 2.0 * kHalf_m), 0.6, 0.006);
}

TEST(MeshPart, ATurnedCubeIsTouchedWhereItIsTurnedTo) {
    std::vector<SceneObject> objects = cubes(1);
    objects[0].pose.orientation = glm::angleAxis(glm::radians(45.0), Vec3(0.0, 0.0, 1.0));
    TouchedScene scene(objects);
    const double top_m = std::sqrt(2.0) * kHalf_m;
    EXPECT_FALSE(scene.tick({0.0, top_m + TouchedScene::kRadius_m + 1e-4, 0.0}).in_contact());
    haptics::TickRecord record;
    for (int i = 0; i < 400; ++i) record = scene.tick({0.0, top_m + TouchedScene::kRadius_m - 0.001, 0.0});
    EXPECT_TRUE(record.in_contact());
    // On the edge the spring stretches from the ball's middle straight up.
    EXPECT_NEAR(record.gate.given.force_device_N.y, 0.6, 0.01);
}

TEST(MeshPart, AHandDoesNotTouchWhatItHoldsAndPushesOthersWithIt) {
    TouchedScene scene(cubes(1));
    HandPose hand;
    hand.scene_from_hand.position_m = {0.5, 0.5, 0.5};
    hand.velocity_m_per_s = {0.0, 0.1, 0.0};
    scene.part->move_hand(0, hand);
    ASSERT_TRUE(scene.part->edit(1, TakeHold{{0}, {}}));
    (void)scene.tick({0.5, 0.5, 0.5});
    EXPECT_TRUE(scene.slot.newest().meshes.empty()) << "the hand that holds it";
    EXPECT_EQ(scene.part->pose(1).position_m, hand.scene_from_hand.position_m);
    geometry::LocalSurface others;
    ASSERT_TRUE(scene.part->add_near({1, {0.5, 0.5, 0.5}, 0.1}, others));
    ASSERT_EQ(others.meshes.size(), 1u) << "another hand";
    EXPECT_EQ(others.meshes[0].motion.velocity_object_m_per_s, hand.velocity_m_per_s);
    EXPECT_FALSE(scene.part->edit(1, SetPose{}).has_value()) << "it is held";
    ASSERT_TRUE(scene.part->let_go(1));
    for (int i = 0; i < 10; ++i) (void)scene.tick({0.5, 0.5, 0.5});
    EXPECT_EQ(scene.part->object(1).pose.position_m, hand.scene_from_hand.position_m);
    ASSERT_EQ(scene.slot.newest().meshes.size(), 1u);
    EXPECT_FALSE(scene.slot.newest().meshes[0].moves());
}

// Two fingertips hold it between them, and a third one touches it.
TEST(MeshPart, WhatSeveralPartsHoldGoesWithTheirMiddleAndIsFeltByThemWhereItShallBe) {
    for (const bool felt : {false, true}) {
        TouchedScene scene(cubes(1));
        const auto put = [&](std::size_t hand, const Vec3& at_m, double turn_rad) {
            HandPose pose;
            pose.scene_from_hand = {at_m, glm::angleAxis(turn_rad, Vec3(0.0, 0.0, 1.0))};
            scene.part->move_hand(hand, pose);
        };
        const std::array<std::size_t, 2> holding{0, 2};
        put(0, {0.0, kHalf_m, 0.0}, 0.0);
        EXPECT_FALSE(scene.part->take_hold(1, holding, felt).has_value()) << "nobody knows where the second is";
        EXPECT_FALSE(scene.part->take_hold(1, std::span<const std::size_t>()).has_value()) << "by nobody";
        put(2, {0.0, -kHalf_m, 0.0}, 0.0);
        const Pose before = scene.part->pose(1);
        ASSERT_TRUE(scene.part->take_hold(1, holding, felt));
        put(0, {0.03, kHalf_m, 0.0}, 0.3);
        put(2, {0.01, -kHalf_m, 0.0}, 0.3);
        ASSERT_TRUE(scene.part->update(1'000'000'000, nullptr));
        const Pose& held = scene.part->pose(1);
        const Vec3 expected = Vec3(0.02, 0.0, 0.0) + glm::angleAxis(0.3, Vec3(0.0, 0.0, 1.0)) * before.position_m;
        EXPECT_LT(glm::length(held.position_m - expected), 1e-12);
        EXPECT_NEAR(2.0 * std::asin(held.orientation.z), 0.3, 1e-12);
        for (const std::size_t hand : {0u, 1u, 2u}) {
            geometry::LocalSurface surface;
            ASSERT_TRUE(scene.part->add_near({hand, held.position_m, 0.1}, surface));
            EXPECT_EQ(surface.meshes.size(), felt || hand == 1 ? 1u : 0u) << hand;
        }
    }
}

TEST(MeshPart, AnObjectThatIsFeltNoMoreGivesItsMaterialBackEachTime) {
    TouchedScene scene(cubes(2));
    for (int time = 0; time < 3 * static_cast<int>(haptics::kMostMaterials); ++time) {
        ASSERT_TRUE(scene.part->edit(1, SetMaterial{{.stiffness_N_per_m = 200.0 + time}})) << time;
        ASSERT_TRUE(scene.part->edit(1, SetFelt{false})) << time;
        ASSERT_TRUE(scene.part->edit(1, SetMaterial{{.stiffness_N_per_m = 500.0 + time}})) << "while nobody feels it";
        ASSERT_TRUE(scene.part->edit(1, SetFelt{true})) << time;
    }
}

// Whatever signs their quaternions have, which mean the same turns.
TEST(SceneMotion, TheFrameOfAGripIsThatOfItsOnlyPartOrInTheMiddleOfAll) {
    HandPose one;
    one.scene_from_hand = {{0.1, 0.2, 0.3}, glm::normalize(Quat(0.7, 0.1, 0.3, -0.2))};
    one.velocity_m_per_s = {1.0, 2.0, 3.0};
    const HandPose alone = grip_frame(std::array{one});
    EXPECT_EQ(alone.scene_from_hand, one.scene_from_hand);
    EXPECT_EQ(alone.velocity_m_per_s, one.velocity_m_per_s);
    HandPose left = one, right = one;
    left.scene_from_hand.orientation = glm::angleAxis(0.2, Vec3(0.0, 1.0, 0.0));
    right.scene_from_hand.orientation = -glm::angleAxis(0.6, Vec3(0.0, 1.0, 0.0));
    right.scene_from_hand.position_m = {0.3, 0.2, 0.1};
    right.velocity_m_per_s = {0.0, 0.0, 1.0};
    left.angular_velocity_rad_per_s = {0.4, -0.2, 1.0};
    right.angular_velocity_rad_per_s = {0.2, 0.6, -3.0};
    const HandPose both = grip_frame(std::array{left, right});
    EXPECT_LT(glm::length(both.scene_from_hand.position_m - Vec3(0.2, 0.2, 0.2)), 1e-15);
    EXPECT_NEAR(glm::angle(both.scene_from_hand.orientation), 0.4, 1e-12);
    EXPECT_LT(glm::length(both.velocity_m_per_s - Vec3(0.5, 1.0, 2.0)), 1e-15);
    EXPECT_LT(glm::length(both.angular_velocity_rad_per_s - Vec3(0.3, 0.2, -1.0)), 1e-15);
}

namespace {

// A hand whose tool rests on the first cube, with its second button up or down.
haptics::TickRecord gripping_sample(std::uint64_t tick, const Vec3& at_m, bool down) {
    haptics::TickRecord sample;
    sample.tick = tick;
    sample.time_ns = static_cast<Nanoseconds>(tick) * 1'000'000;
    sample.contact.points[0].hip_object_m = sample.contact.points[0].proxy_object_m = at_m;
    sample.sample.buttons = down ? 2u : 0u;
    sample.flags = haptics::kTickInContact;
    sample.contact.point_count = 1;
    sample.contact.points[0].object = 1;
    return sample;
}

}  // namespace

TEST(MeshPart, AButtonTakesHoldOfWhatIsTouchedAndLetsGoOfIt) {
    MaterialTable materials;
    auto part = *MeshPart::create(cubes(20), materials);
    part->grip_with(0, 2u);
    std::uint64_t tick = 0;
    const auto update = [&](const Vec3& at_m, bool down) {
        const std::array samples{gripping_sample(++tick, at_m, down)};
        part->take_ticks(0, samples);
        ASSERT_TRUE(part->update(static_cast<Nanoseconds>(tick) * 1'000'000, nullptr));
    };
    const Vec3 on_top(0.0, kHalf_m + 0.004, 0.0);
    update(on_top, false);
    update(on_top, true);
    update(on_top + Vec3(0.3, 0.1, 0.0), true);
    EXPECT_LT(glm::length(part->pose(1).position_m - Vec3(0.3, 0.1, 0.0)), 1e-12) << "it goes along";
    for (ObjectId id = 2; id <= 20; ++id) EXPECT_TRUE(std::holds_alternative<FixedMotion>(part->object(id).motion));
    update(on_top + Vec3(0.3, 0.2, 0.0), false);
    const Pose left = part->pose(1);
    update(on_top, false);
    EXPECT_EQ(part->pose(1), left) << "it stays where the hand has left it";
    EXPECT_TRUE(std::holds_alternative<FixedMotion>(part->object(1).motion));
    update(on_top, true);
    EXPECT_TRUE(std::holds_alternative<HeldMotion>(part->object(1).motion)) << "and can be taken again";
}

// An activity gives what a button has taken into other hands: the button lets go of nothing that is not its own.
TEST(MeshPart, AButtonLetsGoOfWhatItsHandAloneHolds) {
    MaterialTable materials;
    auto part = *MeshPart::create(cubes(2), materials);
    for (const std::size_t hand : {0u, 1u}) part->move_hand(hand, {});
    part->grip_with(0, 2u);
    const Vec3 on_top(0.0, kHalf_m + 0.004, 0.0);
    part->take_ticks(0, std::array{gripping_sample(1, on_top, true)});
    ASSERT_TRUE(std::holds_alternative<HeldMotion>(part->object(1).motion));
    const std::array<std::size_t, 2> both{0, 1};
    ASSERT_TRUE(part->take_hold(1, both));
    part->take_ticks(0, std::array{gripping_sample(2, on_top, false)});
    const auto* held = std::get_if<HeldMotion>(&part->object(1).motion);
    ASSERT_NE(held, nullptr);
    EXPECT_EQ(held->parts.size(), 2u);
}

TEST(MeshPart, NothingIsTakenInTheAirOrWhileTheWorkspaceMoves) {
    MaterialTable materials;
    auto part = *MeshPart::create(cubes(2), materials);
    part->grip_with(0, 2u);
    haptics::TickRecord up = gripping_sample(1, {0.0, kHalf_m + 0.004, 0.0}, false);
    haptics::TickRecord in_the_air = gripping_sample(2, up.contact.points[0].proxy_object_m, true);
    in_the_air.flags = 0;
    haptics::TickRecord paused = gripping_sample(2, up.contact.points[0].proxy_object_m, true);
    paused.motion.workspace.phase = haptics::WorkspacePhase::paused;
    haptics::TickRecord on_the_workpiece = gripping_sample(2, up.contact.points[0].proxy_object_m, true);
    on_the_workpiece.contact.points[0].object = kCarvedObject;
    for (const haptics::TickRecord& pressed : {in_the_air, paused, on_the_workpiece}) {
        const std::array samples{up, pressed};
        part->take_ticks(0, samples);
        for (const ObjectId id : {1u, 2u}) EXPECT_FALSE(std::holds_alternative<HeldMotion>(part->object(id).motion));
        const std::array released{up};
        part->take_ticks(0, released);
    }
}

// What the tick has found touched is taken, not what lies nearest to where the tool is; of a part with several points
// the first one's that touches something; and where no work was left for a tick, what was touched before.
TEST(MeshPart, AButtonTakesHoldOfWhatTheTickHasFoundTouched) {
    const Vec3 at_the_first(0.0, kHalf_m + 0.004, 0.0);
    haptics::TickRecord second = gripping_sample(2, at_the_first, true);
    second.contact.points[0].object = 2;
    haptics::TickRecord by_another_point = gripping_sample(2, at_the_first, true);
    by_another_point.contact.point_count = 3;
    by_another_point.contact.points[0].object = 0;
    by_another_point.contact.points[2].object = 2;
    haptics::TickRecord touching = gripping_sample(1, at_the_first, false), held_over = second;
    touching.contact.points[0].object = 2;
    held_over.contact.points[0].object = 0;
    held_over.contact.points[0].normal_object = {0.0, 1.0, 0.0};
    held_over.flags |= haptics::kTickHeldOver;
    const haptics::TickRecord at_first = gripping_sample(1, at_the_first, false);
    for (const auto& ticks :
         {std::array{at_first, second}, std::array{at_first, by_another_point}, std::array{touching, held_over}}) {
        MaterialTable materials;
        auto part = *MeshPart::create(cubes(2), materials);
        part->grip_with(0, 2u);
        part->take_ticks(0, ticks);
        EXPECT_FALSE(std::holds_alternative<HeldMotion>(part->object(1).motion));
        EXPECT_TRUE(std::holds_alternative<HeldMotion>(part->object(2).motion));
    }
}

// The workspace has more ways to move than one: none of them takes what lies under the tool along.
TEST(MeshPart, AButtonTakesHoldInNoPhaseOfTheWorkspaceButEditing) {
    using Phase = haptics::WorkspacePhase;
    for (const Phase phase :
         {Phase::editing, Phase::paused, Phase::dragging, Phase::jumping, Phase::clutched, Phase::gliding}) {
        MaterialTable materials;
        auto part = *MeshPart::create(cubes(2), materials);
        part->grip_with(0, 2u);
        const haptics::TickRecord up = gripping_sample(1, {0.0, kHalf_m + 0.004, 0.0}, false);
        haptics::TickRecord pressed = gripping_sample(2, up.contact.points[0].proxy_object_m, true);
        pressed.motion.workspace.phase = phase;
        part->take_ticks(0, std::array{up, pressed});
        EXPECT_EQ(std::holds_alternative<HeldMotion>(part->object(1).motion), phase == Phase::editing)
            << static_cast<int>(phase);
    }
}

TEST(MeshPart, WhatOneHandHoldsNoOtherHandTakesAway) {
    MaterialTable materials;
    auto part = *MeshPart::create(cubes(2), materials);
    for (const std::size_t hand : {0u, 1u}) part->grip_with(hand, 2u);
    const Vec3 on_top(0.0, kHalf_m + 0.004, 0.0);
    for (const std::size_t hand : {0u, 1u}) part->take_ticks(hand, std::array{gripping_sample(1, on_top, false)});
    part->take_ticks(0, std::array{gripping_sample(2, on_top, true)});
    part->take_ticks(1, std::array{gripping_sample(2, on_top, true)});
    const auto* held = std::get_if<HeldMotion>(&part->object(1).motion);
    ASSERT_NE(held, nullptr);
    EXPECT_EQ(held->parts, (std::vector<std::size_t>{0}));
    // The second hand, which holds nothing, lets nothing go either.
    part->take_ticks(1, std::array{gripping_sample(3, on_top, false)});
    ASSERT_TRUE(std::holds_alternative<HeldMotion>(part->object(1).motion));
    part->take_ticks(0, std::array{gripping_sample(3, on_top, false)});
    EXPECT_TRUE(std::holds_alternative<FixedMotion>(part->object(1).motion));
}

// Keys that turn and shift, of an object that is itself turned: in the scene's axes it would go another way.
TEST(MeshPart, APathRunsInTheAxesOfItsObject) {
    const Quat quarter_about_z = glm::angleAxis(glm::radians(90.0), Vec3(0.0, 0.0, 1.0));
    const Quat eighth_about_x = glm::angleAxis(glm::radians(45.0), Vec3(1.0, 0.0, 0.0));
    std::vector<SceneObject> objects = cubes(1);
    objects[0].pose = {{0.5, 0.0, 0.0}, quarter_about_z};
    objects[0].motion = PathMotion{{{0.0, {}}, {1.0, {{0.0, 0.2, 0.0}, eighth_about_x}}}, false};
    MaterialTable materials;
    auto part = *MeshPart::create(objects, materials);
    ASSERT_TRUE(part->update(1'000'000'000, nullptr));
    ASSERT_TRUE(part->update(3'000'000'000, nullptr));
    const Pose there = part->pose(1);
    // The object's y axis is the scene's -x, and its x axis the scene's y.
    EXPECT_LT(glm::length(there.position_m - Vec3(0.3, 0.0, 0.0)), 1e-12)
        << there.position_m.x << ' ' << there.position_m.y;
    const Vec3 top = there.orientation * Vec3(0.0, 1.0, 0.0);
    const double half = std::sqrt(0.5);
    EXPECT_LT(glm::length(top - Vec3(-half, 0.0, half)), 1e-12) << top.x << ' ' << top.y << ' ' << top.z;
}

// What the hand feels of it is the path's velocity in the scene's axes, a quarter turn from the object's.
TEST(MeshPart, AMovingObjectTellsItsVelocityInTheScenesAxes) {
    std::vector<SceneObject> objects = cubes(1);
    objects[0].pose.orientation = glm::angleAxis(glm::radians(90.0), Vec3(0.0, 0.0, 1.0));
    const Quat quarter_about_y = glm::angleAxis(glm::radians(90.0), Vec3(0.0, 1.0, 0.0));
    objects[0].motion = PathMotion{{{0.0, {}}, {2.0, {{0.0, 0.2, 0.0}, quarter_about_y}}}, false};
    MaterialTable materials;
    auto made = MeshPart::create(objects, materials);
    ASSERT_TRUE(made) << made.error().line();
    const auto& part = *made;
    ASSERT_TRUE(part->update(1'000'000'000, nullptr));
    ASSERT_TRUE(part->update(2'000'000'000, nullptr));
    geometry::LocalSurface seen;
    ASSERT_TRUE(part->add_near({0, part->pose(1).position_m, 0.1}, seen));
    ASSERT_EQ(seen.meshes.size(), 1u);
    const Vec3 velocity = seen.meshes[0].motion.velocity_object_m_per_s;
    const Vec3 turning = seen.meshes[0].motion.angular_velocity_object_rad_per_s;
    EXPECT_LT(velocity.x, -0.05);
    EXPECT_LT(std::hypot(velocity.y, velocity.z), 1e-3);
    EXPECT_LT(turning.x, -0.5);
    EXPECT_LT(std::hypot(turning.y, turning.z), 1e-3);
}

TEST(MeshPart, AnUpdateIsRepeatedToTheBit) {
    std::vector<SceneObject> objects = cubes(1);
    objects[0].motion = test::up_and_down(0.1);
    MaterialTable materials;
    auto live = MeshPart::create(objects, materials), again = MeshPart::create(objects, materials);
    for (const Nanoseconds now_ns : {Nanoseconds{1'234'567}, Nanoseconds{11'000'001}, Nanoseconds{777'777'777}}) {
        ASSERT_TRUE((*live)->update(now_ns, nullptr));
        ASSERT_TRUE((*again)->update(now_ns, &(*live)->seen()));
        EXPECT_EQ((*live)->pose(1), (*again)->pose(1));
    }
    EXPECT_GT((*live)->pose(1).position_m.y, 0.01);
}

TEST(MeshPart, TellsTheFrameWhatHasChanged) {
    std::vector<SceneObject> objects = cubes(3);
    objects[2].motion = test::up_and_down(0.1);
    TouchedScene scene(objects);
    EXPECT_EQ(scene.part->take_object_updates().size(), 3u) << "at first all";
    EXPECT_TRUE(scene.part->take_object_updates().empty());
    ASSERT_TRUE(scene.part->edit(2, SetColour{{1, 2, 3}}));
    for (int i = 0; i < 30; ++i) (void)scene.tick(kOnTop);
    const std::vector<ObjectUpdate> updates = scene.part->take_object_updates();
    ASSERT_EQ(updates.size(), 2u);
    EXPECT_EQ(updates[0].id, 2u);
    EXPECT_EQ(updates[0].colour, (Colour{1, 2, 3}));
    EXPECT_EQ(updates[1].id, 3u);
    EXPECT_GT(updates[1].scene_from_mesh.position_m.y, objects[2].pose.position_m.y);
}

// Those that share a mesh and a material, too.
TEST(MeshPart, EachMeshOfASurfaceHasTheNumberOfItsObject) {
    std::vector<SceneObject> objects = cubes(4);
    objects[2].motion = PathMotion{{{0.0, {}}, {1.0, {{0.001, 0.0, 0.0}}}, {2.0, {}}}, true};
    objects.push_back(object_at(5, shared_mesh(geometry::test::cube(0.5 * kHalf_m)), Vec3(0.0)));
    TouchedScene scene(objects);
    (void)scene.tick(kOnTop);
    geometry::LocalSurface draft;
    ASSERT_TRUE(scene.part->add_near({0, Vec3(0.0), 1.0}, draft));
    std::vector<ObjectId> found;
    for (const geometry::TouchedMesh& mesh : draft.meshes) {
        found.push_back(mesh.object);
        EXPECT_EQ(scene.part->pose(found.back()), mesh.motion.object_from_mesh);
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, (std::vector<ObjectId>{1, 2, 3, 4, 5}));
}

TEST(MeshPart, EqualMeshesShareOneSnapshotAndEqualMaterialsOneEntry) {
    TouchedScene scene(cubes(3));
    scene.reach_m = 1.0;
    (void)scene.tick(kOnTop);
    const auto& meshes = scene.slot.newest().meshes;
    ASSERT_EQ(meshes.size(), 3u);
    EXPECT_EQ(meshes[0].snapshot, meshes[2].snapshot);
    EXPECT_EQ(meshes[0].material, meshes[2].material);
}

TEST(MeshPart, RefusesWhatCannotBeTouchedAndAnEditThatFailsChangesNothing) {
    MaterialTable materials(haptics::kMostMaterials - 1);
    std::vector<SceneObject> objects = cubes(2);
    objects[1].name = objects[0].name;
    EXPECT_FALSE(MeshPart::create(objects, materials).has_value()) << "two of one name";
    objects = cubes(2);
    objects[1].id = 1;
    EXPECT_FALSE(MeshPart::create(objects, materials).has_value()) << "two of one id";
    objects = cubes(2);
    objects[1].material.stiffness_N_per_m = 1.0;
    EXPECT_FALSE(MeshPart::create(objects, materials).has_value()) << "no room for a second material";
    objects = cubes(1);
    objects[0].mesh = shared_mesh({});
    EXPECT_FALSE(MeshPart::create(objects, materials).has_value()) << "no triangles";
    auto part = MeshPart::create(cubes(2), materials);
    ASSERT_TRUE(part.has_value()) << "what failed has let go of its material: " << part.error().line();
    EXPECT_FALSE((*part)->edit(1, SetMaterial{{.stiffness_N_per_m = 1.0}}).has_value());
    EXPECT_FALSE((*part)->edit(1, SetScale{-1.0}).has_value());
    EXPECT_FALSE((*part)->edit(9, SetScale{1.0}).has_value());
    EXPECT_EQ((*part)->object(1).material, HapticMaterial{});
    EXPECT_EQ((*part)->object(1).scale, 1.0);
}

}  // namespace
}  // namespace burin::scene

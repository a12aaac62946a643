// SPDX-License-Identifier: MIT
// Materials, objects and paths as data.
#include <gtest/gtest.h>

#include <limits>

#include "scene/haptic_material.hpp"
#include "scene/scene_object.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

std::vector<std::string> keys_of(const std::vector<Problem>& found) {
    std::vector<std::string> keys;
    for (const Problem& problem : found) keys.push_back(problem.key);
    return keys;
}
using Keys = std::vector<std::string>;

TEST(HapticMaterial, EveryImpossibleValueIsNamed) {
    EXPECT_TRUE(problems(HapticMaterial{}).empty());
    EXPECT_EQ(keys_of(problems(HapticMaterial{-1.0, NAN, 20.0, -0.5, 5.0})),
              (Keys{"stiffness", "damping", "static_friction", "dynamic_friction", "coulomb_velocity"}));
    EXPECT_EQ(keys_of(problems(HapticMaterial{0.0, 0.0, 0.1, 0.2})), (Keys{"stiffness", "dynamic_friction"}));
}

TEST(MaterialTable, SharesEntriesAndKeepsTheirPlaces) {
    MaterialTable table(1);
    const HapticMaterial soft{.stiffness_N_per_m = 100.0}, hard{.stiffness_N_per_m = 900.0};
    EXPECT_EQ(table.hold(soft), 1);
    EXPECT_EQ(table.hold(hard), 2);
    EXPECT_EQ(table.hold(soft), 1);
    const HapticMaterial other{.stiffness_N_per_m = 500.0};
    EXPECT_EQ(table.change(1, other), 3) << "another object still feels soft";
    EXPECT_EQ(table.change(2, {.stiffness_N_per_m = 901.0}), 2) << "nobody else holds it";
    EXPECT_EQ(table.change(3, soft), 1) << "there is one already";
    table.release(2);
    EXPECT_EQ(table.hold(other), 2) << "a free place";
    std::array<haptics::TouchMaterial, haptics::kMostMaterials> materials{};
    materials[0].stiffness_N_per_m = 7.0;
    table.write(materials);
    EXPECT_EQ(materials[0].stiffness_N_per_m, 7.0) << "reserved for others";
    EXPECT_EQ(materials[1].stiffness_N_per_m, 100.0);
    EXPECT_EQ(materials[2].stiffness_N_per_m, 500.0);
}

TEST(MaterialTable, RefusesOneMoreThanItHolds) {
    MaterialTable table;
    for (std::uint32_t i = 0; i < MaterialTable::kMaxEntries; ++i)
        EXPECT_EQ(table.hold({.stiffness_N_per_m = 100.0 + i}), static_cast<std::uint8_t>(i));
    EXPECT_FALSE(table.hold({.stiffness_N_per_m = 1.0}).has_value());
    const std::uint64_t version = table.version();
    EXPECT_FALSE(table.hold({.stiffness_N_per_m = 2.0}).has_value());
    EXPECT_EQ(table.version(), version);
}

TEST(SceneObject, EveryEditIsPureAndCheckedFirst) {
    SceneObject object;
    object.name = "stone";
    const auto held = edited(object, TakeHold{{2}, {}});
    ASSERT_TRUE(held.has_value());
    EXPECT_EQ(std::get<HeldMotion>(held->motion).parts, (std::vector<std::size_t>{2}));
    EXPECT_FALSE(edited(*held, SetPose{}).has_value());
    const auto dropped = edited(*held, LetGo{{{1.0, 2.0, 3.0}}});
    ASSERT_TRUE(dropped.has_value());
    EXPECT_EQ(dropped->pose.position_m, Vec3(1.0, 2.0, 3.0));
    EXPECT_TRUE(std::holds_alternative<FixedMotion>(dropped->motion));
    EXPECT_EQ(edited(object, SetScale{3.0})->scale, 3.0);
    EXPECT_FALSE(edited(object, SetSeen{false})->seen);
    EXPECT_FALSE(edited(object, SetFelt{false})->felt);
    for (const ObjectEdit& bad :
         {ObjectEdit{SetScale{0.0}}, ObjectEdit{SetScale{NAN}}, ObjectEdit{SetPose{{Vec3(NAN, 0.0, 0.0)}}},
          ObjectEdit{SetPose{{Vec3(2000.0)}}}, ObjectEdit{SetPose{{Vec3(0.0), Quat(2.0, 0.0, 0.0, 0.0)}}},
          ObjectEdit{SetMaterial{{.damping_Ns_per_m = -1.0}}}})
        EXPECT_FALSE(edited(object, bad).has_value()) << bad.index();
    EXPECT_EQ(object.scale, 1.0);
}

// Five different numbers, so that none can stand in another's place; and no tool cuts an object of a scene.
TEST(HapticMaterial, GivesTheTickEachOfItsValuesAndIsNotCut) {
    const haptics::TouchMaterial touched = touch_material({430.0, 0.7, 0.6, 0.25, 0.03});
    EXPECT_EQ(touched.stiffness_N_per_m, 430.0);
    EXPECT_EQ(touched.damping_Ns_per_m, 0.7);
    EXPECT_EQ(touched.static_friction, 0.6);
    EXPECT_EQ(touched.dynamic_friction, 0.25);
    EXPECT_EQ(touched.coulomb_velocity_m_per_s, 0.03);
    EXPECT_EQ(touched.hardness_Ns_per_m3, std::numeric_limits<double>::infinity());
}

TEST(PathMotion, WhatJumpsIsNamed) {
    const PathKey start{0.0, {}}, far{0.1, {{1.0, 0.0, 0.0}}};
    EXPECT_EQ(keys_of(problems(PathMotion{{start}})), Keys{"path"});
    EXPECT_EQ(keys_of(problems(PathMotion{{start, far}, false})), Keys{"path[1]"}) << "10 m/s";
    const PathKey later{1.0, {{1.0, 0.0, 0.0}}};
    EXPECT_TRUE(problems(PathMotion{{start, later}, false}).empty());
    EXPECT_EQ(keys_of(problems(PathMotion{{start, later}, true})), Keys{"path[1]"}) << "back to its start at once";
    EXPECT_TRUE(problems(PathMotion{{start, later, {2.0, {}}}, true}).empty());
    EXPECT_EQ(keys_of(problems(PathMotion{{{0.5, {}}, later}, false})), Keys{"path[0]"});
    EXPECT_EQ(keys_of(problems(PathMotion{{start, later, {1.0, {}}}, false})), Keys{"path[2]"});
    const Quat half = glm::angleAxis(3.0, Vec3(0.0, 1.0, 0.0));
    EXPECT_EQ(keys_of(problems(PathMotion{{start, {5.0, {Vec3(0.0), half}}}, false})), Keys{"path[1]"});
    EXPECT_EQ(keys_of(problems(PathMotion{{start, {1.0, {Vec3(NAN), half}}}, false})), Keys{"path[1]"});
}

TEST(SceneObject, ThatCouldNotBeTouchedIsNotMadeSoByAnEdit) {
    SceneObject object = test::object_at(1, test::shared_mesh(geometry::test::cube(600.0)), Vec3(0.0));
    EXPECT_FALSE(edited(object, SetScale{1e6})) << "the scene's thread would refuse it, and a document not open";
    object.felt = false;
    const auto large = edited(object, SetScale{1e6});
    ASSERT_TRUE(large) << "it is only seen";
    EXPECT_FALSE(edited(*large, SetFelt{true}));
    object.mesh = test::shared_mesh({});
    EXPECT_FALSE(edited(object, SetFelt{true}));
}

}  // namespace
}  // namespace burin::scene

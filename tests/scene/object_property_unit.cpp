// SPDX-License-Identifier: MIT
// The properties of an object by name: what is set is what is read, and nothing else changes.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scene/object_property.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

SceneObject a_cube() { return test::object_at(1, test::shared_mesh(geometry::test::cube(0.02)), {0.1, 0.2, 0.3}); }

SceneObject with(const SceneObject& object, ObjectProperty property, const PropertyValue& value) {
    return edited(object, edit_of(object, property, value)).value();
}

}  // namespace

TEST(ObjectProperty, WhatIsSetIsRead) {
    const SceneObject cube = a_cube();
    const std::vector<std::pair<ObjectProperty, PropertyValue>> values{
        {ObjectProperty::stiffness, {321.0}},
        {ObjectProperty::damping, {1.25}},
        {ObjectProperty::friction, {0.4}},
        {ObjectProperty::static_friction, {0.6}},
        {ObjectProperty::coulomb_velocity, {0.02}},
        {ObjectProperty::position, {0.5, -0.25, 0.125}},
        {ObjectProperty::orientation, {0.6, 0.0, 0.8, 1.2}},
        {ObjectProperty::scale, {2.5}},
        {ObjectProperty::colour, {1.0, 0.2, 0.0}},
        {ObjectProperty::seen, {0.0}},
        {ObjectProperty::felt, {0.0}},
    };
    for (const auto& [property, value] : values) {
        const PropertyValue read = value_of(with(cube, property, value), property);
        for (std::size_t i = 0; i < value.size(); ++i)
            EXPECT_NEAR(read.at(i), value.at(i), 1e-12) << descriptor_of(property).name << " " << i;
    }
    EXPECT_EQ(with(cube, ObjectProperty::friction, {0.4}).material.static_friction, 0.4);
    EXPECT_EQ(value_of(with(with(cube, ObjectProperty::friction, {0.4}), ObjectProperty::dynamic_friction, {0.3}),
                       ObjectProperty::dynamic_friction),
              PropertyValue{0.3});
}

TEST(ObjectProperty, APositionLeavesTheOrientationAndTheOtherWayRound) {
    SceneObject cube = a_cube();
    cube.pose.orientation = glm::angleAxis(0.7, Vec3(0.0, 1.0, 0.0));
    EXPECT_EQ(with(cube, ObjectProperty::position, {1.0, 2.0, 3.0}).pose.orientation, cube.pose.orientation);
    EXPECT_EQ(with(cube, ObjectProperty::orientation, {0.0, 0.0, 2.0, 0.5}).pose.position_m, cube.pose.position_m);
}

TEST(ObjectProperty, ImpossibleValuesAreRefusedByTheEdit) {
    const SceneObject cube = a_cube();
    for (const auto& [property, value] : std::vector<std::pair<ObjectProperty, PropertyValue>>{
             {ObjectProperty::stiffness, {-1.0}},
             {ObjectProperty::friction, {NAN}},
             {ObjectProperty::static_friction, {-0.1}},
             {ObjectProperty::dynamic_friction, {0.5}},  // above the static one, which is 0
             {ObjectProperty::coulomb_velocity, {-0.01}},
             {ObjectProperty::coulomb_velocity, {INFINITY}},
             {ObjectProperty::coulomb_velocity, {20.0}},  // mm/s
             {ObjectProperty::position, {1e9, 0.0, 0.0}},
             {ObjectProperty::scale, {0.0}},
         })
        EXPECT_FALSE(edited(cube, edit_of(cube, property, value)).has_value()) << descriptor_of(property).name;
}

TEST(ObjectProperty, EachHasItsOwnNameAndPlace) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < object_properties().size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(object_properties()[i].property), i);
        EXPECT_TRUE(names.insert(object_properties()[i].name).second);
    }
}

}  // namespace burin::scene

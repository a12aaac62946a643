// SPDX-License-Identifier: MIT
// The properties of an object that a person changes while a scene is touched, each by its name: what a command, a
// panel's slider or a script sets. One table; nobody else lists them.
// Units: SI. Pure; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/error.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

enum class ObjectProperty : std::uint8_t {
    stiffness,
    damping,
    friction,  // static and dynamic alike
    static_friction,
    dynamic_friction,
    coulomb_velocity,
    position,
    orientation,
    scale,
    colour,
    opacity,
    seen,
    felt,
};

struct PropertyDescriptor {
    ObjectProperty property = ObjectProperty::stiffness;
    std::string_view name, argument, unit;  // "stiffness", "K", "N/m"
    std::size_t numbers = 1;                // 0: on or off
};
// Lists all properties in the order of ObjectProperty.
[[nodiscard]] std::span<const PropertyDescriptor> object_properties();
[[nodiscard]] const PropertyDescriptor& descriptor_of(ObjectProperty property);

// Says in a sentence what a person changes with it.
[[nodiscard]] std::string_view help_of(ObjectProperty property);

// As many numbers as the property has; of a switch the first, 0 or 1. A position in metres; an orientation as an axis,
// which need not be a unit vector, and the angle about it in radians; a colour as sRGB from 0 to 1, an opacity from 0
// to 1.
using PropertyValue = std::array<double, 4>;

[[nodiscard]] PropertyValue value_of(const SceneObject& object, ObjectProperty property);
// Returns the edit that gives the object this value and leaves all else as it is.
[[nodiscard]] ObjectEdit edit_of(const SceneObject& object, ObjectProperty property, const PropertyValue& value);

// Refuses a value that no object can have, whatever else is true of it: a negative stiffness, no scale. The Error says
// what is wrong and what would be right, and names no place.
[[nodiscard]] Result<void> check_value(ObjectProperty property, const PropertyValue& value);

}  // namespace burin::scene

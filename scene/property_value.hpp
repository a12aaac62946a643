// SPDX-License-Identifier: MIT
// The properties of an object that a person changes while a scene is touched, each by its name, and their values: what
// a command, a panel's slider or a script sets. One table; nobody else lists them. How an object has them is said in
// scene/object_property.hpp.
// Units: SI. Pure; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

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

}  // namespace burin::scene

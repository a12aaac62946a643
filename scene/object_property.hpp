// SPDX-License-Identifier: MIT
// What a property (scene/property_value.hpp) is of an object, and the edit that sets it.
// Units: SI. Pure; any thread.
#pragma once

#include "base/error.hpp"
#include "scene/property_value.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

[[nodiscard]] PropertyValue value_of(const SceneObject& object, ObjectProperty property);
// Returns the edit that gives the object this value and leaves all else as it is.
[[nodiscard]] ObjectEdit edit_of(const SceneObject& object, ObjectProperty property, const PropertyValue& value);

// Refuses a value that no object can have, whatever else is true of it: a negative stiffness, no scale. The Error says
// what is wrong and what would be right, and names no place.
[[nodiscard]] Result<void> check_value(ObjectProperty property, const PropertyValue& value);

}  // namespace burin::scene

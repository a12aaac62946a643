// SPDX-License-Identifier: MIT
// The command that sets a property of an object of a session's world. Plain data.
#pragma once

#include <string>

#include "scene/property_value.hpp"

namespace burin::session {

// Sets one property of an object, by their names.
struct EditObject {
    std::string object;
    scene::ObjectProperty property = scene::ObjectProperty::stiffness;
    scene::PropertyValue value{};
    bool operator==(const EditObject&) const = default;
};

}  // namespace burin::session

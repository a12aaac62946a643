// SPDX-License-Identifier: MIT
#include "scene/object_property.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin::scene {
namespace {

constexpr std::array<PropertyDescriptor, 13> kProperties{{
    {ObjectProperty::stiffness, "stiffness", "K", "N/m", 1},
    {ObjectProperty::damping, "damping", "B", "N s/m", 1},
    {ObjectProperty::friction, "friction", "MU", "", 1},
    {ObjectProperty::static_friction, "static-friction", "MU", "", 1},
    {ObjectProperty::dynamic_friction, "dynamic-friction", "MU", "", 1},
    {ObjectProperty::coulomb_velocity, "coulomb-velocity", "V", "m/s", 1},
    {ObjectProperty::position, "position", "X,Y,Z", "m", 3},
    {ObjectProperty::orientation, "orientation", "AX,AY,AZ,ANGLE", "rad", 4},
    {ObjectProperty::scale, "scale", "FACTOR", "", 1},
    {ObjectProperty::colour, "colour", "R,G,B", "", 3},
    {ObjectProperty::opacity, "opacity", "A", "", 1},
    {ObjectProperty::seen, "seen", "on|off", "", 0},
    {ObjectProperty::felt, "felt", "on|off", "", 0},
}};

Quat turn_of(const PropertyValue& value) {
    const Vec3 axis(value[0], value[1], value[2]);
    const double length = glm::length(axis);
    // An axis of no length gives no rotation, whatever the angle.
    return length > 0.0 ? glm::angleAxis(value[3], axis / length) : Quat{1, 0, 0, 0};
}

PropertyValue axis_and_angle(const Quat& q) {
    const Vec3 vector(q.x, q.y, q.z);
    const double sine = glm::length(vector);
    if (!(sine > 0.0)) return {0.0, 1.0, 0.0, 0.0};
    const Vec3 axis = vector / sine;
    return {axis.x, axis.y, axis.z, 2.0 * std::atan2(sine, q.w)};
}

std::uint8_t byte_of(double part) { return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0))); }

}  // namespace

std::span<const PropertyDescriptor> object_properties() { return kProperties; }

const PropertyDescriptor& descriptor_of(ObjectProperty property) {
    return kProperties.at(static_cast<std::size_t>(property));
}

std::string_view help_of(ObjectProperty property) {
    switch (property) {
        case ObjectProperty::stiffness: return "How hard the object's surface is: newtons for each metre pressed in";
        case ObjectProperty::damping: return "How much a blow on the object is swallowed";
        case ObjectProperty::friction:
        case ObjectProperty::dynamic_friction: return "How much the object holds what slides over it";
        case ObjectProperty::static_friction: return "How much the object holds what rests on it";
        case ObjectProperty::coulomb_velocity: return "The speed up to which friction grows; 0: it holds at rest";
        case ObjectProperty::position: return "Where the object is, from where its file has it";
        case ObjectProperty::orientation: return "Turn the object about its middle, from how its file has it";
        case ObjectProperty::scale: return "How large the object is: 1 as its file has it";
        case ObjectProperty::colour: return "Give the object one colour";
        case ObjectProperty::opacity: return "How much of what is behind the object it hides";
        case ObjectProperty::seen: return "Whether the object is in the picture";
        case ObjectProperty::felt: return "Whether the object is felt";
    }
    return {};
}

PropertyValue value_of(const SceneObject& object, ObjectProperty property) {
    const HapticMaterial& m = object.material;
    switch (property) {
        case ObjectProperty::stiffness: return {m.stiffness_N_per_m};
        case ObjectProperty::damping: return {m.damping_Ns_per_m};
        case ObjectProperty::friction:
        case ObjectProperty::dynamic_friction: return {m.dynamic_friction};
        case ObjectProperty::static_friction: return {m.static_friction};
        case ObjectProperty::coulomb_velocity: return {m.coulomb_velocity_m_per_s};
        case ObjectProperty::position: {
            const Vec3 p = displacement_m(object);
            return {p.x, p.y, p.z};
        }
        case ObjectProperty::orientation: return axis_and_angle(object.pose.orientation);
        case ObjectProperty::scale: return {object.scale};
        case ObjectProperty::colour:
            return {object.colour[0] / 255.0, object.colour[1] / 255.0, object.colour[2] / 255.0};
        case ObjectProperty::opacity: return {object.opacity};
        case ObjectProperty::seen: return {object.seen ? 1.0 : 0.0};
        case ObjectProperty::felt: return {object.felt ? 1.0 : 0.0};
    }
    return {};
}

ObjectEdit edit_of(const SceneObject& object, ObjectProperty property, const PropertyValue& value) {
    HapticMaterial material = object.material;
    const auto placed = [&](const Vec3& displaced_m, const Quat& orientation) {
        return SetPose{turned_about_pivot(object, displaced_m, orientation, object.scale)};
    };
    switch (property) {
        case ObjectProperty::stiffness: material.stiffness_N_per_m = value[0]; break;
        case ObjectProperty::damping: material.damping_Ns_per_m = value[0]; break;
        case ObjectProperty::friction: material.static_friction = material.dynamic_friction = value[0]; break;
        case ObjectProperty::static_friction: material.static_friction = value[0]; break;
        case ObjectProperty::dynamic_friction: material.dynamic_friction = value[0]; break;
        case ObjectProperty::coulomb_velocity: material.coulomb_velocity_m_per_s = value[0]; break;
        case ObjectProperty::position: return placed(Vec3(value[0], value[1], value[2]), object.pose.orientation);
        case ObjectProperty::orientation: return placed(displacement_m(object), turn_of(value));
        case ObjectProperty::scale: return SetScale{value[0]};
        case ObjectProperty::colour: return SetColour{{byte_of(value[0]), byte_of(value[1]), byte_of(value[2])}};
        case ObjectProperty::opacity: return SetOpacity{value[0]};
        case ObjectProperty::seen: return SetSeen{value[0] != 0.0};
        case ObjectProperty::felt: return SetFelt{value[0] != 0.0};
    }
    return SetMaterial{material};
}

Result<void> check_value(ObjectProperty property, const PropertyValue& value) {
    SceneObject any;
    any.name = "any";
    // What slides is held no harder than what sticks: each of both frictions is bounded by the other here alone.
    any.material.static_friction = kMaxFriction;
    any.material.dynamic_friction = 0.0;
    const ObjectEdit edit = edit_of(any, property, value);
    if (const auto done = edited(std::move(any), edit); !done) return fail("", done.error().what, done.error().remedy);
    return {};
}

}  // namespace burin::scene

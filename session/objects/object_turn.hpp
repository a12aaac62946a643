// SPDX-License-Identifier: MIT
// How an object is turned, as three angles that a person can set one by one: first it leans, then it nods, then it
// turns about what points up. Every orientation has such angles. Degrees. Pure; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/object_property.hpp"

namespace burin::session {

// Turn about +Y (-180 to 180), nod about +X (-90 to 90), lean about +Z (-180 to 180).
using ObjectTurn = std::array<double, 3>;

[[nodiscard]] inline ObjectTurn turn_of(const Quat& q) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    const auto m = glm::mat3_cast(glm::normalize(q));  // m[column][row]
    const double sine = std::clamp(-m[2][1], -1.0, 1.0);
    if (std::abs(sine) > 1.0 - 1e-9)  // it nods so far that turning and leaning are one
        return {kDegrees * std::atan2(-m[0][2], m[0][0]), kDegrees * std::asin(sine), 0.0};
    return {kDegrees * std::atan2(m[2][0], m[2][2]), kDegrees * std::asin(sine),
            kDegrees * std::atan2(m[0][1], m[1][1])};
}

[[nodiscard]] inline Quat orientation_of(const ObjectTurn& turn) {
    constexpr double kRadians = std::numbers::pi / 180.0;
    return glm::angleAxis(kRadians * turn[0], Vec3(0.0, 1.0, 0.0)) *
           glm::angleAxis(kRadians * turn[1], Vec3(1.0, 0.0, 0.0)) *
           glm::angleAxis(kRadians * turn[2], Vec3(0.0, 0.0, 1.0));
}

// As the property `orientation` has it: an axis and an angle.
[[nodiscard]] inline scene::PropertyValue orientation_value(const ObjectTurn& turn) {
    const Quat q = orientation_of(turn);
    const Vec3 vector(q.x, q.y, q.z);
    const double sine = glm::length(vector);
    if (!(sine > 1e-12)) return {0.0, 1.0, 0.0, 0.0};
    return {vector.x / sine, vector.y / sine, vector.z / sine, 2.0 * std::atan2(sine, q.w)};
}

}  // namespace burin::session

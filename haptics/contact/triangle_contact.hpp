// SPDX-License-Identifier: MIT
// A ball and one triangle: nearest point, and the time at which a moving ball touches.
// Any one frame and unit of length; triangles must not be degenerate (for_each_triangle_near leaves those out). Pure,
// no heap, no throw.
#pragma once

#include <cstdint>

#include "geometry/mesh/triangle.hpp"

namespace burin::haptics {

// The unit normal that points outwards.
[[nodiscard]] Vec3 outward_normal(const geometry::Triangle& t) noexcept;

struct NearestOnTriangle {
    Vec3 point{0.0};
    bool on_face = false;  // inside the triangle; else on an edge or a corner
};

[[nodiscard]] NearestOnTriangle nearest_on_triangle(const Vec3& p, const geometry::Triangle& t) noexcept;

// The smallest fraction of `motion`, 0 to 1, at which a ball of this radius around `center` touches the triangle from
// outside; kNoTouch when it does not. A ball that already overlaps is not held back: the caller's planes do that.
[[nodiscard]] double fraction_until_touch(const Vec3& center, const Vec3& motion, double radius,
                                          const geometry::Triangle& t) noexcept;

// The same for a point of a surface with this normal there; zero: it is touched from any side.
[[nodiscard]] double fraction_until_touch(const Vec3& center, const Vec3& motion, double radius, const Vec3& point,
                                          const Vec3& normal) noexcept;

// The tangent of half the solid angle of the triangle seen from p, at most 1e3 in size; negative where p is on the
// outer side (van Oosterom and Strackee 1983).
[[nodiscard]] double solid_angle_tangent(const Vec3& p, const geometry::Triangle& t) noexcept;

inline constexpr double kNoTouch = 2.0;  // what fraction_until_touch returns when there is none

}  // namespace burin::haptics

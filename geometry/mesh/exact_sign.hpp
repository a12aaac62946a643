// SPDX-License-Identifier: MIT
// Tells on which side of a line or a plane a point lies, without rounding: a quick estimate with a bound on its error,
// and exact arithmetic on sums of doubles where the estimate does not decide (Shewchuk 1997, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates").
// Exact for coordinates that are 0 or of magnitude 1e-70 to 1e70. Pure functions; 5 ns, or some microseconds when the
// points lie in one plane that is not perpendicular to an axis.
#pragma once

#include "base/space.hpp"

namespace burin::geometry {

// Returns 1 when d lies on the side of the plane from which a, b, c run counter-clockwise, -1 on the other, 0 on the
// plane.
[[nodiscard]] int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Returns 1 when a, b, c run counter-clockwise, x to the right and y upwards, -1 when clockwise, 0 when they lie on one
// line.
[[nodiscard]] int turn_in_plane(const Vec2& a, const Vec2& b, const Vec2& c);

// Returns the orientation of a, b, c projected along an axis onto the other two, (axis + 1) % 3 to the right and (axis
// + 2) % 3 upwards: 1 when they run counter-clockwise, -1 clockwise, 0 when they lie on one line.
[[nodiscard]] int turn_seen_along(int axis, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace burin::geometry

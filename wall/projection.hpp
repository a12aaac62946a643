// SPDX-License-Identifier: MIT
// The off-axis projection of a head-tracked screen: what is drawn appears at its true position in the environment.
// Kooima, "Generalized Perspective Projection" (2009), with Vulkan's clip space: depth 0 at the near plane and 1 at the
// far plane, y downwards. Pure functions; any thread.
#pragma once

#include "wall/screen.hpp"

namespace burin::wall {

// Returns clip_from_world. near_m and far_m are distances from the eye along the screen's normal, 0 < near_m < far_m;
// the eye lies in front of the screen. A broken condition is a broken contract (BURIN_CHECK).
[[nodiscard]] Mat4 off_axis_projection(const Screen& screen, const Vec3& eye_world, double near_m, double far_m);

// A screen's plane, for many points: its axes are computed once.
class ScreenPlane {
public:
    explicit ScreenPlane(const Screen& screen);

    // Intersection of the line from the eye through a point with the plane: x_m from the screen's lower left corner to
    // the right, y_m upwards. Computed without any matrix. The point must not lie in the eye's plane.
    [[nodiscard]] Vec2 point_seen(const Vec3& eye_world, const Vec3& point_world) const;
    // How far in front of the plane a point lies, in metres; negative behind it.
    [[nodiscard]] double distance_in_front(const Vec3& point_world) const;

private:
    Vec3 origin_world_, right_, up_, normal_;
};

// The same of a screen, for a single point.
[[nodiscard]] Vec2 point_on_screen(const Screen& screen, const Vec3& eye_world, const Vec3& point_world);
[[nodiscard]] double distance_in_front(const Screen& screen, const Vec3& point_world);

// True when the screen is a rectangle with area and finite corners and both eyes are at least 1 cm in front of it: the
// precondition of render().
[[nodiscard]] bool can_be_seen(const Screen& screen, const Eyes& eyes);

}  // namespace burin::wall

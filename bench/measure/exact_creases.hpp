// SPDX-License-Identifier: MIT
// Exact points on the edges of "the unit cube without a union of swept balls", from closed forms: a mesh of that solid
// must pass through them. Metres, object frame. The points of a set lie about evenly along its edges.
#pragma once

#include <vector>

#include "bench/measure/scenes.hpp"
#include "bench/measure/swept_union.hpp"

namespace burin::bench {

// Returns points on the cube's twelve edges, `an_edge` each, where the union is farther away than clearance_m.
[[nodiscard]] std::vector<Vec3> untouched_edge_points(const SweptUnion& tools, int an_edge, double clearance_m);

// Returns the cube's corners that have the same clearance.
[[nodiscard]] std::vector<Vec3> untouched_corners(const SweptUnion& tools, double clearance_m);

// Returns points where the union's surface meets the cube's faces: the
// ends of what the union covers on `lines` lines a face and direction.
[[nodiscard]] std::vector<Vec3> rim_points(const CarveScene& scene, int lines);

// Returns points where two balls of a scene of stamps meet inside the cube at an angle of more than least_angle_rad,
// about every step_m along the circle, except where a third ball removes them.
[[nodiscard]] std::vector<Vec3> ball_ball_crease_points(const CarveScene& scene, const SweptUnion& tools,
                                                        double least_angle_rad, double step_m);

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
// A cutting ball that a hand presses into a plane at height 0.
#pragma once

#include "haptics/forces/cutting.hpp"
#include "tests/haptics/cutting_ball.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics::test {

inline constexpr double kRadius_m = 0.003, kStiffness = 600.0;
inline constexpr EngagementWork kPlenty{1'000'000, 1'000'000};

inline const ToolSurface& ball() {
    static const ToolSurface tool = ball_tool(kRadius_m);
    return tool;
}
inline const geometry::LocalSurface& flat() {
    static const Surface surface = plane(0.05, 200);
    return *surface;
}

// A hand whose ball's lowest point is at this depth under the plane.
inline CuttingInput pressing(double depth_m, double dt_s = 1e-3) {
    CuttingInput in;
    in.hip_object_m = {0.0, kRadius_m - depth_m, 0.0};
    in.proxy_object_m = {0.0, kRadius_m, 0.0};
    in.cutting = in.in_contact = true;
    in.stiffness_N_per_m = kStiffness;
    in.dt_s = dt_s;
    return in;
}

}  // namespace burin::haptics::test

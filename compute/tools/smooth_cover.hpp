// SPDX-License-Identifier: MIT
// The balls in which a tool smooths. A ball smooths within itself. Any other tool smooths within balls about as wide as
// its least width, which stand through its body closely enough to leave no part of it out, one after the other.
// Tool frame, metres. Pure; any thread.
#pragma once

#include <vector>

#include "compute/tools/tool.hpp"

namespace burin::compute {

struct SmoothCover {
    std::vector<Vec3> middles_m;
    double radius_m = 0.0;  // of each
};

inline constexpr int kMostSmoothBalls = 64;

[[nodiscard]] SmoothCover smooth_cover(const ToolShape& shape);

}  // namespace burin::compute

// SPDX-License-Identifier: MIT
// The balls in which a tool smooths. A ball smooths within itself. Any other tool smooths within balls about as wide as
// its least width, which stand through its body closely enough to leave no part of it out, one after the other.
// Tool frame, metres, but for the balls of a sweep: object frame. Pure; any thread.
#pragma once

#include <vector>

#include "compute/tools/smooth.hpp"
#include "compute/tools/tool.hpp"

namespace burin::compute {

struct SmoothCover {
    std::vector<Vec3> middles_m;
    double radius_m = 0.0;  // of each
};

inline constexpr int kMostSmoothBalls = 64;

[[nodiscard]] SmoothCover smooth_cover(const ToolShape& shape);

// The balls of a sweep in the order in which they smooth, each the solid that the one before has left: along the sweep
// in stretches of at most kSmoothStretch radii; in each stretch, those of the cover.
class SmoothBalls {
public:
    explicit SmoothBalls(const ToolSweep& sweep);
    [[nodiscard]] std::size_t size() const { return stretches_ * cover_.middles_m.size(); }
    [[nodiscard]] SmoothBall operator[](std::size_t i) const;

private:
    [[nodiscard]] Pose pose_at(double part) const;

    Pose start_, end_;
    bool turns_ = false;
    double strength_ = 0.0;
    std::uint8_t material_ = 0;
    SmoothCover cover_;
    std::size_t stretches_ = 1;
};

}  // namespace burin::compute

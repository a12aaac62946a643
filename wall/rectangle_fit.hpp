// SPDX-License-Identifier: MIT
// The rectangle of least squares through points on it; calibration.hpp has the formulas. Metres; pure, any thread.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "renderer/stereo/calibration.hpp"

namespace burin {

struct FitPoint {
    ScreenPlace place;
    Vec3 at_tracker;
};

struct FitRectangle {
    Vec3 centre, right, up;  // right and up: unit vectors at right angles
    double width_m, height_m;
};

// From the rectangle to the point, along its own directions; 0 along an edge whose point may be anywhere on it.
struct FitResidual {
    double right_m, up_m, out_m;
    [[nodiscard]] double length_m() const { return std::sqrt(right_m * right_m + up_m * up_m + out_m * out_m); }
};
[[nodiscard]] FitResidual residual(const FitRectangle& rectangle, const FitPoint& point);

// From points whose both coordinates are known; nothing when those leave it open.
[[nodiscard]] std::optional<FitRectangle> rough_rectangle(std::span<const FitPoint> points);

// The rectangle of least squares near a rough one; nothing when the points leave it open.
[[nodiscard]] std::optional<FitRectangle> refine(FitRectangle rectangle, std::span<const FitPoint> points,
                                                 bool keep_size);

}  // namespace burin

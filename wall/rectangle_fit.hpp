// SPDX-License-Identifier: MIT
// The least-squares rectangle through points on it: the inner part of fit_screen(), whose header has the formulas
// (wall/calibration.hpp). Metres, tracker frame. Pure functions, any thread; allocate. Points that leave the rectangle
// open are an expected outcome here, std::nullopt, and an Error with its remedy in fit_screen().
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "wall/calibration.hpp"

namespace burin::wall {

// A touch: the place on the screen that was meant, and where the wand was.
struct FitPoint {
    ScreenPlace place;
    Vec3 at_tracker;
};

struct FitRectangle {
    Vec3 centre, right, up;  // right and up: unit vectors at right angles
    double width_m, height_m;
};

// Vector from the rectangle to the point, in the rectangle's axes; 0 along an edge on which the point may lie anywhere.
struct FitResidual {
    double right_m, up_m, out_m;
    [[nodiscard]] double length_m() const { return std::sqrt(right_m * right_m + up_m * up_m + out_m * out_m); }
};
[[nodiscard]] FitResidual residual(const FitRectangle& rectangle, const FitPoint& point);

// A first estimate from points with both coordinates known; nothing when they do not determine it.
[[nodiscard]] std::optional<FitRectangle> rough_rectangle(std::span<const FitPoint> points);

// The least-squares rectangle near a first estimate; nothing when the points do not determine it.
[[nodiscard]] std::optional<FitRectangle> refine(FitRectangle rectangle, std::span<const FitPoint> points,
                                                 bool keep_size);

}  // namespace burin::wall

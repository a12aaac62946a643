// SPDX-License-Identifier: MIT
// Screen calibration: the position of a screen from where the tip of a tracked wand was while it touched known places
// on it.
//
// The least-squares rectangle: centre C, unit vectors r (right) and s (up) at right angles, width W, height H, such
// that sum |x_i - C - (u_i - 1/2) W r - (v_i - 1/2) H s|^2 is least over the samples x_i, where (u, v) is the position
// on the screen, 0 to 1 rightwards and upwards. For a place on an edge only one of u, v is known; such a sample has no
// residual along the edge. Solved by Gauss-Newton over a small rotation, C, W and H, from a plane through the medians
// of each place's samples.
//
// Outliers: a sample whose distance from the fit exceeds five standard deviations (of one coordinate, from the median
// of all, and at least 0.5 mm) is excluded and reported; the fit is repeated without it, until nothing changes.
// With noise of standard deviation s in each coordinate and no outlier the residuals' mean square is s^2 (3 N - 8) / N
// for N samples of known places (N - 6 where the size is known).
//
// Tracker frame, metres. Pure, any thread; allocates.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "wall/wall.hpp"

namespace burin::wall {

// A place on a screen: both coordinates, or the one that an edge fixes.
struct ScreenPlace {
    std::optional<double> u, v;  // 0 to 1: from left to right, from bottom to top
};

// Parses a place: "lower_left", "lower_right", "upper_left", "upper_right"; "left", "right", "bottom", "top" for a
// point anywhere on that edge; "0.25:0.5" for u:v. Nothing for any other text.
[[nodiscard]] std::optional<ScreenPlace> screen_place(const std::string& name);

struct CalibrationSample {
    std::string place;  // in the syntax of screen_place()
    Vec3 tip_tracker{0.0};
};

struct ScreenSize {
    double width_m, height_m;
};

struct PlaceResidual {
    std::string place;
    int samples = 0;  // without outliers
    double rms_mm = 0.0;
};

struct SampleOutlier {
    std::size_t index = 0;  // into the samples given
    std::string place;
    double distance_mm = 0.0;
};

struct ScreenFit {
    Vec3 lower_left_tracker{0.0}, lower_right_tracker{0.0}, upper_left_tracker{0.0};
    double width_m = 0.0, height_m = 0.0;
    double rms_mm = 0.0;  // root mean square distance of the samples used
    double max_mm = 0.0;
    std::vector<PlaceResidual> places;  // in the order of their first samples
    std::vector<SampleOutlier> outliers;
};

// Fits a screen to samples. Fails on unknown place names, numbers that are not finite, samples that do not determine
// the rectangle (fewer than three corners' worth of places, places on one line), places whose samples contradict one
// another, and a result of implausible size.
[[nodiscard]] Result<ScreenFit> fit_screen(std::span<const CalibrationSample> samples,
                                           const std::optional<ScreenSize>& known_size = std::nullopt);

// Distances of samples from an existing screen: what fit_screen() improves on.
struct SampleDistances {
    double rms_mm = 0.0;
    double max_mm = 0.0;
};
[[nodiscard]] Result<SampleDistances> distances_from(const WallScreen& screen,
                                                     std::span<const CalibrationSample> samples);

}  // namespace burin::wall

// SPDX-License-Identifier: MIT
// A path in space by itself and beside a centreline. Paths are polylines; lengths in the points' unit, metres here. NaN
// where a measure is not defined: too few points, a coordinate that is not finite, a path without length where it is
// divided by. Pure; any thread; allocates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin::study {

// 0 for a single point; NaN for none.
[[nodiscard]] double path_length_m(std::span<const Vec3> points_m);

// The straight distance from first to last point, or the length of the path that was to be followed, divided by the
// length of the path taken. 1: nothing was wasted.
[[nodiscard]] double economy_of_path(std::span<const Vec3> points_m);
[[nodiscard]] double economy_of_path(std::span<const Vec3> points_m, double ideal_length_m);

// Mean and largest of distances.
struct Distances {
    double mean_m = 0.0, largest_m = 0.0;
};

// From each point to the nearest place of the centreline. The mean is by weights, the seconds that each point stands
// for (even_motion.hpp), or of all points alike without any. Cost: the product of both sizes.
[[nodiscard]] Distances distances_to_centreline(std::span<const Vec3> points_m, std::span<const Vec3> centreline_m,
                                                std::span<const double> weights = {});

// Between places that lie at the same share of either path's length, at `places` equal shares from start to end (at
// least 2). Unlike the nearest distance it sees going back and forth, and it does not depend on speed.
[[nodiscard]] Distances arc_length_matched(std::span<const Vec3> points_m, std::span<const Vec3> centreline_m,
                                           std::size_t places = 1001);

// The discrete Frechet distance (Eiter and Mannila, "Computing discrete Frechet distance", 1994): the least, over all
// ways to go along both lists of points without turning back, of the largest distance on the way. It lies above the
// distance of the polylines by at most the longest step of either. Cost: the product of both sizes in time.
[[nodiscard]] double frechet_distance_m(std::span<const Vec3> points_m, std::span<const Vec3> centreline_m);

// `places` points at equal shares of the path's length, its ends among them.
[[nodiscard]] std::vector<Vec3> resampled(std::span<const Vec3> points_m, std::size_t places);

}  // namespace burin::study

// SPDX-License-Identifier: MIT
// Smoothing of the surface within a ball that moves along a segment.
//
// The rays' ends are points of the surface with normals. Each lattice node near the surface gets its distance from the
// plane through the nearest end, with the sign that the z rays give it. This field is filtered along each axis with the
// kernel (-1 4 10 4 -1) / 16, which removes noise of a cell or two but reproduces cubics: planes are kept to the bit,
// and a ball does not shrink as it would under (1 2 1) / 4. The filtered value is blended in with the node's weight,
// strength (1 - (d / R)^2)^2 at distance d from the path of the tool's centre.
//
// Then, on all three axes, every lattice edge with a node of weight above zero gets an end where the new signs differ:
// an existing end is moved and turned by what the filter changed, a missing one is made from the new values. So all
// three directions agree about every node within the tool, and ends farther out are unchanged, as are slivers, which
// are two ends on one edge.
// Nodes on the border of the lattice have no weight.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

struct SmoothBall {
    Vec3 start_object_m{0.0}, end_object_m{0.0};
    double radius_m = 0.0;  // at most kLargestSmoothCells cells
    double strength = 0.5;  // 0 to 1
    // Material of new surface that has no end near it from which to take one.
    std::uint8_t material = 0;
};

inline constexpr double kLargestSmoothCells = 100.0;

// Returns the rays that change, with their new ends. The path from start to end should be no longer than the radius,
// since time and memory grow with its bounding box. The result does not depend on the number of threads.
[[nodiscard]] RayBatch smoothed_rays(const Solid& solid, const SmoothBall& ball, WorkerPool& pool);

}  // namespace burin::compute

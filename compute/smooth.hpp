// SPDX-License-Identifier: MIT
// Evening out the surface within a ball.
//
// The rays' ends are points of the surface with normals. A node of the lattice near the surface gets the signed distance from
// the plane through its nearest end, with the sign that the z rays give it. That field is filtered with the kernel
// (-1 4 10 4 -1) / 16 along each axis, which takes noise of a cell or two away but reproduces cubics: planes stay to the bit,
// and a ball does not shrink as it would under (1 2 1) / 4. The filtered value counts by the node's weight,
// strength (1 - (d / R)^2)^2 for a node at distance d from the tool's way.
//
// Then every edge of the lattice with a node of weight above zero is crossed where the new signs say so, on all three axes: an
// end that was there moves and turns by what the filter changed, a new one comes from the new values. So all three directions
// agree about every node within the tool, and ends farther out stay as they are. Slivers, two ends on one edge, stay too.
// Nodes on the border of the lattice have no weight.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/ray_batch.hpp"
#include "compute/solid.hpp"

namespace burin {

struct SmoothBall {
    Vec3 start_object_m{0.0}, end_object_m{0.0};
    double radius_m = 0.0;      // at most kLargestSmoothCells cells
    double strength = 0.5;      // 0 to 1
    std::uint8_t material = 0;  // of surface that is new and has nothing near to take after
};

inline constexpr double kLargestSmoothCells = 100.0;

// The rays that change, with their new ends. The way from start to end should be no longer than the radius: time and memory
// go with the box around it. Does not depend on the number of threads.
[[nodiscard]] RayBatch smoothed_rays(const Solid& solid, const SmoothBall& ball, WorkerPool& pool);

}  // namespace burin

// SPDX-License-Identifier: MIT
// Smoothing of the surface within a ball that moves along a segment.
//
// The rays' ends are points of the surface with normals; an end stands for the area that its ray's share of the cells'
// faces has there. The smoothed surface is the zero level of a mean over them (smooth_field.hpp), whose width is a
// length that follows from the ball's radius, the strength and how much of the path lies near; it falls off to the
// ball's border. No sum runs over lattice nodes, so the same edge is rounded alike wherever it lies on the lattice and
// however fine that is. A path counts by its length, so it does not matter into how many pieces it is cut.
// Kernels narrower than 3 cells would see too few ends. There the surface moves a share of the way that a kernel of
// that width moves it.
//
// Nodes next to the surface change sides where the field says so, then the neighbours of those that did. On all three
// axes every lattice edge with a node within the tool gets an end where the sides differ, at the field's zero on it,
// with the field's gradient as the normal: so all three directions agree about every node within the tool. Two ends on
// one edge stay where the field says that there is something between them. What is farther out is unchanged, bit for
// bit. Nodes on the border of the lattice are never changed.
// This is the processor's way, and the reference. A device that rounds as the processor does gives the same bits
// (compute/vulkan/smooth_passes.hpp): what both compute is in shaders/shared/smooth_ball.h and smooth_field.h.
#pragma once

#include <array>
#include <cstdint>

#include "base/worker_pool.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"
#include "shaders/shared/smooth_ball.h"

namespace burin::compute {

struct SmoothBall {
    Vec3 start_object_m{0.0}, end_object_m{0.0};
    double radius_m = 0.0;  // at most kLargestSmoothCells cells
    double strength = 0.5;  // 0 to 1
    // Material of new surface that has no end near it from which to take one.
    std::uint8_t material = 0;
};

inline constexpr double kLargestSmoothCells = 100.0;
// The longest path that is smoothed at once, in radii.
inline constexpr double kSmoothStretch = 0.25;

// Describes the smoothing of one ball, in cells.
struct SmoothRegion {
    shared::SmoothPath path;
    double most_width = 0.0;        // of the kernel
    std::array<int, 3> lo{}, hi{};  // of the nodes that the tool may reach: none on the lattice's border
    [[nodiscard]] bool is_empty() const {
        return !(path.most_width2 > 0.0) || lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2];
    }
    // The reach of the field: ends farther from the path do not count.
    [[nodiscard]] double reach() const { return path.radius + most_width + 1.0; }
};
[[nodiscard]] SmoothRegion smooth_region(const Lattice& lattice, const SmoothBall& ball);

// Returns the rays that change, with their new ends. A start that equals the end is a stamp and counts as a path of a
// quarter of the radius. The path should be no longer than kSmoothStretch radii: what a longer one has smoothed does
// not count until its end. The result does not depend on the number of threads.
[[nodiscard]] RayBatch smoothed_rays(const Solid& solid, const SmoothBall& ball, WorkerPool& pool);

}  // namespace burin::compute

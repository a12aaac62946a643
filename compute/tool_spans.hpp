// SPDX-License-Identifier: MIT
// What a tool's sweep covers of each ray in its footprint, worked out on the host.
//
// Shape and motion            how
//   ball                      exact integer predicate (shaders/shared/capsule.h), whatever its orientation
//   cylinder, cone, box       closed form for a move at fixed orientation (convex_sweep.hpp)
//   bull-nose                 the same, its corner cut into slices of cones (round_corner below)
//   mesh                      its triangles posed, swept and crossed exactly (mesh_tool.hpp)
//   any of them, turning      straight moves at fixed orientations, united (turning_sweep.hpp)
// Only turning and the bull-nose's corner are not exact; both keep their error below ToolSweep::tolerance_cells.
//
// A tool that covers lo..hi of a ray gets the interval [ceil(lo), floor(hi)), clipped to the lattice; pieces with less than a
// unit of depth between them are one. The tool's true place is used, not one rounded to whole units (a mesh's corners are
// rounded; so is a ball's middle, so that both engines agree).
// The batch is in order of axis, row and place, and does not depend on the number of threads.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/ray_batch.hpp"
#include "compute/solid.hpp"
#include "compute/tool.hpp"

namespace burin {

// The rays that the tool covers a part of, with its intervals on them: outward normals of the tool, and its material. Fails on
// a tool, pose, tolerance or material that cannot be (check_sweep says what those are).
[[nodiscard]] Result<RayBatch> tool_spans(const Solid& solid, const ToolSweep& sweep, WorkerPool& pool);

// The same refusals without the work: a size that is not above zero or not finite, a corner radius above the radius, a tool
// that measures more than 4096 cells from its middle, a mesh that is not closed and consistently turned outwards; and those of
// straight_moves (turning_sweep.hpp) and capsules_in_units (sweep_units.hpp).
[[nodiscard]] Result<void> check_sweep(const Solid& solid, const ToolSweep& sweep);

}  // namespace burin

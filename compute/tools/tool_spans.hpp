// SPDX-License-Identifier: MIT
// Computes on the host what a tool's sweep covers of each ray in its footprint.
//
// Shape and motion            method
//   ball                      exact integer predicate (shaders/shared/capsule.h), whatever its orientation
//   cylinder, cone, box       closed form for a move at fixed orientation (convex_sweep.hpp)
//   bull-nose                 the same, its corner cut into slices of cones (convex_pieces.hpp)
//   mesh                      exact crossings of its posed and swept triangles (mesh_tool.hpp)
//   any of them, turning      union of straight moves at fixed orientations (turning_sweep.hpp)
// Only turning and the bull-nose's corner are not exact; both keep their error below ToolSweep::tolerance_cells.
//
// A tool that covers lo..hi of a ray gets the interval [ceil(lo), floor(hi)), clipped to the lattice; pieces that are
// less than one unit of depth apart are joined. Positions of tools are not rounded to whole units, except for the
// vertices of a mesh and for the centre of a ball, on which both engines thus agree.
// The batch is ordered by axis, row v and position u, and does not depend on the number of threads.
#pragma once

#include <cstdint>

#include "base/worker_pool.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"
#include "compute/tools/convex_pieces.hpp"
#include "compute/tools/tool.hpp"

namespace burin::compute {

// Returns the rays of which the tool covers a part, with the intervals covered, the tool's outward normals and its
// material. Fails on an invalid tool, pose, tolerance or material (see check_sweep).
[[nodiscard]] Result<RayBatch> tool_spans(const Solid& solid, const ToolSweep& sweep, WorkerPool& pool);

// Returns the convex pieces that tool_spans takes the sweep for; none for a ball or a mesh. Fails as tool_spans does.
[[nodiscard]] Result<ConvexPieces> convex_pieces(const Lattice& lattice, const ToolSweep& sweep);

// Holds what convex pieces cover of the rays, and counts the sections of a ray with a piece that were computed for it.
// These are the work, most of which is left out where a tool turns (ray_union.hpp).
struct ConvexSpans {
    RayBatch batch;
    std::uint64_t sections = 0;
};
[[nodiscard]] ConvexSpans convex_spans(const Lattice& lattice, const ConvexPieces& sweep, std::uint8_t material,
                                       WorkerPool& pool);

// Fails as tool_spans does, without computing the spans: on a size that is not above zero or not finite, a corner
// radius above the radius, a tool that measures more than 4096 cells from its middle, a mesh that is not closed and
// consistently oriented outwards, and on what straight_moves (turning_sweep.hpp) and capsules_in_units
// (sweep_units.hpp) reject.
[[nodiscard]] Result<void> check_sweep(const Solid& solid, const ToolSweep& sweep);

}  // namespace burin::compute

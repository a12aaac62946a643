// SPDX-License-Identifier: MIT
// A closed mesh as a tool: any pose, straight moves, exact crossings with the rays in its footprint.
//
// The solid that a closed surface sweeps on a straight path d is the union of what it holds at the start and of the
// prisms that each forward-facing triangle (n.d > 0) sweeps from start to end: a point that the tool comes to cover on
// the way is entered through such a triangle. When all of these surfaces are added with their windings, the prisms'
// bottoms cancel the forward triangles at the start, and the walls between two forward triangles cancel each other.
// The surface that remains has about as many triangles as the mesh itself:
//   backward triangles at the start, forward triangles at the end, and a strip along each edge of the outline between
//   them.
// A depth is inside where the winding number is above zero. So a sweep is exact and costs as much as a stamp; there are
// no scallops and there is no step length to choose. Several moves form one surface that contains all their triangles.
//
// The triangles are posed and intersected with the rays; the tool is not sampled on a lattice of its own. Resampling
// would round every edge of the tool by half a cell, lose thinner features and give no normals at edges. Rays would
// cross the lattice of a turned tool at any angle and could disagree about what is inside. Posing costs a rotation a
// vertex, and the crossings are those of scan conversion, in the same integers, so that a block carved by its own mesh
// leaves nothing.
// Vertices are rounded to whole lattice units, as in scan conversion.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/tools/tool.hpp"
#include "compute/tools/turning_sweep.hpp"
#include "geometry/mesh/edge_table.hpp"

namespace burin::compute {

struct MeshToolEdges {
    std::vector<geometry::EdgeUse> uses;
    Vec3 middle_m{0.0};
    double radius_m = 0.0;  // of a ball about middle_m that contains the mesh
};

// Checks the mesh and collects its edges, once for any number of sweeps. Fails on a mesh that is missing, empty, not
// finite, open, not consistently oriented, or turned inside out.
[[nodiscard]] Result<MeshTool> prepare_mesh_tool(std::shared_ptr<const geometry::TriangleMesh> mesh);

// Returns the tool's extent in the tool frame, in lattice units. The tool must be prepared. Fails when it is too large.
[[nodiscard]] Result<Extent> extent_of(const MeshTool& tool, double unit_m);

// Fails when there are so many moves and triangles that one sweep would take minutes.
[[nodiscard]] Result<void> check_effort(const MeshTool& tool, std::span<const StraightMove> moves);

inline constexpr std::size_t kTrianglesAtOnce = 4'000'000;  // about 300 MB of tables

// Returns what the tool covers on the given moves, with one material; fails as check_effort does. Moves with more than
// `triangles_at_once` triangles in all are processed in several batches, which does not affect the intervals.
[[nodiscard]] Result<RayBatch> mesh_spans(const Lattice& lattice, const MeshTool& tool,
                                          std::span<const StraightMove> moves, std::uint8_t material, WorkerPool& pool,
                                          std::size_t triangles_at_once = kTrianglesAtOnce);

}  // namespace burin::compute

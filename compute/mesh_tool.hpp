// SPDX-License-Identifier: MIT
// A closed mesh as a tool: posed anywhere, moved straight, crossed exactly by the rays in its footprint.
//
// The solid that a closed surface sweeps on a straight way d is what it holds at the start, and the prisms between start and
// end of every triangle that looks forwards (n.d > 0): a point that the tool comes to hold on the way is entered through such a
// triangle. Added up as surfaces with their windings, the prisms' bottoms cancel the forward triangles at the start, and the
// walls between two forward triangles cancel each other. What remains is as large as the mesh itself:
//   backward triangles at the start, forward triangles at the end, and a strip along each edge of the outline between them.
// Inside is where the winding number is above zero. So a sweep is exact and costs what a stamp costs; there are no scallops and
// no step to choose. Several moves are one surface with all their triangles.
//
// The triangles are posed and crossed; the tool is not sampled on a lattice of its own and looked up. Resampling would round
// every edge of the tool by half a cell and lose what is thinner, would give no normals at edges, and a turned look-up crosses
// cells at any angle, so that rays could disagree about what is inside. Posing costs a rotation a vertex, and the crossings are
// those of scan conversion: the same integers, so that a block carved by its own mesh leaves nothing.
// Corners are rounded to whole lattice units, as in scan conversion.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/ray_batch.hpp"
#include "compute/tool.hpp"
#include "compute/turning_sweep.hpp"
#include "geometry/edge_table.hpp"

namespace burin {

struct MeshToolEdges {
    std::vector<EdgeUse> uses;
    Vec3 middle_m{0.0};
    double radius_m = 0.0;  // of a ball about the middle that holds the mesh
};

// Looks at the mesh once, for any number of sweeps. Fails on a mesh that is missing, empty, not finite, open or not consistently
// oriented, or turned inside out.
[[nodiscard]] Result<MeshTool> prepare_mesh_tool(std::shared_ptr<const TriangleMesh> mesh);

// Tool frame, lattice units; the tool must be prepared. Fails on one that is too large.
[[nodiscard]] Result<Extent> extent_of(const MeshTool& tool, double unit_m);

// Fails when moves and triangles are so many that one sweep would take minutes.
[[nodiscard]] Result<void> check_effort(const MeshTool& tool, std::span<const StraightMove> moves);

inline constexpr std::size_t kTrianglesAtOnce = 4'000'000;  // about 300 MB of tables

// What the tool covers on those moves, all of one material; fails as check_effort does. Moves with more than so many triangles
// together are done in several batches; the intervals do not depend on it.
[[nodiscard]] Result<RayBatch> mesh_spans(const Lattice& lattice, const MeshTool& tool,
                                          std::span<const StraightMove> moves, std::uint8_t material, WorkerPool& pool,
                                          std::size_t triangles_at_once = kTrianglesAtOnce);

}  // namespace burin

// SPDX-License-Identifier: MIT
// Finishes a carved mesh for export: repairs self-intersections, counts slivers and, with --simplify, decimates the
// triangles. Prints a line where something cannot be repaired or shown; the figures go into the report.
// Lengths in metres, object frame. Thread: any.
#pragma once

#include <optional>
#include <string>

#include "base/json.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/repair/decimate.hpp"

namespace burin::sculpt {

struct FinishedMesh {
    geometry::TriangleMesh mesh;
    // Parts of the report; docs/formats.md lists their keys.
    Json self_intersections;  // pairs of triangles found, repaired and left, and what the repair changed
    Json slivers;             // places thinner than the mesh can show, with the first of them
    Json simplification;      // null unless it was asked for
};

// Checks the bound of --simplify, which must be a distance above zero; to be called before any long step.
[[nodiscard]] Result<void> check_simplification(std::optional<double> bound_m);

// Welds and finishes the mesh. The bound must have been checked.
[[nodiscard]] Result<FinishedMesh> finish_mesh(const compute::Surface& surface, const compute::Solid& solid,
                                               std::optional<double> simplify_bound_m, WorkerPool& pool);

// Checks whether a mesh file's format holds the lattice's details: .stl and .ply have single-precision numbers, which
// do not far from the origin. Only a loaded workpiece tells.
[[nodiscard]] Result<void> check_precision(const std::string& path, const compute::Lattice& lattice);

struct SimplifiedMesh {
    geometry::TriangleMesh mesh;
    Json figures;
};
// Decimates the mesh within the bound, and shows its progress on standard error.
[[nodiscard]] Result<SimplifiedMesh> simplify_with_progress(const geometry::TriangleMesh& mesh, double bound_m,
                                                            WorkerPool& pool);

}  // namespace burin::sculpt

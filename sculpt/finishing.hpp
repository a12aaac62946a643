// SPDX-License-Identifier: MIT
// Finishes a carved mesh for export: brings it to the numbers that its files will hold, repairs self-intersections,
// counts slivers, drops loose crumbs and, with --simplify, decimates the triangles. Scaling to a unit and rounding to
// floats come first, so that what is repaired and counted is what a file has. Prints a line where something cannot be
// repaired or shown; the figures go into the report.
// Object frame; lengths in metres, but for the mesh's numbers. Thread: any.
#pragma once

#include <optional>
#include <string>

#include "base/json.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/repair/decimate.hpp"
#include "geometry/mesh/crumbs.hpp"

namespace burin::sculpt {

struct FinishedMesh {
    geometry::TriangleMesh mesh;  // its positions are numbers in `unit`, as every format writes them
    LengthUnit unit = LengthUnit::m;
    // Parts of the report; docs/formats.md lists their keys.
    Json self_intersections;         // pairs of triangles found, repaired and left, and what the repair changed
    Json slivers;                    // places thinner than the mesh can show, with the first of them
    Json simplification;             // null unless it was asked for
    geometry::DroppedCrumbs crumbs;  // of all shells, before that
    // Says in a sentence how much is thinner than the mesh can show, and from which resolution on it does; empty where
    // nothing is.
    std::string too_thin;
    std::uint64_t thin_places = 0;
};

// Returns whether a mesh has several colours and the file's format keeps none (geometry/files/mesh_export.hpp).
[[nodiscard]] bool loses_colours(const geometry::TriangleMesh& mesh, const std::string& path);
inline constexpr const char* kColoursLeftOut = "its colours are left out, as STL has none; .ply and .obj have";

// Checks the bound of --simplify, which must be a distance above zero; to be called before any long step.
[[nodiscard]] Result<void> check_simplification(std::optional<double> bound_m);

// Welds and finishes the mesh for files in the unit. The bound must have been checked. crumbs_m: loose pieces below
// this size are dropped (crumbs.hpp).
[[nodiscard]] Result<FinishedMesh> finish_mesh(const compute::Surface& surface, const compute::Solid& solid,
                                               LengthUnit unit, std::optional<double> simplify_bound_m, double crumbs_m,
                                               WorkerPool& pool);

// Writes a finished mesh as it is.
[[nodiscard]] Result<void> export_finished(const FinishedMesh& finished, const std::string& path);

// Checks whether a mesh file's format holds the lattice's details: .stl and .ply have single-precision numbers, which
// do not far from the origin. Only a loaded workpiece tells.
[[nodiscard]] Result<void> check_precision(const std::string& path, const compute::Lattice& lattice);

struct SimplifiedMesh {
    geometry::TriangleMesh mesh;
    Json figures;
};
// Decimates a mesh of numbers in the unit within the bound, and shows its progress on standard error.
[[nodiscard]] Result<SimplifiedMesh> simplify_with_progress(const geometry::TriangleMesh& numbers, LengthUnit unit,
                                                            double bound_m, WorkerPool& pool);

}  // namespace burin::sculpt

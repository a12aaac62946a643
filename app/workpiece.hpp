// SPDX-License-Identifier: MIT
// Where a workpiece comes from: a mesh file, a block or a ball, as --workpiece names it.
#pragma once

#include <string>

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/worker_pool.hpp"
#include "compute/solid.hpp"

namespace burin {

struct WorkpieceOptions {
    std::string source = "ball:0.1";  // FILE | block:X,Y,Z | ball:R, metres
    int resolution = 256;
    bool close_holes = false;
};

struct LoadedWorkpiece {
    Solid solid;
    Json report;  // the file's health, what was done about it, and the conversion
};

struct ClosedMesh {
    TriangleMesh mesh;  // facing outwards
    Json report;
};

// A file's mesh is welded (equal positions become one vertex) and turned to face outwards; both are reported. One that is not
// closed is refused with the reason, or closed on request. Every triangle of the file is in the solid or in the report.
[[nodiscard]] Result<ClosedMesh> load_closed_mesh(const std::string& file, bool close_holes);
[[nodiscard]] Result<LoadedWorkpiece> load_workpiece(const WorkpieceOptions& options, WorkerPool& pool);

// Where in its lattice, which leaves room around it, a workpiece lies before it is carved; object frame.
[[nodiscard]] Box workpiece_bounds(const Lattice& lattice);

// "prefix:1,2,3" -> the numbers, exactly `count` of them, finite; an Error names `what`.
[[nodiscard]] Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count,
                                                        const std::string& what);

}  // namespace burin

// SPDX-License-Identifier: MIT
// The solid that is carved, as --workpiece and --resolution name it.
// Lengths in metres, object frame. Any thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/length_unit.hpp"
#include "base/work_watch.hpp"
#include "base/worker_pool.hpp"
#include "compute/rays/solid.hpp"
#include "sculpt/workpiece_options.hpp"

namespace burin::sculpt {

// Looks on while a workpiece is made ready, which takes long for large files and lattices.
struct LoadWatch {
    WorkWatch* work = nullptr;                                     // null: nobody looks
    std::function<void(const geometry::TriangleMesh&)> look = {};  // gets the mesh as it was read; may be empty
};
// Returns the share of all the work at which the solid is there and its surface is meshed.
[[nodiscard]] double meshing_from(const WorkpieceOptions& options);

struct LoadedWorkpiece {
    compute::Solid solid;
    Json report;                      // the file's health, repairs, and the conversion
    std::string size = {};            // in a line, and for a file in which unit it was read
    LengthUnit unit = LengthUnit::m;  // of the file's numbers
    Vec3 size_m{0.0};                 // from side to side
    std::string closed = {};          // which holes were closed, in words; empty where none were
    Box bounds_object = {};           // of the workpiece, without its room
};

// Notes in `size` and in the report what of the mesh no ray of its solid met (unmet_parts.hpp).
void note_unmet_parts(const geometry::TriangleMesh& mesh, const compute::Solid& solid, std::string& size, Json& report);

// Makes the solid of a file or a shape, with its room. Every triangle of a file is in the solid or in the report.
[[nodiscard]] Result<LoadedWorkpiece> load_workpiece(const WorkpieceOptions& options, WorkerPool& pool,
                                                     const LoadWatch& watch = {});

// Returns the bounds of an uncarved workpiece that has no room: its lattice surrounds it with some empty cells.
[[nodiscard]] Box workpiece_bounds(const compute::Lattice& lattice);
// Returns the bounds of the lattice: material can be added within them alone.
[[nodiscard]] Box lattice_bounds(const compute::Lattice& lattice);
// Checks whether --units has a mesh file to speak of: sizes of shapes are in metres.
[[nodiscard]] Result<void> check_units(const WorkpieceOptions& options, bool tool_is_a_file);

}  // namespace burin::sculpt

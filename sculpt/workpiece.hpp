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

namespace burin::sculpt {

// ---- Workpiece

// Default room on every side of a workpiece, as a share of its longest side.
inline constexpr double kUsualRoom = 0.15;

struct WorkpieceOptions {
    std::string source = "ball:0.1";  // FILE | block:X,Y,Z | ball:R
    int resolution = 256;             // lattice cells along the longest side
    // Empty room on every side for what is added, as a share of the longest side. None: where it is not settled.
    std::optional<double> room = std::nullopt;
    bool close_holes = false;
    bool close_small_holes = false;  // where none of them is larger around than the mesh's shortest side
    std::optional<LengthUnit> units = std::nullopt;  // of a file; none: as it states, else guessed (mesh_unit.hpp)
    std::optional<double> weld_m = std::nullopt;     // of a file; none: by its numbers (join_open_edges)
};

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
[[nodiscard]] double longest_side_m(const Box& box);
// Checks whether --units has a mesh file to speak of: sizes of shapes are in metres.
[[nodiscard]] Result<void> check_units(const WorkpieceOptions& options, bool tool_is_a_file);

}  // namespace burin::sculpt

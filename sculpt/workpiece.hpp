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
// What ends work that nobody wants any more.
[[nodiscard]] std::unexpected<Error> no_longer_wanted();

struct LoadedWorkpiece {
    compute::Solid solid;
    Json report;                      // the file's health, repairs, and the conversion
    std::string size = {};            // in a line, and for a file in which unit it was read
    LengthUnit unit = LengthUnit::m;  // of the file's numbers
    Vec3 size_m{0.0};                 // from side to side
    std::string closed = {};          // which holes were closed, in words; empty where none were
    Box bounds_object = {};           // of the workpiece, without its room
};

struct ClosedMesh {
    geometry::TriangleMesh mesh;  // facing outwards
    Json report;
    std::string size = {};  // as of a LoadedWorkpiece
    LengthUnit unit = LengthUnit::m;
    Vec3 size_m{0.0};
    std::string joined = {};  // which corners were joined, in words; empty where none were
    std::string closed = {};  // which holes were closed, likewise
};

// Reads the mesh file that is the source, welds it and turns it to face outwards; the report says how much of each.
// Equal positions become one vertex; where it is open, corners at open edges are joined within a tolerance that follows
// from the precision of the file's numbers, or within weld_m, which `size` tells. Fails on a mesh that is not closed
// then, with the reason, unless its holes are to be closed: all of them, or small ones where all are small.
[[nodiscard]] Result<ClosedMesh> load_closed_mesh(const WorkpieceOptions& options, const LoadWatch& watch = {});

// Notes in `size` and in the report what of the mesh no ray of its solid met (unmet_parts.hpp).
void note_unmet_parts(const geometry::TriangleMesh& mesh, const compute::Solid& solid, std::string& size, Json& report);

// Checks the length of --weld, which must be a distance above zero; a loaded mesh must be more than ten times as long.
[[nodiscard]] Result<void> check_weld(std::optional<double> weld_m, double longest_side_m);
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

// Parses numbers separated by commas: exactly `count`, all finite. An Error names `what`.
[[nodiscard]] Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count,
                                                        const std::string& what);

}  // namespace burin::sculpt

// SPDX-License-Identifier: MIT
// A mesh file as a closed mesh that faces outwards: read, welded, its holes closed where that is asked for, and turned.
// Lengths in metres. Any thread; allocates.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/length_unit.hpp"
#include "base/work_watch.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

struct ClosedMeshOptions {
    std::string file;
    bool close_holes = false;
    bool close_small_holes = false;  // where none of them is larger around than the mesh's shortest side
    std::optional<LengthUnit> units = std::nullopt;  // none: as the file states, else guessed (mesh_unit.hpp)
    std::optional<double> weld_m = std::nullopt;     // none: by the file's numbers (join_open_edges)
};

// Looks on while a mesh is read and made ready, which takes long for large files.
struct MeshWatch {
    WorkWatch* work = nullptr;                           // null: nobody looks
    std::function<void(const TriangleMesh&)> look = {};  // gets the mesh as it was read; may be empty
    double read = 0.6, checked = 1.0;                    // shares of all the work at which each of the two is done
};
// What ends work that nobody wants any more.
[[nodiscard]] std::unexpected<Error> no_longer_wanted();

struct ClosedMesh {
    TriangleMesh mesh;  // facing outwards
    Json report;
    std::string size = {};  // as of a LoadedWorkpiece
    LengthUnit unit = LengthUnit::m;
    Vec3 size_m{0.0};
    std::string joined = {};  // which corners were joined, in words; empty where none were
    std::string closed = {};  // which holes were closed, likewise
};

// Reads a mesh file, welds it and turns it to face outwards; the report says how much of each.
// Equal positions become one vertex; where it is open, corners at open edges are joined within a tolerance that follows
// from the precision of the file's numbers, or within weld_m, which `size` tells. Fails on a mesh that is not closed
// then, with the reason, unless its holes are to be closed: all of them, or small ones where all are small.
[[nodiscard]] Result<ClosedMesh> load_closed_mesh(const ClosedMeshOptions& options, const MeshWatch& watch = {});

// Checks the length of --weld, which must be a distance above zero; a loaded mesh must be more than ten times as long.
[[nodiscard]] Result<void> check_weld(std::optional<double> weld_m, double longest_side_m);

}  // namespace burin::geometry

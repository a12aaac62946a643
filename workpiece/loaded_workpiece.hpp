// SPDX-License-Identifier: MIT
// A workpiece as it was read from a file, a shape or a document. Lengths in metres, object frame. Any thread.
#pragma once

#include <functional>
#include <string>

#include "base/json.hpp"
#include "base/length_unit.hpp"
#include "base/space.hpp"
#include "base/work_watch.hpp"
#include "compute/rays/solid.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::workpiece {

// Looks on while a workpiece is made ready, which takes long for large files and lattices.
struct LoadWatch {
    WorkWatch* work = nullptr;                                     // null: nobody looks
    std::function<void(const geometry::TriangleMesh&)> look = {};  // gets the mesh as it was read; may be empty
};

struct LoadedWorkpiece {
    compute::Solid solid;
    Json report;                      // the file's health, repairs, and the conversion
    std::string size = {};            // in a line, and for a file in which unit it was read
    LengthUnit unit = LengthUnit::m;  // of the file's numbers
    Vec3 size_m{0.0};                 // from side to side
    std::string closed = {};          // which holes were closed, in words; empty where none were
    Box bounds_object = {};           // of the workpiece, without its room
};

// Returns the bounds of an uncarved workpiece that has no room: its lattice surrounds it with some empty cells.
[[nodiscard]] Box workpiece_bounds(const compute::Lattice& lattice);
// Returns the bounds of the lattice: material can be added within them alone.
[[nodiscard]] Box lattice_bounds(const compute::Lattice& lattice);

}  // namespace burin::workpiece

// SPDX-License-Identifier: MIT
// Empty space around a solid, into which material can be added. A lattice fits closely around its workpiece, and what
// is added beyond the lattice is lost.
#pragma once

#include "base/error.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

// Returns the most cells of room on every side for which depths still have numbers enough (kMaxCells).
[[nodiscard]] int most_room_cells(const Lattice& lattice);
// Returns the solid on a lattice that has so many more empty cells on every side. Nodes, and so signs, crossings and
// the mesh, stay where they are in the object frame. Rays without material cost 4 bytes each. `cells` is from 0 to
// most_room_cells(). Fails where the rays do not fit into memory.
[[nodiscard]] Result<Solid> with_room(Solid solid, int cells);

}  // namespace burin::compute

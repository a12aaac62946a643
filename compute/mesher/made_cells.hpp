// SPDX-License-Identifier: MIT
// The cells that a device has made anew after a cut, for the tiles that see them. Surface::update puts them into the
// tiles, in place of making them itself. A device knows no tile: it makes cells from the rays alone, and sends those
// that the changed rays reach. Plain data; vertices in the object frame, relative to the lattice's origin, metres.
#pragma once

#include <vector>

#include "shaders/shared/made_cells.h"
#include "shaders/shared/surface_vertex.h"

namespace burin::compute {

struct MadeCells {
    std::vector<shared::MadeTile> tiles;  // in no order, each once: all that see a cell which may have changed
    std::vector<shared::MadeCell> cells;
    std::vector<shared::MadeEdge> edges;
    std::vector<shared::SurfaceVertex> vertices;
};

}  // namespace burin::compute

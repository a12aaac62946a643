// SPDX-License-Identifier: MIT
#include "compute/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

struct AxisPlacement {
    double first_face_cells;  // where the lower face of the bounds lies, in cells from the lattice origin
    int cells;
};

// Both faces at least a quarter of a cell from any node, and a whole empty cell outside each.
AxisPlacement place(double extent_cells) {
    const double rest = extent_cells - std::floor(extent_cells);
    // Symmetric between nodes: the two faces are (1 - rest) / 2 or (2 - rest) / 2 cells inside their outer cells.
    const double inset = rest <= 0.5 ? 0.5 * (1.0 - rest) : 0.5 * (2.0 - rest);
    const double first = 1.0 + inset;
    return {first, static_cast<int>(std::lround(2.0 * first + extent_cells))};
}

}  // namespace

Result<Lattice> lattice_around(const Box& bounds, int resolution) {
    if (resolution < kMinResolution || resolution > kMaxResolution) {
        return fail("resolution " + std::to_string(resolution), "is outside 16 to 2048",
                    "choose the number of lattice cells along the longest side within that range");
    }
    const Vec3 extent = bounds.extent();
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (bounds.empty() || !std::isfinite(longest) || longest <= 0.0) {
        return fail("workpiece", "has no extent", "give a workpiece with finite, non-zero size");
    }
    Lattice lattice;
    lattice.spacing_m = longest / resolution;
    for (int axis = 0; axis < 3; ++axis) {
        const AxisPlacement p = place(extent[axis] / lattice.spacing_m);
        lattice.origin_object[axis] = bounds.lo[axis] - p.first_face_cells * lattice.spacing_m;
        lattice.cells[static_cast<std::size_t>(axis)] = p.cells;
    }
    return lattice;
}

}  // namespace burin

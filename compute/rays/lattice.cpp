// SPDX-License-Identifier: MIT
#include "compute/rays/lattice.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace burin::compute {
namespace {

// Limits within which squares and cubes of sizes stay well in the range of float, the type in which surfaces are drawn
// and touched.
constexpr double kSmallestExtent_m = 1e-9, kLargestExtent_m = 1e9;
// A lattice has up to 2^23 units along its longest side; at a distance of 2^24 sides a double still resolves them.
constexpr double kFarthestInExtents = 1 << 24;

std::string in_metres(double x) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::general, 4).ptr;
    return std::string(text.data(), end) + " m";
}

struct AxisPlacement {
    double first_face_cells;  // where the lower face of the bounds lies, in cells from the lattice origin
    int cells;
};

// Places the bounds along one axis so that both faces are at least a quarter of a cell from any node and have a whole
// empty cell outside them.
AxisPlacement place(double extent_cells) {
    const double rest = extent_cells - std::floor(extent_cells);
    // By symmetry, the two faces are (1 - rest) / 2 or (2 - rest) / 2 cells inside their outer cells.
    const double inset = rest <= 0.5 ? 0.5 * (1.0 - rest) : 0.5 * (2.0 - rest);
    const double first = 1.0 + inset;
    return {first, static_cast<int>(std::lround(2.0 * first + extent_cells))};
}

}  // namespace

Lattice in_unit(const Lattice& lattice, LengthUnit unit) {
    return {from_metres(lattice.origin_object, unit), from_metres(lattice.spacing_m, unit), lattice.cells};
}

Result<Lattice> lattice_around(const Box& bounds, int resolution) {
    if (resolution < kMinResolution || resolution > kMaxResolution) {
        return fail("resolution " + std::to_string(resolution), "is outside 16 to 2048",
                    "choose the number of lattice cells along the longest side within that range");
    }
    const Vec3 extent = bounds.extent();
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (bounds.empty() || !std::isfinite(extent.x) || !std::isfinite(extent.y) || !std::isfinite(extent.z) ||
        longest <= 0.0) {
        return fail("workpiece", "has no extent", "give a workpiece with finite, non-zero size");
    }
    if (longest < kSmallestExtent_m || longest > kLargestExtent_m) {
        return fail("workpiece", "measures " + in_metres(longest), "give it in metres, between 1e-9 and 1e9");
    }
    const Vec3 farthest = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
    const double distance = std::max({farthest.x, farthest.y, farthest.z});
    if (distance > kFarthestInExtents * longest) {
        return fail(
            "workpiece", "measures " + in_metres(longest) + " but lies " + in_metres(distance) + " away",
            "move it to the origin (burin convert IN OUT.obj --center): so far out, its coordinates do not hold its "
            "shape");
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

}  // namespace burin::compute

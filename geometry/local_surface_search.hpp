// SPDX-License-Identifier: MIT
// Finding the few triangles of a LocalSurface that are near the tool.
//
// The publisher calls build_search() once when it has filled positions and triangles; the tick asks
// for_each_triangle_near() many times. Neither allocates, locks or throws. Everything is relative to origin_object,
// metres. Work: building is linear in triangles + cells (two passes); a query looks at the cells its box touches, at
// the triangles listed there, each once, and at the large ones.
#pragma once

#include <algorithm>
#include <cstdint>

#include "geometry/local_surface.hpp"

namespace burin {

struct SearchBuild {
    std::uint32_t listed = 0;
    std::uint32_t degenerate = 0;  // thinner than 1e-5 of their longest edge: they add nothing their neighbours lack
    std::uint32_t invalid = 0;     // an index out of range or a coordinate that is not finite: left out
};

// Fills surface.search. Counts beyond the capacity are taken as the capacity and the rest counted as invalid.
SearchBuild build_search(LocalSurface& surface) noexcept;

// The range of grid cells that a box touches, inclusive; empty when it misses the grid.
struct CellRange {
    std::array<std::uint32_t, 3> lo{}, hi{};
    bool empty = true;
};

[[nodiscard]] inline CellRange cells_touched(const SurfaceGrid& grid, const Vec3& lo, const Vec3& hi) noexcept {
    CellRange range;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = (lo[axis] - static_cast<double>(grid.lo[axis])) / static_cast<double>(grid.cell_m);
        const double to = (hi[axis] - static_cast<double>(grid.lo[axis])) / static_cast<double>(grid.cell_m);
        const double last = static_cast<double>(grid.cells[static_cast<std::size_t>(axis)]) - 1.0;
        if (!(to >= 0.0 && from <= last + 1.0)) return range;  // also when not finite
        range.lo[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::clamp(from, 0.0, last));
        range.hi[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::clamp(to, 0.0, last));
    }
    range.empty = false;
    return range;
}

// Calls visit(triangle index) once for each listed triangle that may meet the box [lo, hi], and for some near it; order depends
// only on the surface and the box. visit returns false to stop; so does this function then.
template <typename Visit>
bool for_each_triangle_near(const LocalSurface& surface, const Vec3& lo, const Vec3& hi, Visit&& visit) {
    const SurfaceGrid& grid = surface.search;
    if (!grid.built) return true;
    for (std::uint32_t i = 0; i < grid.large_count; ++i)
        if (!visit(grid.large[i])) return false;
    const Vec3 reach(static_cast<double>(grid.reach_m));
    const CellRange range = cells_touched(grid, lo - reach, hi + reach);
    if (range.empty) return true;
    for (std::uint32_t z = range.lo[2]; z <= range.hi[2]; ++z)
        for (std::uint32_t y = range.lo[1]; y <= range.hi[1]; ++y) {
            const std::uint32_t row = (z * grid.cells[1] + y) * grid.cells[0];
            // The cells of a row lie side by side, and so do their entries.
            for (std::uint32_t e = grid.first_entry[row + range.lo[0]]; e < grid.first_entry[row + range.hi[0] + 1];
                 ++e)
                if (!visit(grid.entries[e])) return false;
        }
    return true;
}

}  // namespace burin

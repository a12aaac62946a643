// SPDX-License-Identifier: MIT
// Finding the few triangles of a LocalSurface that are near the tool: what the tick asks, several times over.
// Does not allocate, lock or throw. Everything is relative to origin_object, metres.
// Work: see geometry/tile_block.hpp and geometry/gridded_triangles.hpp.
#pragma once

#include "geometry/local_surface.hpp"

namespace burin {

// Calls visit(id, triangle) once for each triangle within near.reach_m of the box [near.lo, near.hi], and for some a little
// farther off; for none that is degenerate. visit may make near.reach_m smaller, for what comes after. The order depends only
// on the surface and on what is asked. Ends when visit returns false, or when all looks are used up, and then returns false
// itself.
template <typename Visit>
bool for_each_triangle_near(const LocalSurface& surface, Near& near, Visit&& visit) {
    if (surface.tiles.triangles > 0 && !for_each_near(surface.tiles, near, visit)) return false;
    if (!surface.loose) return true;
    const std::uint32_t first = surface.tiles.triangles;
    return for_each_near(*surface.loose, near, [&](std::uint32_t i, const Triangle& t) { return visit(first + i, t); });
}

// Each triangle that may meet the box.
template <typename Visit>
bool for_each_triangle_near(const LocalSurface& surface, const Vec3& lo, const Vec3& hi, Visit&& visit) {
    Near near{lo, hi};
    return for_each_triangle_near(surface, near, visit);
}

// What no triangle's middle is beyond.
[[nodiscard]] inline Box bounds(const LocalSurface& surface) noexcept {
    Box box;
    const auto include = [&](const Box& other) {
        box.include(other.lo);
        box.include(other.hi);
    };
    if (surface.tiles.triangles > 0) include(surface.tiles.bounds());
    if (surface.loose && surface.loose->search.listed > 0) include(surface.loose->search.bounds());
    return box;
}

}  // namespace burin

// SPDX-License-Identifier: MIT
// Loose triangles with a uniform grid to find the few that are near the tool: for surfaces that do not come as tiles,
// such as a surface read back from a GPU, or a mesh that is touched but never carved.
//
// Fill positions_m and triangles, call build_search() once, then share the object and do not change it again. Positions
// are float metres, relative to the origin_object of the LocalSurface that holds them. Building allocates and is linear
// in triangles + cells (two passes); a query does not allocate, lock or throw. It examines each triangle listed in the
// cells that its box touches once, and all large triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/contact/triangle_slab.hpp"
#include "geometry/mesh/componentwise.hpp"
#include "geometry/mesh/triangle.hpp"

namespace burin::geometry {

// A uniform grid, written by build_search() alone and read through for_each_near(). Each triangle is listed once, in
// the cell of its bounding sphere's centre, so a query extends its box by the radius of the largest listed sphere. A
// triangle larger than a cell is in `large`, which every query examines.
struct SurfaceGrid {
    static constexpr std::uint32_t kMaxCellsAnAxis = 32;

    std::array<std::uint32_t, 3> cells{1, 1, 1};  // along x, y, z
    Vec3f lo{0.0f};                               // corner of the first cell
    float cell_m = 1.0f;
    float reach_m = 0.0f;      // upper bound of a listed triangle's distance from its cell
    float mean_edge_m = 0.0f;  // root mean square of the listed triangles' edges: the length scale of the mesh
    std::uint32_t listed = 0;  // triangles that can be found
    std::vector<std::uint32_t> first_entry;  // first entry of each cell; its entries end where the next cell's begin
    std::vector<std::uint32_t> entries;      // triangle indices
    std::vector<std::uint32_t> large;        // triangle indices
    std::vector<TriangleSlab> slabs;         // around each cell's triangles
    std::vector<glm::vec4> spheres;          // around each triangle: centre, radius; a negative radius: not listed

    [[nodiscard]] Box bounds() const noexcept {  // bounds of the spheres' centres
        const Vec3 from(lo);
        return {from, from + static_cast<double>(cell_m) * Vec3(cells[0], cells[1], cells[2])};
    }
    // A box that contains the triangles listed in a cell.
    [[nodiscard]] Box box_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) const noexcept {
        const auto cell = static_cast<double>(cell_m);
        const Vec3 from = Vec3(lo) + cell * Vec3(x, y, z), reach(static_cast<double>(reach_m));
        return {from - reach, from + cell + reach};
    }
};

struct GriddedTriangles {
    std::vector<Vec3f> positions_m;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    SurfaceGrid search;

    [[nodiscard]] Triangle triangle(std::uint32_t i) const noexcept {
        const auto& v = triangles[i];
        return {Vec3(positions_m[v[0]]), Vec3(positions_m[v[1]]), Vec3(positions_m[v[2]])};
    }
};

struct SearchBuild {
    std::uint32_t listed = 0;
    std::uint32_t degenerate = 0;  // see is_degenerate: left out
    std::uint32_t invalid = 0;     // an index out of range or a coordinate that is not finite: left out
};

// Builds piece.search from its positions and triangles, and counts what was listed and what was left out.
SearchBuild build_search(GriddedTriangles& piece);

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
        if (!(to >= 0.0 && from <= last + 1.0)) return range;  // false for NaN too
        range.lo[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::clamp(from, 0.0, last));
        range.hi[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::clamp(to, 0.0, last));
    }
    range.empty = false;
    return range;
}

// Visits triangles as for_each_triangle_near does (geometry/contact/local_surface_search.hpp); calls visit(triangle
// index, triangle), and leaves out cells where skips(box, slab) is true.
template <typename Visit, typename Skips>
bool for_each_near(const GriddedTriangles& piece, Near& near, Visit&& visit, Skips&& skips) {
    const SurfaceGrid& grid = piece.search;
    if (grid.listed == 0) return true;
    const auto look_at = [&](std::uint32_t i) {
        if (near.passes_by()) return true;
        if (!near.look()) return false;
        const glm::vec4& sphere = grid.spheres[i];
        const Vec3 center(sphere), outside = upper_of(upper_of(near.lo - center, center - near.hi), Vec3(0.0));
        const double reach = near.reach_m + static_cast<double>(sphere.w);
        return !(glm::dot(outside, outside) <= reach * reach) || visit(i, piece.triangle(i));
    };
    for (const std::uint32_t i : grid.large)
        if (!look_at(i)) return false;
    const Vec3 reach(near.reach_m + static_cast<double>(grid.reach_m));
    const CellRange range = cells_touched(grid, near.lo - reach, near.hi + reach);
    if (range.empty) return true;
    for (std::uint32_t z = range.lo[2]; z <= range.hi[2]; ++z)
        for (std::uint32_t y = range.lo[1]; y <= range.hi[1]; ++y) {
            const std::uint32_t row = (z * grid.cells[1] + y) * grid.cells[0];
            for (std::uint32_t x = range.lo[0]; x <= range.hi[0]; ++x) {
                const std::uint32_t first = grid.first_entry[row + x], end = grid.first_entry[row + x + 1];
                if (first == end || skips(grid.box_of(x, y, z), grid.slabs[row + x])) continue;
                for (std::uint32_t e = first; e < end; ++e)
                    if (!look_at(grid.entries[e])) return false;
            }
        }
    return true;
}

template <typename Visit>
bool for_each_near(const GriddedTriangles& piece, Near& near, Visit&& visit) {
    return for_each_near(piece, near, visit, [](const Box&, const TriangleSlab&) { return false; });
}

}  // namespace burin::geometry

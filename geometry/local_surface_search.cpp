// SPDX-License-Identifier: MIT
#include "geometry/local_surface_search.hpp"

#include <cmath>

namespace burin {
namespace {

// A triangle in more cells than this is cheaper to look at always than to list.
constexpr std::uint32_t kMostCellsATriangle = 64;

struct Corners {
    Vec3 a, b, c;
};

Corners corners(const LocalSurface& surface, std::uint32_t triangle) {
    const auto& v = surface.triangles[triangle];
    return {Vec3(surface.positions_m[v[0]]), Vec3(surface.positions_m[v[1]]), Vec3(surface.positions_m[v[2]])};
}

bool finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool valid(const LocalSurface& surface, std::uint32_t vertex_count, std::uint32_t triangle) {
    for (const std::uint32_t v : surface.triangles[triangle])
        if (v >= vertex_count || !finite(surface.positions_m[v])) return false;
    return true;
}

bool degenerate(const Corners& t) {
    const double longest2 =
        std::max({glm::dot(t.b - t.a, t.b - t.a), glm::dot(t.c - t.b, t.c - t.b), glm::dot(t.a - t.c, t.a - t.c)});
    const Vec3 twice_area = glm::cross(t.b - t.a, t.c - t.a);
    // height = twice the area over the longest edge; compared squared. A point, whose edges are 0, is degenerate too.
    return !(glm::dot(twice_area, twice_area) > 1e-10 * longest2 * longest2);
}

// The ball around the box's middle; a little too large rather than too small, since it is stored in float.
glm::vec4 sphere(const Corners& t) {
    const Vec3f center(0.5 * (glm::min(glm::min(t.a, t.b), t.c) + glm::max(glm::max(t.a, t.b), t.c)));
    double r2 = 0.0;
    for (const Vec3& p : {t.a, t.b, t.c}) r2 = std::max(r2, glm::dot(p - Vec3(center), p - Vec3(center)));
    return {center, static_cast<float>(std::sqrt(r2) * (1.0 + 1e-6))};
}

// radius < 0 marks a triangle that is not listed, so that the second pass need not repeat the checks.
constexpr float kNotListed = -1.0f;

struct Extent {
    Box box;
    double edges_m = 0.0;
    std::uint64_t edge_count = 0;
};

void shape_grid(SurfaceGrid& grid, const Extent& all) {
    grid.mean_edge_m = static_cast<float>(all.edges_m / static_cast<double>(all.edge_count));
    const Vec3 extent = all.box.extent();
    const double longest = std::max({extent.x, extent.y, extent.z});
    double cell = std::max(longest / SurfaceGrid::kMaxCellsAnAxis, static_cast<double>(grid.mean_edge_m));
    cell *= 1.0 + 1e-5;  // the far side of the box stays inside the last cell in spite of rounding to float
    grid.cell_m = static_cast<float>(cell);
    grid.lo = Vec3f(all.box.lo);  // exact: the box is made of floats
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // The very quotient that cells_touched() makes of the box's far side, so the last cell holds it.
        const double n = std::floor(extent[static_cast<int>(axis)] / static_cast<double>(grid.cell_m)) + 1.0;
        grid.cells[axis] = static_cast<std::uint32_t>(std::min(n, double{SurfaceGrid::kMaxCellsAnAxis}));
    }
}

std::uint32_t cells_in(const CellRange& r) {
    return (r.hi[0] - r.lo[0] + 1) * (r.hi[1] - r.lo[1] + 1) * (r.hi[2] - r.lo[2] + 1);
}

CellRange cells_of(const SurfaceGrid& grid, const Corners& t) {
    return cells_touched(grid, glm::min(glm::min(t.a, t.b), t.c), glm::max(glm::max(t.a, t.b), t.c));
}

template <typename Visit>
void for_each_cell(const SurfaceGrid& grid, const CellRange& r, Visit&& visit) {
    for (std::uint32_t z = r.lo[2]; z <= r.hi[2]; ++z)
        for (std::uint32_t y = r.lo[1]; y <= r.hi[1]; ++y)
            for (std::uint32_t x = r.lo[0]; x <= r.hi[0]; ++x) visit((z * grid.cells[1] + y) * grid.cells[0] + x);
}

}  // namespace

SearchBuild build_search(LocalSurface& surface) noexcept {
    SurfaceGrid& grid = surface.search;
    const std::uint32_t vertex_count = std::min(surface.vertex_count, LocalSurface::kMaxVertices);
    const std::uint32_t triangle_count = std::min(surface.triangle_count, LocalSurface::kMaxTriangles);
    SearchBuild report;
    report.invalid = surface.triangle_count - triangle_count;
    Extent all;
    for (std::uint32_t i = 0; i < triangle_count; ++i) {
        grid.spheres[i] = glm::vec4(0.0f, 0.0f, 0.0f, kNotListed);
        if (!valid(surface, vertex_count, i)) {
            ++report.invalid;
            continue;
        }
        const Corners t = corners(surface, i);
        if (degenerate(t)) {
            ++report.degenerate;
            continue;
        }
        grid.spheres[i] = sphere(t);
        for (const Vec3& p : {t.a, t.b, t.c}) all.box.include(p);
        all.edges_m += glm::length(t.b - t.a) + glm::length(t.c - t.b) + glm::length(t.a - t.c);
        all.edge_count += 3;
        ++report.listed;
    }
    grid.built = true;
    grid.listed = report.listed;
    grid.large_count = 0;
    grid.cells = {1, 1, 1};
    grid.mean_edge_m = 0.0f;
    if (report.listed > 0) shape_grid(grid, all);
    const std::uint32_t cell_count = grid.cells[0] * grid.cells[1] * grid.cells[2];
    std::fill_n(grid.first_entry.begin(), cell_count + 1, 0u);

    // First pass: how many entries each cell gets, kept one place further on so that the sums become the cells' ends.
    std::uint32_t entries = 0;
    for (std::uint32_t i = 0; i < triangle_count; ++i) {
        if (grid.spheres[i].w < 0.0f) continue;
        const CellRange range = cells_of(grid, corners(surface, i));
        const std::uint32_t touched = cells_in(range);
        for (std::size_t axis = 0; axis < 3; ++axis)
            grid.first_cell[i][axis] = static_cast<std::uint8_t>(range.lo[axis]);
        if (touched > kMostCellsATriangle || entries + touched > SurfaceGrid::kMaxEntries) {
            grid.large[grid.large_count++] = i;
            grid.first_cell[i][0] = 0xff;  // not in any cell
            continue;
        }
        entries += touched;
        for_each_cell(grid, range, [&](std::uint32_t cell) { ++grid.first_entry[cell + 1]; });
    }
    for (std::uint32_t cell = 0; cell < cell_count; ++cell) grid.first_entry[cell + 1] += grid.first_entry[cell];

    // Second pass, backwards: each cell's end moves down to its beginning while its entries are written in rising
    // order.
    for (std::uint32_t i = triangle_count; i-- > 0;) {
        if (grid.spheres[i].w < 0.0f || grid.first_cell[i][0] == 0xff) continue;
        for_each_cell(grid, cells_of(grid, corners(surface, i)),
                      [&](std::uint32_t cell) { grid.entries[--grid.first_entry[cell + 1]] = i; });
    }
    // Now first_entry[cell + 1] is the cell's beginning; move all down by one place and close the list.
    for (std::uint32_t cell = 0; cell < cell_count; ++cell) grid.first_entry[cell] = grid.first_entry[cell + 1];
    grid.first_entry[cell_count] = entries;
    return report;
}

}  // namespace burin

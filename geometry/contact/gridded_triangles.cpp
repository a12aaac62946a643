// SPDX-License-Identifier: MIT
#include "geometry/contact/gridded_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin::geometry {
namespace {

bool finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool valid(const GriddedTriangles& piece, const std::array<std::uint32_t, 3>& triangle, bool all_finite) {
    return std::ranges::all_of(triangle, [&](std::uint32_t v) {
        return v < piece.positions_m.size() && (all_finite || finite(piece.positions_m[v]));
    });
}

double edges2_m2(const Triangle& t) {
    const Vec3 ab = t.b - t.a, bc = t.c - t.b, ca = t.a - t.c;
    return glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca);
}

constexpr float kNotListed = -1.0f;

struct Extent {
    // bounds of the sphere centres
    Vec3f lo{std::numeric_limits<float>::infinity()}, hi{-std::numeric_limits<float>::infinity()};
    double edges2_m2 = 0.0;
};

// Computes the bounding sphere of each valid triangle, and the extent that determines the grid's shape.
Extent measure_triangles(GriddedTriangles& piece, SearchBuild& report) {
    const bool all_finite = std::ranges::all_of(piece.positions_m, finite);
    piece.search.spheres.assign(piece.triangles.size(), glm::vec4(0.0f, 0.0f, 0.0f, kNotListed));
    Extent all;
    for (std::uint32_t i = 0; i < piece.triangles.size(); ++i) {
        if (!valid(piece, piece.triangles[i], all_finite)) {
            ++report.invalid;
            continue;
        }
        const Triangle t = piece.triangle(i);
        if (is_degenerate(t)) {
            ++report.degenerate;
            continue;
        }
        const glm::vec4 ball =
            sphere_around(Vec3f(glm::min(glm::min(t.a, t.b), t.c)), Vec3f(glm::max(glm::max(t.a, t.b), t.c)));
        piece.search.spheres[i] = ball;
        all.lo = glm::min(all.lo, Vec3f(ball));
        all.hi = glm::max(all.hi, Vec3f(ball));
        all.edges2_m2 += edges2_m2(t);
        ++report.listed;
    }
    return all;
}

void shape_grid(SurfaceGrid& grid, const Extent& all) {
    grid.mean_edge_m = static_cast<float>(std::sqrt(all.edges2_m2 / (3.0 * grid.listed)));
    const Vec3 extent = Vec3(all.hi) - Vec3(all.lo);
    const double longest = std::max({extent.x, extent.y, extent.z});
    double cell = std::max(longest / SurfaceGrid::kMaxCellsAnAxis, 2.0 * static_cast<double>(grid.mean_edge_m));
    cell *= 1.0 + 1e-5;  // keeps the far side inside the last cell in spite of rounding to float
    grid.cell_m = static_cast<float>(cell);
    grid.lo = all.lo;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double n = std::floor(extent[static_cast<int>(axis)] / static_cast<double>(grid.cell_m)) + 1.0;
        grid.cells[axis] = static_cast<std::uint32_t>(std::min(n, double{SurfaceGrid::kMaxCellsAnAxis}));
    }
}

// Returns the cell of a sphere's centre. Rounding may choose the neighbouring cell: for_each_near finds the triangle
// there too, since reach_m is slightly more than the largest radius.
std::uint16_t cell_of(const SurfaceGrid& grid, const glm::vec4& ball, float cells_per_m) {
    std::array<std::uint32_t, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const float along = (ball[axis] - grid.lo[axis]) * cells_per_m;
        at[k] = std::min(static_cast<std::uint32_t>(along), grid.cells[k] - 1);
    }
    return static_cast<std::uint16_t>((at[2] * grid.cells[1] + at[1]) * grid.cells[0] + at[0]);
}

}  // namespace

SearchBuild build_search(GriddedTriangles& piece) {
    SearchBuild report;
    SurfaceGrid& grid = piece.search;
    grid = {};
    const Extent all = measure_triangles(piece, report);
    grid.listed = report.listed;
    if (report.listed > 0) shape_grid(grid, all);

    // Counting sort. Counts the entries of each cell, stored one index further on so that the prefix sums become the
    // ends.
    const std::size_t cell_count = std::size_t{grid.cells[0]} * grid.cells[1] * grid.cells[2];
    grid.first_entry.assign(cell_count + 1, 0u);
    const auto is_small = [&](const glm::vec4& ball) { return ball.w >= 0.0f && ball.w <= grid.cell_m; };
    const float cells_per_m = 1.0f / grid.cell_m;
    std::vector<std::uint16_t> cells(grid.spheres.size());  // cell of each listed triangle that is not large
    float largest_m = 0.0f;
    for (std::uint32_t i = 0; i < grid.spheres.size(); ++i) {
        const glm::vec4& ball = grid.spheres[i];
        if (ball.w > grid.cell_m) grid.large.push_back(i);
        if (!is_small(ball)) continue;
        largest_m = std::max(largest_m, ball.w);
        cells[i] = cell_of(grid, ball, cells_per_m);
        ++grid.first_entry[cells[i] + 1u];
    }
    grid.reach_m = largest_m + 1e-4f * grid.cell_m;
    for (std::size_t cell = 0; cell < cell_count; ++cell) grid.first_entry[cell + 1] += grid.first_entry[cell];
    // Writes the entries backwards: each cell's end moves down to its beginning, and its entries end up in ascending
    // order.
    grid.entries.resize(grid.first_entry[cell_count]);
    for (auto i = static_cast<std::uint32_t>(grid.spheres.size()); i-- > 0;) {
        if (is_small(grid.spheres[i])) grid.entries[--grid.first_entry[cells[i] + 1u]] = i;
    }
    // first_entry[cell + 1] now is the cell's beginning: shifts all down by one and closes the list.
    for (std::size_t cell = 0; cell < cell_count; ++cell) grid.first_entry[cell] = grid.first_entry[cell + 1];
    grid.first_entry[cell_count] = static_cast<std::uint32_t>(grid.entries.size());
    grid.slabs.resize(cell_count);
    for (std::size_t cell = 0; cell < cell_count; ++cell)
        grid.slabs[cell] = slab_around([&](auto&& visit) {
            for (std::uint32_t e = grid.first_entry[cell]; e < grid.first_entry[cell + 1]; ++e)
                visit(piece.triangle(grid.entries[e]));
        });
    return report;
}

}  // namespace burin::geometry

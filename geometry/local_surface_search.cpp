// SPDX-License-Identifier: MIT
#include "geometry/local_surface_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin {
namespace {

struct Corners {
    Vec3 a, b, c;
};

Corners corners(const LocalSurface& surface, std::uint32_t triangle) {
    const auto& v = surface.triangles[triangle];
    return {Vec3(surface.positions_m[v[0]]), Vec3(surface.positions_m[v[1]]), Vec3(surface.positions_m[v[2]])};
}

bool finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool all_finite(const LocalSurface& surface, std::uint32_t vertex_count) {
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        if (!finite(surface.positions_m[v])) return false;
    return true;
}

bool valid(const LocalSurface& surface, std::uint32_t vertex_count, std::uint32_t triangle, bool vertices_finite) {
    for (const std::uint32_t v : surface.triangles[triangle])
        if (v >= vertex_count || (!vertices_finite && !finite(surface.positions_m[v]))) return false;
    return true;
}

// Squared lengths of a triangle's edges, and twice its area.
struct Shape {
    double ab2, bc2, ca2;
    Vec3 twice_area;

    explicit Shape(const Corners& t) {
        const Vec3 ab = t.b - t.a, ca = t.a - t.c, bc = t.c - t.b;
        ab2 = glm::dot(ab, ab);
        bc2 = glm::dot(bc, bc);
        ca2 = glm::dot(ca, ca);
        twice_area = glm::cross(ca, ab);
    }
    [[nodiscard]] bool degenerate() const {
        const double longest2 = std::max({ab2, bc2, ca2});
        // height = twice the area over the longest edge; compared squared. A point, whose edges are 0, is degenerate too.
        return !(glm::dot(twice_area, twice_area) > 1e-10 * longest2 * longest2);
    }
    [[nodiscard]] double edges2_m2() const { return ab2 + bc2 + ca2; }
};

// The ball around the triangle's box; a little too large rather than too small, since it is stored in float.
glm::vec4 sphere(const Vec3& lo, const Vec3& hi) {
    const Vec3f center(0.5 * (lo + hi));
    const Vec3 half = glm::max(hi - Vec3(center), Vec3(center) - lo);  // from the middle as it is stored
    return {center, static_cast<float>(glm::length(half) * (1.0 + 1e-6))};
}

constexpr float kNotListed = -1.0f;

struct Extent {
    Vec3f lo{std::numeric_limits<float>::infinity()}, hi{-std::numeric_limits<float>::infinity()};  // of the middles
    double edges2_m2 = 0.0;
};

// Spheres, and what the grid's shape follows from.
Extent measure_triangles(LocalSurface& surface, std::uint32_t triangle_count, SearchBuild& report) {
    const std::uint32_t vertex_count = std::min(surface.vertex_count, LocalSurface::kMaxVertices);
    const bool vertices_finite = all_finite(surface, vertex_count);
    Extent all;
    for (std::uint32_t i = 0; i < triangle_count; ++i) {
        glm::vec4& ball = surface.search.spheres[i];
        ball = glm::vec4(0.0f, 0.0f, 0.0f, kNotListed);
        if (!valid(surface, vertex_count, i, vertices_finite)) {
            ++report.invalid;
            continue;
        }
        const Corners t = corners(surface, i);
        const Shape shape(t);
        if (shape.degenerate()) {
            ++report.degenerate;
            continue;
        }
        ball = sphere(glm::min(glm::min(t.a, t.b), t.c), glm::max(glm::max(t.a, t.b), t.c));
        all.lo = glm::min(all.lo, Vec3f(ball));
        all.hi = glm::max(all.hi, Vec3f(ball));
        all.edges2_m2 += shape.edges2_m2();
        ++report.listed;
    }
    return all;
}

void shape_grid(SurfaceGrid& grid, const Extent& all) {
    grid.mean_edge_m = static_cast<float>(std::sqrt(all.edges2_m2 / (3.0 * grid.listed)));
    const Vec3 extent = Vec3(all.hi) - Vec3(all.lo);
    const double longest = std::max({extent.x, extent.y, extent.z});
    double cell = std::max(longest / SurfaceGrid::kMaxCellsAnAxis, 2.0 * static_cast<double>(grid.mean_edge_m));
    cell *= 1.0 + 1e-5;  // the far side stays inside the last cell in spite of rounding to float
    grid.cell_m = static_cast<float>(cell);
    grid.lo = all.lo;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double n = std::floor(extent[static_cast<int>(axis)] / static_cast<double>(grid.cell_m)) + 1.0;
        grid.cells[axis] = static_cast<std::uint32_t>(std::min(n, double{SurfaceGrid::kMaxCellsAnAxis}));
    }
}

// The cell of a sphere's middle. Rounding may put it into the cell beside: for_each_triangle_near finds it there, since reach_m
// is a little more than the largest radius.
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

SearchBuild build_search(LocalSurface& surface) noexcept {
    SurfaceGrid& grid = surface.search;
    const std::uint32_t triangle_count = std::min(surface.triangle_count, LocalSurface::kMaxTriangles);
    SearchBuild report;
    report.invalid = surface.triangle_count - triangle_count;
    const Extent all = measure_triangles(surface, triangle_count, report);
    grid.built = true;
    grid.listed = report.listed;
    grid.large_count = 0;
    grid.cells = {1, 1, 1};
    grid.mean_edge_m = grid.reach_m = 0.0f;
    if (report.listed > 0) shape_grid(grid, all);
    const std::uint32_t cell_count = grid.cells[0] * grid.cells[1] * grid.cells[2];
    std::fill_n(grid.first_entry.begin(), cell_count + 1, 0u);

    // Counting sort. First how many entries each cell gets, kept one place further on so that the sums become the ends.
    const float cells_per_m = 1.0f / grid.cell_m;
    float largest_m = 0.0f;
    for (std::uint32_t i = 0; i < triangle_count; ++i) {
        const glm::vec4& ball = grid.spheres[i];
        if (ball.w < 0.0f) continue;
        if (ball.w > grid.cell_m) {
            grid.large[grid.large_count++] = i;
            continue;
        }
        largest_m = std::max(largest_m, ball.w);
        grid.cell_of[i] = cell_of(grid, ball, cells_per_m);
        ++grid.first_entry[grid.cell_of[i] + 1u];
    }
    grid.reach_m = largest_m + 1e-4f * grid.cell_m;
    for (std::uint32_t cell = 0; cell < cell_count; ++cell) grid.first_entry[cell + 1] += grid.first_entry[cell];
    // Then backwards: each cell's end moves down to its beginning while its entries are written in rising order.
    for (std::uint32_t i = triangle_count; i-- > 0;) {
        if (grid.spheres[i].w < 0.0f || grid.spheres[i].w > grid.cell_m) continue;
        grid.entries[--grid.first_entry[grid.cell_of[i] + 1u]] = i;
    }
    // Now first_entry[cell + 1] is the cell's beginning; move all down by one place and close the list.
    const std::uint32_t entries = report.listed - grid.large_count;
    for (std::uint32_t cell = 0; cell < cell_count; ++cell) grid.first_entry[cell] = grid.first_entry[cell + 1];
    grid.first_entry[cell_count] = entries;
    return report;
}

}  // namespace burin

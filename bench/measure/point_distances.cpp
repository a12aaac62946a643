// SPDX-License-Identifier: MIT
#include "bench/measure/point_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace burin::bench {
namespace {

double point_segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 e = b - a;
    const double length2 = glm::dot(e, e);
    const double t = length2 > 0.0 ? glm::clamp(glm::dot(p - a, e) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + e * t));
}

// Points sorted into the cells of a uniform grid over their bounds, for queries of the points near a triangle.
class PointGrid {
public:
    PointGrid(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& which, double radius_m)
        : radius_m_(radius_m) {
        Box box;
        for (const std::uint32_t i : which) box.include(points[i]);
        lo_ = box.lo;
        const Vec3 extent = box.extent();
        cell_m_ = std::max(radius_m, std::max({extent.x, extent.y, extent.z, 1e-9}) / kMostCells);
        for (int a = 0; a < 3; ++a) cells_[a] = static_cast<int>(extent[a] / cell_m_) + 1;
        first_.assign(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
                              static_cast<std::size_t>(cells_[2]) +
                          1,
                      0);
        for (const std::uint32_t i : which) ++first_[cell_of(points[i]) + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        points_.resize(which.size());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (const std::uint32_t i : which) points_[next[cell_of(points[i])]++] = i;
    }

    template <typename Visit>
    void for_each_near(const Vec3& lo, const Vec3& hi, Visit&& visit) const {
        std::array<int, 3> from{}, to{};
        for (int a = 0; a < 3; ++a) {
            const auto k = static_cast<std::size_t>(a);
            const double first = std::floor((lo[a] - radius_m_ - lo_[a]) / cell_m_);
            const double last = std::floor((hi[a] + radius_m_ - lo_[a]) / cell_m_);
            if (last < 0.0 || first >= cells_[a]) return;
            from[k] = static_cast<int>(std::max(first, 0.0));
            to[k] = static_cast<int>(std::min(last, cells_[a] - 1.0));
        }
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y) {
                // Cells along x are adjacent in memory.
                const std::size_t row = index(0, y, z);
                for (std::uint32_t i = first_[row + static_cast<std::size_t>(from[0])];
                     i < first_[row + static_cast<std::size_t>(to[0]) + 1]; ++i) {
                    visit(points_[i]);
                }
            }
    }

private:
    static constexpr double kMostCells = 160.0;  // an axis: 16 MB at most
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_[1]) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(cells_[0]) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::size_t cell_of(const Vec3& p) const {
        std::array<int, 3> cell{};
        for (int a = 0; a < 3; ++a) {
            cell[static_cast<std::size_t>(a)] =
                std::clamp(static_cast<int>(std::floor((p[a] - lo_[a]) / cell_m_)), 0, cells_[a] - 1);
        }
        return index(cell[0], cell[1], cell[2]);
    }

    double radius_m_, cell_m_ = 1.0;
    Vec3 lo_{0.0};
    glm::ivec3 cells_{1};
    std::vector<std::uint32_t> first_, points_;
};

}  // namespace

// The nearest point lies in the plane when p is above the triangle, else on an edge (Ericson 2005, section 5.1.5, but
// decided by sides of the edges' planes instead of barycentric coordinates).
double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = glm::cross(b - a, c - a);
    const double n2 = glm::dot(n, n);
    const auto within = [&](const Vec3& from, const Vec3& to) {
        return glm::dot(glm::cross(to - from, p - from), n) >= 0.0;
    };
    if (n2 > 0.0 && within(a, b) && within(b, c) && within(c, a)) return std::abs(glm::dot(p - a, n)) / std::sqrt(n2);
    return std::min(
        {point_segment_distance(p, a, b), point_segment_distance(p, b, c), point_segment_distance(p, c, a)});
}

std::vector<double> distances_to_mesh(const std::vector<Vec3>& points, const geometry::TriangleMesh& mesh,
                                      double first_radius_m) {
    std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
    if (mesh.triangles.empty()) return distances;
    std::vector<std::uint32_t> open(points.size());
    std::iota(open.begin(), open.end(), 0u);
    for (double radius = first_radius_m; !open.empty(); radius *= 4.0) {
        const PointGrid grid(points, open, radius);
        for (const auto& triangle : mesh.triangles) {
            const Vec3 &a = mesh.positions_m[triangle[0]], &b = mesh.positions_m[triangle[1]],
                       &c = mesh.positions_m[triangle[2]];
            grid.for_each_near(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), [&](std::uint32_t i) {
                distances[i] = std::min(distances[i], point_triangle_distance(points[i], a, b, c));
            });
        }
        // Every triangle within the radius was tested; a nearest one found beyond it need not be the nearest.
        std::erase_if(open, [&](std::uint32_t i) { return distances[i] <= radius; });
    }
    return distances;
}

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
#include "geometry/mesh/least_area.hpp"

#include <limits>

namespace burin::geometry {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

struct Best {
    // Area of the triangulated part of the loop between two corners, closed by the diagonal between them.
    double area_m2 = 0.0;
    std::uint32_t apex = 0;  // apex of the triangle on that diagonal
};

class Table {
public:
    explicit Table(std::size_t n) : n_(n), best_(n * n) {}
    Best& operator()(std::size_t i, std::size_t j) { return best_[i * n_ + j]; }

private:
    std::size_t n_;
    std::vector<Best> best_;
};

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::length(glm::cross(b - a, c - a)) / 2.0; }

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> least_area_triangulation(
    std::span<const Vec3> loop_m, const std::function<bool(std::size_t, std::size_t)>& allowed) {
    const std::size_t n = loop_m.size();
    Table best(n);
    for (std::size_t span = 2; span < n; ++span) {
        for (std::size_t i = 0; i + span < n; ++i) {
            const std::size_t j = i + span;
            Best& here = best(i, j);
            here.area_m2 = kImpossible;
            if (span + 1 < n && !allowed(i, j)) continue;  // (0, n - 1) is an edge of the loop
            for (std::size_t k = i + 1; k < j; ++k) {
                const double sum = best(i, k).area_m2 + best(k, j).area_m2 + area(loop_m[i], loop_m[k], loop_m[j]);
                if (sum < here.area_m2) here = {sum, static_cast<std::uint32_t>(k)};
            }
        }
    }
    if (best(0, n - 1).area_m2 == kImpossible) return std::nullopt;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> open{{0, static_cast<std::uint32_t>(n - 1)}};
    while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        if (j - i < 2) continue;
        const std::uint32_t k = best(i, j).apex;
        triangles.push_back({i, k, j});
        open.push_back({i, k});
        open.push_back({k, j});
    }
    return triangles;
}

}  // namespace burin::geometry

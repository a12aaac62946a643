// SPDX-License-Identifier: MIT
#include "geometry/mesh/coarse_copy.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace burin::geometry {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

// Numbers the cells of a grid around a box.
class CellGrid {
public:
    CellGrid(const Box& bounds, int cells) : lo_(bounds.lo) {
        const Vec3 size = bounds.extent();
        const double longest = std::max({size.x, size.y, size.z});
        per_length_ = longest > 0.0 ? cells / longest : 0.0;
        for (int axis = 0; axis < 3; ++axis)
            along_.at(static_cast<std::size_t>(axis)) = static_cast<std::size_t>(size[axis] * per_length_) + 1;
    }
    [[nodiscard]] std::size_t count() const { return along_[0] * along_[1] * along_[2]; }
    [[nodiscard]] std::size_t cell_of(const Vec3& p) const {
        std::array<std::size_t, 3> at{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            at.at(a) = std::min(static_cast<std::size_t>((p[axis] - lo_[axis]) * per_length_), along_.at(a) - 1);
        }
        return (at[2] * along_[1] + at[1]) * along_[0] + at[0];
    }

private:
    Vec3 lo_;
    double per_length_ = 0.0;
    std::array<std::size_t, 3> along_{};
};

Box box_of_used(const TriangleMesh& mesh) {
    Box bounds;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) bounds.include(mesh.positions_m[v]);
    return bounds;
}

}  // namespace

TriangleMesh coarse_copy(const TriangleMesh& mesh, std::size_t most_triangles, int cells) {
    if (mesh.triangles.size() <= most_triangles) return mesh;
    const CellGrid grid(box_of_used(mesh), cells);
    std::vector<std::uint32_t> vertex_of_cell(grid.count(), kNoVertex);
    std::vector<std::uint32_t> merged(mesh.positions_m.size(), kNoVertex), counts;
    TriangleMesh coarse;
    coarse.materials = mesh.materials;
    const auto vertex = [&](std::uint32_t v) {
        if (merged[v] != kNoVertex) return merged[v];
        std::uint32_t& of_cell = vertex_of_cell[grid.cell_of(mesh.positions_m[v])];
        if (of_cell == kNoVertex) {
            of_cell = static_cast<std::uint32_t>(counts.size());
            counts.push_back(0);
            coarse.positions_m.emplace_back(0.0);
        }
        coarse.positions_m[of_cell] += mesh.positions_m[v];
        ++counts[of_cell];
        return merged[v] = of_cell;
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& corners = mesh.triangles[t];
        const std::array<std::uint32_t, 3> to{vertex(corners[0]), vertex(corners[1]), vertex(corners[2])};
        if (to[0] == to[1] || to[1] == to[2] || to[2] == to[0]) continue;
        coarse.triangles.push_back(to);
        if (!mesh.triangle_materials.empty()) coarse.triangle_materials.push_back(mesh.triangle_materials[t]);
    }
    for (std::size_t v = 0; v < counts.size(); ++v) coarse.positions_m[v] /= counts[v];
    return coarse;
}

}  // namespace burin::geometry

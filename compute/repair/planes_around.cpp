// SPDX-License-Identifier: MIT
#include "compute/repair/planes_around.hpp"

#include <cmath>

#include "shaders/shared/octahedral.h"

namespace burin::compute {

const std::vector<TangentPlane>& PlanesAround::at(std::uint32_t vertex) {
    const Lattice& lattice = solid_.lattice;
    const auto whole = [](double x) { return static_cast<int>(std::floor(x)); };
    const auto [known, fresh] = planes_.try_emplace(vertex);
    if (!fresh) return known->second;
    const Vec3 cells = (vertices_m_[vertex] - lattice.origin_object) / lattice.spacing_m;
    for (int axis = 0; axis < 3; ++axis) {
        const double at_u = cells[(axis + 1) % 3], at_v = cells[(axis + 2) % 3];
        for (int ray_v = whole(at_v - 1.0) + 1; ray_v <= at_v + 1.0; ++ray_v) {
            for (int ray_u = whole(at_u - 1.0) + 1; ray_u <= at_u + 1.0; ++ray_u) {
                add_crossings(axis, ray_u, ray_v, cells[axis], known->second);
            }
        }
    }
    return known->second;
}

void PlanesAround::add_crossings(int axis, int u, int v, double at_cells, std::vector<TangentPlane>& planes) const {
    const Lattice& lattice = solid_.lattice;
    if (u < 0 || v < 0 || u >= lattice.rays_u(axis) || v >= lattice.rays_v(axis)) return;
    const std::size_t ray =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(lattice.rays_u(axis)) + static_cast<std::size_t>(u);
    for (const shared::DexelEnd& end : solid_.sets[static_cast<std::size_t>(axis)].ends(ray)) {
        const double depth = shared::depth_of(end);
        if (std::abs(depth - at_cells * shared::kUnitsPerCell) > shared::kUnitsPerCell) continue;
        Vec3 units;
        units[axis] = depth;
        units[(axis + 1) % 3] = static_cast<double>(u) * shared::kUnitsPerCell;
        units[(axis + 2) % 3] = static_cast<double>(v) * shared::kUnitsPerCell;
        const shared::Direction n = shared::decode_normal(end.normal);
        planes.push_back({lattice.object_from_units(units), Vec3(n.x, n.y, n.z)});
    }
}

}  // namespace burin::compute

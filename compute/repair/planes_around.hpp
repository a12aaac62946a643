// SPDX-License-Identifier: MIT
// The tangent planes that a solid's rays give around the vertices of its mesh; the deviation of a moved vertex is
// measured against them.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "compute/rays/solid.hpp"

namespace burin::compute {

struct TangentPlane {
    Vec3 point_m, normal;
};

// Finds tangent planes and caches them by vertex. Frame: the object frame. To be used from one thread.
class PlanesAround {
public:
    // Takes the vertices as they were meshed.
    PlanesAround(const Solid& solid, const std::vector<Vec3>& vertices_m) : solid_(solid), vertices_m_(vertices_m) {}

    // Returns the tangent planes at the ends of rays within a cell's width of the vertex, along each axis. The search
    // is not limited to the vertex's own cell: a feature may lie in a cell that has no crossing.
    [[nodiscard]] const std::vector<TangentPlane>& at(std::uint32_t vertex);

private:
    void add_crossings(int axis, int u, int v, double at_cells, std::vector<TangentPlane>& planes) const;

    const Solid& solid_;
    const std::vector<Vec3>& vertices_m_;
    std::unordered_map<std::uint32_t, std::vector<TangentPlane>> planes_;  // cache, by vertex
};

}  // namespace burin::compute

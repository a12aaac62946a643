// SPDX-License-Identifier: MIT
// The planes that a solid's rays give around the vertices of its mesh: what a moved vertex is measured against.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "compute/solid.hpp"

namespace burin {

struct TangentPlane {
    Vec3 point_m, normal;
};

// Frame: the object frame. One thread: what was asked is remembered.
class PlanesAround {
public:
    // The vertices as they were meshed.
    PlanesAround(const Solid& solid, const std::vector<Vec3>& vertices_m) : solid_(solid), vertices_m_(vertices_m) {}

    // Of the surface where rays cross it within a cell's width of the vertex, along each axis. Not only in the vertex' own
    // cell: a feature may lie in a cell that has no crossing.
    [[nodiscard]] const std::vector<TangentPlane>& at(std::uint32_t vertex);

private:
    void add_crossings(int axis, int u, int v, double at_cells, std::vector<TangentPlane>& planes) const;

    const Solid& solid_;
    const std::vector<Vec3>& vertices_m_;
    std::unordered_map<std::uint32_t, std::vector<TangentPlane>> planes_;  // of the vertices looked at
};

}  // namespace burin

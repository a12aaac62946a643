// SPDX-License-Identifier: MIT
// What of a tool's mesh lies below a plane and looks into the material: its faces clipped at the plane, independent of
// the samples that a tick cuts with.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/space.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::haptics::test {

struct AreaInPlane {
    double area_m2 = 0.0;
    Vec3 vector_m2{0.0};  // of each face along its outward normal
};

// The part of a triangle that lies below height 0, as a vector along its normal.
inline Vec3 area_below(const std::array<Vec3, 3>& t) {
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = t.at(i), &b = t.at((i + 1) % 3);
        if (a.y <= 0.0) part.push_back(a);
        if ((a.y < 0.0) != (b.y < 0.0) && a.y != b.y) part.push_back(a + (a.y / (a.y - b.y)) * (b - a));
    }
    Vec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < part.size(); ++i) sum += 0.5 * glm::cross(part[i] - part[0], part[i + 1] - part[0]);
    return sum;
}

// Of the faces that look down, and so move into the material, below the plane at height 0.
inline AreaInPlane area_in_plane(const geometry::TriangleMesh& mesh, const Pose& pose) {
    AreaInPlane sum;
    for (const auto& t : mesh.triangles) {
        const std::array<Vec3, 3> corners{pose * mesh.positions_m[t[0]], pose * mesh.positions_m[t[1]],
                                          pose * mesh.positions_m[t[2]]};
        const Vec3 out = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(out.y < 0.0)) continue;
        const Vec3 below = area_below(corners);
        sum.area_m2 += glm::length(below);
        sum.vector_m2 += below;
    }
    return sum;
}

}  // namespace burin::haptics::test

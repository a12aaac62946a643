// SPDX-License-Identifier: MIT
#include "geometry/mesh/mesh_placing.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace burin::geometry {

Result<void> check_scale(double scale) {
    const double size = std::abs(scale);
    if (size >= kSmallestScale && size <= kLargestScale) return {};
    return fail("--scale", scale == 0.0 ? "would leave nothing of the mesh" : "is beyond what a mesh is scaled by",
                "give a factor from 1e-6 to 1e6; a negative one mirrors");
}

Box bounds_of(const TriangleMesh& mesh) {
    Box bounds;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) bounds.include(mesh.positions_m[v]);
    return bounds;
}

void turn_over(TriangleMesh& mesh) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

void place_mesh(TriangleMesh& mesh, const Placing& placing) {
    const Vec3 from = placing.middle_m ? bounds_of(mesh).center() : Vec3(0.0);
    const Vec3 to = placing.middle_m.value_or(Vec3(0.0));
    for (Vec3& p : mesh.positions_m) p = (p - from) * placing.scale + to;
    if (placing.mirrors()) turn_over(mesh);
}

}  // namespace burin::geometry

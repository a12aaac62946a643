// SPDX-License-Identifier: MIT
// A flat plane, however finely meshed: its edges are nothing to be felt.
#pragma once

#include <cmath>
#include <cstdint>

#include "tests/haptics/smooth_shapes.hpp"

namespace burin::haptics::test {

// A square piece of a plane through the origin whose edges run askew to the axes, meshed as a publisher does it.
struct FinePlane {
    Vec3 across{1.0, 0.0, 0.0}, normal{0.0, 1.0, 0.0}, along{0.0, 0.0, 1.0};
    Surface surface;
};

enum class Meshed { as_mesh, loose };

inline FinePlane fine_plane(double edge_m, double half_m, Meshed how) {
    FinePlane plane;
    const Quat tilt = glm::normalize(Quat(1.0, 0.21, 0.13, -0.17));
    plane.across = tilt * plane.across, plane.normal = tilt * plane.normal, plane.along = tilt * plane.along;
    const int n = static_cast<int>(std::ceil(2.0 * half_m / edge_m));
    geometry::TriangleMesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            mesh.positions_m.push_back((-half_m + i * edge_m) * plane.across + (-half_m + j * edge_m) * plane.along);
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    if (how == Meshed::as_mesh) {
        plane.surface = touchable(mesh);
        return plane;
    }
    SurfaceBuilder builder;
    for (const Vec3& p : mesh.positions_m) builder.vertex(p);
    for (const auto& t : mesh.triangles) builder.triangle(t[0], t[1], t[2]);
    plane.surface = builder.finish();
    return plane;
}

}  // namespace burin::haptics::test

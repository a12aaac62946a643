// SPDX-License-Identifier: MIT
// Makes the samples of a tool's surface that the tick cuts with (haptics/forces/tool_surface.hpp).
// Frame: tool, metres. Allocates; not for the haptic thread.
#pragma once

#include <vector>

#include "geometry/mesh/triangle_mesh.hpp"
#include "haptics/forces/tool_surface.hpp"

namespace burin::toolbox {

struct SurfacePoint {
    Vec3 position_m{0.0}, normal{0.0};
    double area_m2 = 0.0;  // of its triangle
};

// Chooses triangles of a mesh, at most so many, each the farthest from those before; normals that differ by one count
// as turn_m apart.
[[nodiscard]] std::vector<SurfacePoint> spread_points(const geometry::TriangleMesh& mesh, std::uint32_t most,
                                                      double turn_m);

// Samples a closed mesh that is turned outward. An empty mesh or a size of 0 gives a tool that does not cut.
[[nodiscard]] haptics::ToolSurface tool_surface(const geometry::TriangleMesh& mesh, double size_m);

// The same tool in another size; a factor of 0 gives a tool that does not cut.
[[nodiscard]] haptics::ToolSurface scaled(haptics::ToolSurface tool, double factor);

}  // namespace burin::toolbox

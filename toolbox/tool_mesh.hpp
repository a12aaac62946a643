// SPDX-License-Identifier: MIT
// A tool's shape as triangles: for what the hand feels of it, and to be drawn.
// Frame: tool, metres (compute/tools/tool.hpp). Pure; allocates.
#pragma once

#include <vector>

#include "compute/tools/tool.hpp"

namespace burin::toolbox {

// A point of the outline that is turned about +Y: its distance from the axis, and its height.
struct OutlinePoint {
    double radius_m = 0.0, height_m = 0.0;
};
using Outline = std::vector<OutlinePoint>;  // from the lowest point outward and up
// Return the outlines of the kinds that are turned. Others have none, and do not compile.
[[nodiscard]] Outline outline_of(const compute::BallTool& tool);
[[nodiscard]] Outline outline_of(const compute::CylinderTool& tool);
[[nodiscard]] Outline outline_of(const compute::ConeTool& tool);
[[nodiscard]] Outline outline_of(const compute::BullNoseTool& tool);

// The box along the tool's axes that just contains it.
[[nodiscard]] Box bounds_of(const compute::ToolShape& shape);

// Half of the tool's least width: the length that its details are measured against. A ball's radius.
[[nodiscard]] double size_of(const compute::ToolShape& shape);

// The radius of a ball about the tool's origin that contains it.
[[nodiscard]] double reach_of(const compute::ToolShape& shape);

// A line that stands for the tool where its shape need not be exact, thickened by a radius: where its shadow falls, how
// near it is. A ball's is its middle.
struct Spine {
    Vec3 from_m{0.0}, to_m{0.0};
    double radius_m = 0.0;
};
[[nodiscard]] Spine spine_of(const compute::ToolShape& shape);

// The height, along the tool's +Y, at which its shaft begins: a ball's middle, the top of others.
[[nodiscard]] double shaft_height_m(const compute::ToolShape& shape);

// How far the tool's tip, the end of it along its own -Y, is from its origin.
[[nodiscard]] double tip_m(const compute::ToolShape& shape);

// Triangles to be drawn: few, and turned outlines in 48 parts around. Of a mesh, its own.
[[nodiscard]] geometry::TriangleMesh drawing_of(const compute::ToolShape& shape);

// Triangles no longer than about an eighth of the tool's size, or more where there would be too many. Closed and turned
// outward; neighbours need not share vertices.
[[nodiscard]] geometry::TriangleMesh mesh_of(const compute::ToolShape& shape);

}  // namespace burin::toolbox

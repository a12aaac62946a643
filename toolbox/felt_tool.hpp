// SPDX-License-Identifier: MIT
// What the hand feels of a tool: the shape that touches, and the surface that cuts.
//
// A ball touches as what it is. Any other shape touches as convex pieces with rounded edges
// (haptics/contact/tool_shape.hpp), smaller than the tool by the clearance that a ball has too, so that it can lie in
// the bed that it has cut. `differs_m` is how far the felt surface is from the tool's at most, measured at points all
// over it: on faces the clearance, at edges and corners what the rounding takes. A mesh that is not convex is felt as
// its convex hull, and differs by the depth of its hollows.
// Frame: tool, metres. Allocates; not for the haptic thread.
#pragma once

#include "compute/tools/tool.hpp"

#include "haptics/contact/probe.hpp"
#include "haptics/contact/tool_shape.hpp"
#include "haptics/forces/tool_surface.hpp"

namespace burin::toolbox {

struct FeltTool {
    haptics::Probe probe;
    haptics::ToolShape shape;
    haptics::ToolSurface surface;
    double differs_m = 0.0;
};

[[nodiscard]] FeltTool felt_tool(const compute::ToolShape& shape);

}  // namespace burin::toolbox

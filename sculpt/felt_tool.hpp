// SPDX-License-Identifier: MIT
// What the hand feels of a tool: balls that touch, and the surface that cuts.
//
// A ball touches as what it is. Of any other shape up to kMostProbePoints balls that lie inside touch: one after the
// other is chosen, from the largest that fit at each of 400 points of its surface, so that as little as possible stands
// out of them. `uncovered_m` is what stands out in the end: so far an edge may sink in between two balls. It is a
// quarter of half the width of mills and cones, half of it for a box of 2 by 3 by 4, nearly all of it for a disc five
// times as wide as thick; cutting is resisted by the whole surface all the same. The balls are one rigid body
// (haptics/contact/probe.hpp) and keep a clearance of the tool's size, as a ball does.
// Frame: tool, metres. Allocates; not for the haptic thread.
#pragma once

#include "compute/tools/tool.hpp"
#include "haptics/channels.hpp"

namespace burin::sculpt {

struct FeltTool {
    haptics::Probe probe;
    haptics::ToolSurface surface;
    double uncovered_m = 0.0;
};

[[nodiscard]] FeltTool felt_tool(const compute::ToolShape& shape);

}  // namespace burin::sculpt

// SPDX-License-Identifier: MIT
// What the hand feels of a tool: balls that touch, and the surface that cuts.
//
// A ball touches as what it is. Of any other shape up to kMostProbePoints balls that lie inside touch, each the largest
// that fits where it was put: one after the other they go to where the shape stands out farthest from those before
// (`uncovered_m` is what it stands out by in the end, so much may sink in between two balls). They are one rigid body
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

// SPDX-License-Identifier: MIT
// The motion of a simulated hand that carves along a stroke: where it wants the tool to be, and how it presses.
// Frames: the stroke's is the object's, the hand's the device's; metres, seconds since its first tick. Pure.
#pragma once

#include "base/error.hpp"
#include "base/space.hpp"
#include "compute/tools/tool.hpp"
#include "devices/hand/simulated_hand.hpp"
#include "sculpt/stroke_file.hpp"

namespace burin::haptics {
struct ToolSurface;  // haptics/forces/tool_surface.hpp
}  // namespace burin::haptics

namespace burin::sculpt {
class Sculpture;  // sculpt/sculpture.hpp
}  // namespace burin::sculpt

namespace burin::toolbox {
struct Feel;  // toolbox/feel_options.hpp
}  // namespace burin::toolbox

namespace burin::activities {

// Rest before and after the stroke; the gate's ramp must be over by then.
inline constexpr double kHandRests_s = 0.3;

// Returns object_from_device with the stroke's bounds centred in the workspace; where they are larger, the motion is
// scaled up.
[[nodiscard]] Similarity fit_into_workspace(const sculpt::Stroke& stroke, const Vec3& workspace_m);

// Builds a hand that presses into the workpiece as it is before the stroke. tool_surface: what cuts of the tool.
[[nodiscard]] Result<devices::SimulatedHand> pressing_hand(const sculpt::Sculpture& carving,
                                                           const sculpt::Stroke& stroke, const compute::ToolShape& tool,
                                                           const haptics::ToolSurface& tool_surface,
                                                           const toolbox::Feel& feel,
                                                           const Similarity& object_from_device);

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
// --hand simulated: a simulated hand leads a simulated Omni along the stroke, feels the surface through the haptic loop, and
// is pushed back by it. What the tool cuts is set by the force and by the hardness of the material.
//
// Data flow: hand -> device -> haptic loop (1 kHz) -> ring of stroke samples -> carving update (100 Hz) -> local surface ->
// haptic loop. In simulated time both sides run in turn on one thread, as fast as they can, and every run gives the same
// bits; in real time the haptic loop has a thread of its own.
#pragma once

#include "app/carving.hpp"
#include "app/feel_options.hpp"
#include "app/felt_figures.hpp"
#include "app/stroke_file.hpp"
#include "app/tool_option.hpp"

namespace burin {

struct FeltOptions {
    Feel feel;
    bool real_time = false;
};

// The tool must be a ball: that is what is felt. The stroke must fit: its bounds are centred in the workspace and, where they are larger, the motion is scaled up.
[[nodiscard]] Result<FeltFigures> carve_by_feel(Carving& carving, const Stroke& stroke, const Tool& tool,
                                                const FeltOptions& options);

}  // namespace burin

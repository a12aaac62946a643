// SPDX-License-Identifier: MIT
// Carves by feel (--hand simulated): a simulated hand leads a simulated Omni along the stroke, feels the surface
// through the haptic loop, and is pushed back by it. The force and the material's hardness set what the tool cuts.
//
// Data flow: hand -> device -> haptic loop (1 kHz) -> ring of stroke samples -> carving update (100 Hz) -> local
// surface -> haptic loop, driven as every session is (session/drive/driver.hpp), by a source whose frames only collect
// figures. In simulated time both sides run in turn on one thread, as fast as they can, and every run gives the same
// bits; in real time the haptic loop has a thread of its own.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sculpt/sculpture.hpp"
#include "sculpt/stroke_file.hpp"
#include "session/felt/felt_figures.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::session {

struct FeltOptions {
    toolbox::Feel feel;
    bool real_time = false;
    std::string record = {};  // a new session file (record/record_writer.hpp); empty: none
    // Facts of the session for that file.
    std::vector<std::pair<std::string, std::string>> facts = {};
};

// Returns object_from_device with the stroke's bounds centred in the workspace; where they are larger, the motion is
// scaled up.
[[nodiscard]] Similarity fit_into_workspace(const sculpt::Stroke& stroke, const Vec3& workspace_m);

// Carves the stroke with the simulated hand, which feels any tool as its shape, in the workspace as
// fit_into_workspace() has it. A recording that fails ends the stroke.
[[nodiscard]] Result<FeltFigures> carve_by_feel(sculpt::Sculpture& carving, const sculpt::Stroke& stroke,
                                                const toolbox::Tool& tool, const FeltOptions& options);

}  // namespace burin::session

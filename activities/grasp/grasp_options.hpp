// SPDX-License-Identifier: MIT
// Options of a hand in a glove (activities/grasp/grasp.hpp), which a recording keeps.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"

namespace burin::activities {

// The stiffness that each point of a fingertip's patch renders, from that of the surface.
enum class PatchStiffness : std::uint8_t {
    shared,   // each point has its share, so that a patch is as stiff as one point
    literal,  // each point has all of it, as the paper has it: more points make a harder ball
};

struct GraspOptions {
    unsigned points = 5;  // of a fingertip's patch; 1 to 5
    PatchStiffness stiffness = PatchStiffness::shared;
};
inline constexpr unsigned kMostFingertipPoints = 5;

// Reads what Grasp::settings() has written. Fails on anything else.
[[nodiscard]] Result<GraspOptions> grasp_options_of(const std::string& settings);

}  // namespace burin::activities

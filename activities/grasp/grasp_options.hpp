// SPDX-License-Identifier: MIT
// Options of a hand in a glove (activities/grasp/grasp.hpp), which a recording keeps.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"

namespace burin::activities {

// The stiffness that each point of a fingertip's patch renders, from that of the surface.
enum class PatchStiffness : std::uint8_t {
    shared,   // each point has the share of its area, so that a patch pressed flat is as stiff as one point
    literal,  // each point has all of it, as the paper has it: more points make a harder ball
};

// Where the force of a contact that rests is made.
enum class GloveRendering : std::uint8_t {
    distributed,  // at the host, and sent over the line
    local,        // at the glove's controller, by a law of the piston's length
};

struct GraspOptions {
    unsigned points = 5;     // of a fingertip's patch; 1 to 5
    double extent_mm = 6.0;  // from a patch's middle to its neighbours, along the skin; 1 to 7
    PatchStiffness stiffness = PatchStiffness::shared;
    GloveRendering rendering = GloveRendering::distributed;
    // Closures between which this person's hand goes; a gesture is told by the share of that way. An exercise sets
    // them, and keeps them among its own settings.
    double open = 0.0, closed = 1.0;
};
inline constexpr unsigned kMostFingertipPoints = 5;
inline constexpr double kLeastExtent_mm = 1.0, kMostExtent_mm = 7.0;

// Reads what Grasp::settings() has written. Fails on anything else.
[[nodiscard]] Result<GraspOptions> grasp_options_of(const std::string& settings);

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
// Figures of one trial, as the thesis has them of a sample trial: the path of both points (its Figure 36), the
// deviations of the top and of the bottom point along each axis (37 and 38), and the two that its text has lost, the
// forces of both points. From what the haptic model makes of the trial's motion (study/felt/stage_session.hpp).
// Each is an SVG of its own; lines of many points are thinned. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "study/felt/repeated_stage.hpp"

namespace burin::study {

struct ShownTrial {
    std::string name;  // "haptic: p03, first trial"
    ModelTouch model;
    const StudyWorld* world = nullptr;
};

[[nodiscard]] std::vector<std::string> trial_figures(const ShownTrial& trial);

}  // namespace burin::study

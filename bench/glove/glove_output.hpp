// SPDX-License-Identifier: MIT
// What `burin bench glove` prints and draws.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "bench/glove/fingertip_press.hpp"
#include "bench/glove/line_rendering.hpp"
#include "bench/glove/line_trial.hpp"

namespace burin::bench {

struct GloveFigures {
    // The patch by which a session's fingertips feel, which the table marks.
    std::size_t default_points = 0;
    double default_extent_m = 0.0;
    PressFigures press;
    PressTask task;
    std::vector<LineFigures> lines;
    std::vector<TrialFigures> trials;  // on the emulated glove; empty: not measured
    double measured_sets_per_s = 0.0;  // of the emulated glove on a pseudo-terminal; 0: not measured
};

[[nodiscard]] std::string glove_table(const GloveFigures& figures);
[[nodiscard]] Json glove_json(const GloveFigures& figures);
[[nodiscard]] std::string glove_svg(const GloveFigures& figures);

}  // namespace burin::bench

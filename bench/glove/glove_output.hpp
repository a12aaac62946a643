// SPDX-License-Identifier: MIT
// What `burin bench glove` prints and draws.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "bench/glove/fingertip_press.hpp"
#include "bench/glove/line_rendering.hpp"

namespace burin::bench {

struct GloveFigures {
    PressFigures press;
    PressTask task;
    std::vector<LineFigures> lines;
    double measured_sets_per_s = 0.0;  // of the emulated glove on a pseudo-terminal; 0: not measured
};

[[nodiscard]] std::string glove_table(const GloveFigures& figures);
[[nodiscard]] Json glove_json(const GloveFigures& figures);
[[nodiscard]] std::string glove_svg(const GloveFigures& figures);

}  // namespace burin::bench

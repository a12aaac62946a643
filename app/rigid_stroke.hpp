// SPDX-License-Identifier: MIT
// --hand rigid: the tool follows the stroke exactly; no device, no forces. One update for each row with the button pressed.
#pragma once

#include "app/carving.hpp"
#include "app/stroke_file.hpp"

namespace burin {

struct Tool {
    double radius_m = 0.0;      // of the ball, object frame
    std::uint8_t material = 0;  // what its cuts leave behind
};

// A pressed row sweeps the tool from the row before if that was pressed too, else stamps it where it is.
[[nodiscard]] Result<void> carve_rigidly(Carving& carving, const Stroke& stroke, const Tool& tool);

}  // namespace burin

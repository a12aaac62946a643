// SPDX-License-Identifier: MIT
// --hand rigid: the tool follows the stroke exactly; no device, no forces.
#pragma once

#include "app/carving.hpp"
#include "app/stroke_file.hpp"
#include "app/tool_option.hpp"

namespace burin {

// A pressed row sweeps the tool from the row before if that was pressed too, else stamps it where it is. One update for each
// sweep; with merge_rows, rows of one orientation that a straight sweep replaces to within the tool's tolerance are one sweep,
// else every pressed row is one.
[[nodiscard]] Result<void> carve_rigidly(Carving& carving, const Stroke& stroke, const Tool& tool, bool merge_rows);

}  // namespace burin

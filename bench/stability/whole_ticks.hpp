// SPDX-License-Identifier: MIT
// Measures, in whole ticks with the gate, what a hand at rest feels when ticks are lost and on a plate that moves.
//
// Lost ticks: a simulated Omni that a hand presses on a plate, at rest; forty bursts of lost ticks, twenty ticks apart
// (one burst of thirty). How far the tool sinks in, and what bears it two seconds later.
// Moving plate: a plate that goes to and fro by 3 mm under a hand that holds still 1 to 4 mm below its surface. It is
// published at random 60 to 120 times a second, as a physics engine does, with the velocity that holds then, so that it
// turns back between two publications. What is felt, against spring and damper at its true height.
#pragma once

#include <vector>

#include "base/json.hpp"

namespace burin::bench {

// Rows of section "lost ticks" (pressed_N, lost_ticks, sunk_mm, force_after_N) and "moving plate" (speed_m_per_s,
// felt_N, true_N, steepest_N: the largest rise in a tick). Deterministic.
[[nodiscard]] std::vector<Json> run_whole_ticks(bool quick);

}  // namespace burin::bench

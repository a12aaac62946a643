// SPDX-License-Identifier: MIT
// Scenes of a tool in the groove that it cuts, against what is right: each function is one run of a hand over a block
// (carving_hand.hpp), in simulated time, and gives the same figures on every machine. Tests and the bench share them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/haptics/carving_hand.hpp"

namespace burin::bench {

// A groove of 10 mm, 3 mm deep, between upright walls; then the button comes up and the hand lifts the tool straight
// up. Right is no force once the tool is 0.5 mm clear.
struct LiftedTick {
    double height_m = 0.0, given_N = 0.0;  // above the groove's floor; as given to the device
};
struct Lifted {
    std::vector<LiftedTick> way;
    double most_inside_N = 0.0;  // before it is clear, as asked
    double most_clear_N = 0.0;   // as given
    std::uint64_t ticks = 0, limited = 0, held_clear = 0, let_go = 0;
};
[[nodiscard]] Lifted lift_out(const compute::ToolShape& tool, int resolution, double speed_m_per_s);

// A tool pressed with a constant force, so many times what the material bears of its section, from this depth on.
struct Sunk {
    double law_m_per_s = 0.0, found_m_per_s = 0.0;
    std::uint64_t ticks = 0, limited = 0;
};
[[nodiscard]] Sunk sink(const compute::ToolShape& tool, int resolution, double of_yield, double from_m);

// A groove 1.5 mm deep; then the tool goes through it again, button up, with the hand 0.7 mm deeper. Right is the
// spring's 0.7 mm.
struct CarvedAgain {
    double right_N = 0.0, mean_N = 0.0, most_N = 0.0;
    std::uint64_t ticks = 0, limited = 0, let_go = 0;
    std::vector<double> cost_us;
};
[[nodiscard]] CarvedAgain carve_again(const compute::ToolShape& tool, int resolution, double speed_m_per_s);

// A hand that is held 1.5 mm deep and goes along at 11 mm/s with the button down.
struct Drawn {
    double mean_N = 0.0, removed_mm3 = 0.0;
    std::uint64_t ticks = 0, limited = 0, let_go = 0;
    std::vector<double> cost_us;
};
[[nodiscard]] Drawn draw_along(const compute::ToolShape& tool, int resolution);

// A tool that is set on the face and pressed straight down by a hand that stays 2 mm deeper than it has cut, until it
// is 4 mm deep. `at_once`: the button is down before the tool is on the face, and the force is still fading in.
struct Plunged {
    double fastest_m_per_s = 0.0;  // of the cutting point, over ten ticks
    std::uint64_t ticks = 0, without_force = 0, let_go = 0;
    double most_cost_us = 0.0;
};
[[nodiscard]] Plunged plunge(const compute::ToolShape& tool, int resolution, bool at_once);

}  // namespace burin::bench

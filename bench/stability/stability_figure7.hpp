// SPDX-License-Identifier: MIT
// The PowerWall paper's Figure 7: the components of the force over time while a tool is pressed on a ball and moved
// over it, with the velocity taken as a plain difference, without a filter on the force and with alpha = 0.9; and,
// third, with Burin's defaults: no filter on the force, velocity by adaptive windows.
//
// The device is the simulated Omni in the simulated hand (devices/), in 3-D; the ball is exact. The paper gives neither
// its stiffness nor its damping nor the motion; typical values stand in (600 N/m, 2 Ns/m, a ball of 50 mm radius).
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/space.hpp"
#include "haptics/signals/filters.hpp"

namespace burin::bench {

struct Figure7Run {
    std::string name;
    haptics::SignalSettings signals;
    std::vector<Vec3> forces_N;  // commanded, one a tick of 1 ms
    double change_rms_N = 0.0;   // of the force from tick to tick, while in contact
    double change_mean_N = 0.0;  // likewise, the mean magnitude
    double noise_rms_N = 0.0;    // against the force of the true motion, shifted by the lag
    double lag_ms = 0.0;         // behind the force of the true motion: the shift of least difference
    double largest_stable_stiffness_N_per_m = 0.0;  // tapping a wall with the same damping, 1 ms of delay
};

struct Figure7 {
    double stiffness_N_per_m = 600.0, damping_Ns_per_m = 2.0, tick_s = 0.001;
    std::vector<Figure7Run> runs;
};

// quick: omits the largest stable stiffness.
[[nodiscard]] Figure7 run_figure7(bool quick);

[[nodiscard]] std::string figure7_table(const Figure7& figure);
[[nodiscard]] std::string figure7_svg(const Figure7& figure);
[[nodiscard]] Json figure7_json(const Figure7& figure);

}  // namespace burin::bench

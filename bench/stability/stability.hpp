// SPDX-License-Identifier: MIT
// Measures how stiff a wall may be before a simulated device in a simulated hand
// becomes unstable: over rate, delay, force filter, velocity estimate and controller;
// against theory where there is one; and how a contact goes under each controller.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "bench/stability/stability_figure7.hpp"
#include "bench/stability/stability_sim.hpp"

namespace burin::bench {

struct NamedGrip {
    const char* name;
    HandTask task;
    devices::HandGrip grip;
};
// Returns no hand; light; hand (0.1 kg, 100 N/m, 3 Ns/m, that of the published comparison); firm; rigid.
[[nodiscard]] const std::vector<NamedGrip>& grips();

// One row a figure. "section" is theory, rate, delay, filter, velocity, controller (each with
// largest_stable_stiffness_N_per_m, up to which all tested ones are stable, first_failure_N_per_m, and
// failing_share_above of the tested ones from there to the end of the scan) or contact (with the figures of one
// contact).
struct Stability {
    std::vector<Json> rows;
    std::vector<Json> whole_ticks;  // bench/stability/whole_ticks.hpp
    Figure7 figure7;
};

// quick: a few points of each section. Deterministic.
[[nodiscard]] Stability run_stability(bool quick);

[[nodiscard]] std::string stability_table(const Stability& stability);
[[nodiscard]] std::string stability_csv(const Stability& stability);
[[nodiscard]] std::string stability_svg(const Stability& stability);
[[nodiscard]] Json stability_json(const Stability& stability);

}  // namespace burin::bench

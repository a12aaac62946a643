// SPDX-License-Identifier: MIT
// Measures soft bodies: a ball between plates beside Tatara (1991) and Hertz, its volume, what a step costs, and how
// far the result depends on sweeps and steps; and the trials of bench/body/soft_trials.hpp.
// docs/decisions/030-bodies-that-give.md has the figures. Units: SI. One thread; some seconds to minutes.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "bench/body/soft_trials.hpp"

namespace burin::bench {

struct BodyBenchTask {
    double radius_m = 0.032, young_Pa = 100e3, poisson = 0.48;
    double elements_along_radius = 4.4;  // of the lattice: 4,752 tetrahedra
    bool quick = false;                  // plates alone, without the table over sweeps and steps
    double still_s = 60.0;
    std::size_t kneads = 100, grasps = 200;
};

struct PressedBall {
    double closed_share = 0.0;  // of the radius, by each plate
    unsigned sweeps = 4;
    double dt_s = 0.004;
    double force_N = 0.0, elastic_N = 0.0, tatara_N = 0.0, hertz_N = 0.0;
    double volume_share = 1.0, least_share = 1.0, drift = 0.0;  // bodies/solver/plates.hpp
    double step_ms = 0.0;                                       // on average, on this machine
};
struct BodyBenchFigures {
    BodyBenchTask task;
    std::size_t elements = 0, corners = 0;
    std::vector<PressedBall> squeezes;  // from 0.01 to 0.5 of the radius
    std::vector<PressedBall> settings;  // at 0.1, over sweeps and steps
    StillPutty still;
    KneadedPutty kneaded;
    RandomGrasps grasps;
    std::vector<MeetingFingers> meeting;
    std::vector<DentedByAPoint> dented;
    std::vector<FeltBetweenSteps> felt;
};
// Fails on a ball that cannot be.
[[nodiscard]] Result<BodyBenchFigures> measure_body(const BodyBenchTask& task);
[[nodiscard]] std::string body_bench_table(const BodyBenchFigures& figures);
[[nodiscard]] Json body_bench_json(const BodyBenchFigures& figures);
// Draws force over squeeze beside the references; CalculiX' forces as scripts/ball-beside-calculix writes them, or an
// empty list.
[[nodiscard]] std::string body_force_svg(const BodyBenchFigures& figures, const Json& calculix);
// Draws the dents of the paper's model in a ball, as printed beside corrected: before the finger touches, with it 3 mm
// deep, and after it has rested for a second.
[[nodiscard]] std::string paper_dents_svg();

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
// Trials of soft bodies as fingertips press them, of five points each, by the part of the scene that a session runs
// (bodies/soft_part.hpp): putty under fingers that stay still and that knead it, random grasps, fingers from two sides
// that come to meet, and what a tick feels between two steps of the body. Units: SI. One thread; seconds to many
// minutes, by the counts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/space.hpp"

namespace burin::bench {

// Two fingers go 0.25 of the radius into a ball of putty and stay there. The dent is by how much the ball is narrower
// when they have gone.
struct StillPutty {
    double early_s = 1.0, late_s = 60.0;
    double early_dent_m = 0.0, late_dent_m = 0.0, early_N = 0.0, late_N = 0.0;
    double paper_early_m3 = 0.0, paper_late_m3 = 0.0;  // what the paper's model has pushed in, printed, 60 frames a s
};
[[nodiscard]] StillPutty hold_putty(double late_s);

// Two fingers from any direction, down to 0.45 of where the surface was at first.
struct KneadedPutty {
    std::size_t kneads = 0, elements = 0, stopped = 0;
    std::size_t inverted = 0;  // elements when the fingers are deepest, of all kneads
    double volume_share = 1.0, least_share = 1.0, worst_rest_quality = 1.0;  // when it has been let go
    double enclosed_share = 1.0;                                             // by the surface that is drawn
    double step_ms = 0.0;
};
[[nodiscard]] KneadedPutty knead_putty(std::size_t kneads);

// Four fingertips from random sides, each to a random depth of up to 1.2 radii. Asked: what the models ask for; given:
// what the gate lets through to a device of 10 N.
struct RandomGrasps {
    std::size_t grasps = 0, not_finite = 0, inverted_after = 0;
    double most_asked_N = 0.0, most_given_N = 0.0, limit_N = 10.0;
};
[[nodiscard]] RandomGrasps grasp_at_random(std::size_t grasps);

// Two fingers, by the share of the radius that each has gone in; 1: they meet in the middle.
struct MeetingFingers {
    double share = 0.0, force_N = 0.0, volume_share = 1.0, least_share = 1.0;
};
[[nodiscard]] std::vector<MeetingFingers> squeeze_until_they_meet();

// One point of 1 mm presses a ball so deep, from four directions. The force over that of Hertz, whose law is of dents
// that are small beside both.
struct DentedByAPoint {
    double depth_m = 0.0, mean_N = 0.0, over_hertz = 0.0, least_over_hertz = 0.0, most_over_hertz = 0.0;
};
[[nodiscard]] std::vector<DentedByAPoint> dent_by_a_point();

// A finger goes 4 mm in and out; the truth is the same body stepped each millisecond with 20 sweeps.
struct FeltBetweenSteps {
    double young_Pa = 0.0, hertz = 0.0;
    double most_N = 0.0, held_off_N = 0.0, model_off_N = 0.0;  // rms: the surface held still, the local model
    double true_step_N = 0.0, felt_step_N = 0.0;
};
[[nodiscard]] std::vector<FeltBetweenSteps> feel_between_steps();

}  // namespace burin::bench

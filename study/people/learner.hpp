// SPDX-License-Identifier: MIT
// Simulated people, to try a protocol and its analysis before anybody sits down. They know no published result: the
// groups differ by `effect` alone, which is 0 by default, so that an analysis can be checked to find what was put in.
//
// A learner's hand goes along the tube's axis with the speed profile of least jerk and wanders off it by a few slow
// waves. No force acts on it: neither the tube's wall nor guidance is simulated. Metres and seconds; pure; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/space.hpp"
#include "study/metrics/trial_metrics.hpp"
#include "study/protocol/protocol.hpp"
#include "study/statistics/random.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {

// Medians over people; spreads are standard deviations of the natural logarithm. All are choices of ours, no findings.
struct LearnerPopulation {
    double wander_m = 0.035, wander_spread = 0.35, wander_trial_spread = 0.10;
    double pace_m_per_s = 0.15, pace_spread = 0.25, pace_trial_spread = 0.08;
    double learns_per_min = 0.04;  // the share of the wander that a minute of training takes away
    double stray_chance = 0.05;    // of an attempt
    // In outcome trials, by how many wander_spreads the wander of the protocol's first group is below the others'.
    double effect = 0.0;
};

struct Learner {
    double log_wander = 0.0, log_pace = 0.0;  // of metres and of metres a second
    bool first_group = false;
    double trained_min = 0.0;
};
[[nodiscard]] Learner draw_learner(const LearnerPopulation& population, bool first_group, Random& random);

// Where the wand's two points were at each tick (1 kHz) of the attempt that counted, and what the stage made of it.
struct SimulatedStage {
    StageState end;
    std::vector<StageEvent> events;
    std::vector<Vec3> top_m, bottom_m;  // of a valid trial, from the start cap to the end cap
    std::size_t ticks = 0;
};
inline constexpr double kSimulatedRate_Hz = 1000.0;
[[nodiscard]] SimulatedStage simulate_stage(const Protocol& protocol, const Stage& stage, const Learner& learner,
                                            const LearnerPopulation& population, Random& random);
// After the stage: training counts, whatever the kind.
[[nodiscard]] Learner after_stage(Learner learner, const Stage& stage);

// Where a point that is kept within a tube would be: itself, or its nearest place on the wall.
[[nodiscard]] Vec3 within_tube(const StudyWorld& world, const Vec3& point_m);

}  // namespace burin::study

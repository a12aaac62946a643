// SPDX-License-Identifier: MIT
// Simulated people, to try a protocol and its analysis before anybody sits down. They know no published result: the
// groups differ by `effect` alone, which is 0 by default, so that an analysis can be checked to find what was put in.
//
// A learner's hand means to go along the tube's axis with the speed profile of least jerk, and wanders off it by a few
// slow waves. Where it really goes is a matter of the grip and of the forces on it (activities/train/). It goes forth
// and back through the tube in training, once through it in a trial, and straight back to the start after a failed
// attempt; a hand that is led gives way. What is felt changes nothing of what is learned. Metres and seconds; pure; any
// thread.
#pragma once

#include <memory>

#include "base/space.hpp"
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

// Where the hand means to be.
struct HandWish {
    Vec3 middle_m{0.0};
    Quat orientation{1.0, 0.0, 0.0, 0.0};
    bool gives_way = false;  // it holds nothing: the device leads it
    OperatorAct act = OperatorAct::none;
};

class LearnerHand {
public:
    // Protocol, stage and world must outlive it. `is_led`: by the device. `random` is drawn from as the stage goes on.
    LearnerHand(const Protocol& protocol, const Stage& stage, const StudyWorld& world, const Learner& learner,
                const LearnerPopulation& population, bool is_led, Random& random);
    ~LearnerHand();
    LearnerHand(const LearnerHand&) = delete;
    LearnerHand& operator=(const LearnerHand&) = delete;

    // At a time since the stage's beginning, which does not go back, after the state that the last tick has left.
    [[nodiscard]] HandWish next(const StageState& state, double time_s);

private:
    enum class Doing { rests, goes, returns };
    class Path;
    void begin(Doing doing, double time_s);
    void draw_path();
    [[nodiscard]] Vec3 place(double time_s) const;
    [[nodiscard]] bool lasts(double time_s) const;

    const Protocol& protocol_;
    const Stage& stage_;
    const StudyWorld& world_;
    Random& random_;
    double wander_m_ = 0.0, pace_m_per_s_ = 0.1, stray_chance_ = 0.0;
    bool is_led_ = false, strays_ = false, backwards_ = false;
    std::unique_ptr<Path> path_;
    Doing doing_ = Doing::rests;
    double since_s_ = 0.0;
    Vec3 from_m_{0.0}, now_m_{0.0};
    unsigned attempt_ = 1;
    double lean_phase_ = 0.0;
};
inline constexpr double kOperatorWaits_s = 1.0;  // before a simulated operator ends what nothing else ends

// After the stage: training counts, whatever the kind.
[[nodiscard]] Learner after_stage(Learner learner, const Stage& stage);

// Where a point that is kept within a tube would be: itself, or its nearest place on the wall.
[[nodiscard]] Vec3 within_tube(const StudyWorld& world, const Vec3& point_m);

}  // namespace burin::study

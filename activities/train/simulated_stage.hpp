// SPDX-License-Identifier: MIT
// A stage that a simulated learner goes through with a simulated wand in simulated time: each tick moves the wand by a
// period, reads it, runs the haptic tick on the study's world, writes the force back and asks the learner where its
// hand goes next.
//
// A trial in which nothing happens for two minutes is stopped: who cannot touch a cap would wait without an end.
// Pages have no world and no wand: only their time passes. Every run of the same inputs gives the same bits, on any
// number of threads. Pure but for `random` and `on_tick`.
#pragma once

#include <functional>

#include "activities/train/ended_stage.hpp"
#include "study/people/learner.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::activities {

// All must outlive the call; the world is null for a page.
struct StageInputs {
    const study::Protocol& protocol;
    const study::Stage& stage;
    const study::Group& group;
    const study::FeltWorld* world = nullptr;
    const study::Learner& learner;
    const study::LearnerPopulation& population;
};

// Called after each tick with a world, in order; `act` is what the operator did in it.
using OnStageTick =
    std::function<void(const haptics::TickRecord&, study::OperatorAct act, const study::StageSession& session)>;

[[nodiscard]] EndedStage simulate_stage(const StageInputs& in, study::Random& random, const OnStageTick& on_tick);

}  // namespace burin::activities

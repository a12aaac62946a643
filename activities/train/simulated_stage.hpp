// SPDX-License-Identifier: MIT
// A stage that a simulated learner goes through: a session that nobody sees, in simulated time, with the activity of a
// live visit. The learner is the hand of its simulated wand. It looks at each frame, as a person does, and says where
// its hand goes until the next, millisecond by millisecond; what the operator says comes with a frame as well.
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

// All must outlive the call.
struct StageInputs {
    const study::Protocol& protocol;
    study::StagePlace at;
    const study::Group& group;
    const FeltWorlds& worlds;
    const study::Learner& learner;
    const study::LearnerPopulation& population;
};

// Called with each tick of a stage with a world, in order; `act` is what the operator did in it.
using OnStageTick =
    std::function<void(const haptics::TickRecord&, study::OperatorAct act, const study::StageSession& session)>;

// Fails where the session does not open, or the stage does not end.
[[nodiscard]] Result<EndedStage> simulate_stage(const StageInputs& in, study::Random& random,
                                                const OnStageTick& on_tick);

}  // namespace burin::activities

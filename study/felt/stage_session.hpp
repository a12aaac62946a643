// SPDX-License-Identifier: MIT
// A stage with a wand in hand: the ticks that a session has run go through the stage's step, and what the attempt that
// counts was made of is kept. Live, simulated and replayed stages are this one class, so that a recorded motion gives
// the same events to the bit.
//
// Data flow: tick record, operator -> where the wand is in the world -> step() (caps, clock, failures).
// Frame: the world's. One thread; allocates as the attempt grows.
#pragma once

#include <span>
#include <vector>

#include "study/felt/felt_forces.hpp"
#include "study/felt/stage_touch.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {

class StageSession {
public:
    // All must outlive it.
    StageSession(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world);

    // Takes a tick. Forces, contact and faults are the record's own. Where the wand is in the world is the record's
    // too: by its sample, where it has the stage's own mapping, else by its points and its mapping. A tick that was not
    // computed, as its sample was no number, leaves the wand where it was.
    void follow(const haptics::TickRecord& record, OperatorAct act = OperatorAct::none);
    // Takes one whose sample is as touch().device() reads it, whatever the tick made of that.
    void follow(const haptics::TickRecord& record, const devices::DeviceSample& sample, OperatorAct act);

    [[nodiscard]] const StageState& state() const { return state_; }
    [[nodiscard]] bool done() const { return state_.phase == StagePhase::done; }
    [[nodiscard]] const std::vector<StageEvent>& events() const { return events_; }
    // Of a trial that ended with a valid exit; else empty once the stage is done.
    [[nodiscard]] std::span<const AttemptTick> attempt() const { return attempt_; }
    [[nodiscard]] const FeltForces& forces() const { return forces_; }
    [[nodiscard]] const StageTouch& touch() const { return touch_; }
    // Where the wand was in the last tick, in the frame of touch().device().
    [[nodiscard]] const devices::DeviceSample& sample() const { return sample_; }
    [[nodiscard]] Nanoseconds begun_ns() const { return begun_ns_; }
    [[nodiscard]] std::uint64_t ticks() const { return forces_.ticks; }
    // Since the stage's first tick.
    [[nodiscard]] double time_s() const { return time_s_; }

private:
    void step_on(const haptics::TickRecord& record, const devices::DeviceSample& sample, OperatorAct act);
    [[nodiscard]] devices::DeviceSample sample_of(const haptics::TickRecord& record) const;

    StageTouch touch_;
    StageSetup setup_;
    StageState state_;
    std::vector<StageEvent> events_;
    std::vector<AttemptTick> attempt_;
    FeltForces forces_;
    Nanoseconds begun_ns_ = 0;
    double time_s_ = 0.0;
    bool was_running_ = false;
    devices::DeviceSample sample_;
};

}  // namespace burin::study

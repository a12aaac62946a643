// SPDX-License-Identifier: MIT
// A stage with a wand in hand: each sample goes through the tick and then through the stage's step, and what the
// attempt that counts was made of is kept. Live, simulated and replayed stages are this one class, so that a recorded
// motion gives the same ticks and the same events to the bit.
//
// Data flow: sample, time, operator -> StageTouch (forces, proxies) -> step() (caps, clock, failures). Where the start
// cap is touched both proxies are set on the axis there before the next tick (W17).
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

    // Runs the tick. Returns its record, which stays until the next.
    const haptics::TickRecord& take(const devices::DeviceSample& sample, Nanoseconds now_ns,
                                    OperatorAct act = OperatorAct::none);
    // Takes a tick that a loop of its own has run. Forces, contact and faults are the record's own. Where the wand is
    // in the world is the record's too, by its points and its mapping: of one with the stage's own mapping the stage,
    // its events and its attempt are to the bit as if take() had been given the sample. A tick that was not computed,
    // as its sample was no number, leaves the wand where it was.
    void follow(const haptics::TickRecord& record, OperatorAct act = OperatorAct::none);

    [[nodiscard]] const StageState& state() const { return state_; }
    [[nodiscard]] bool done() const { return state_.phase == StagePhase::done; }
    [[nodiscard]] const std::vector<StageEvent>& events() const { return events_; }
    // Of a trial that ended with a valid exit; else empty once the stage is done.
    [[nodiscard]] std::span<const AttemptTick> attempt() const { return attempt_; }
    [[nodiscard]] const FeltForces& forces() const { return forces_; }
    [[nodiscard]] const StageTouch& touch() const { return touch_; }
    // Where the wand was in the last tick, in the frame of touch().device().
    [[nodiscard]] const devices::DeviceSample& sample() const { return sample_; }
    // Whether the last tick was another loop's, whose triangles are not this world's.
    [[nodiscard]] bool follows() const { return follows_; }
    [[nodiscard]] Nanoseconds begun_ns() const { return begun_ns_; }
    [[nodiscard]] std::uint64_t ticks() const { return forces_.ticks; }
    // Since the stage's first tick.
    [[nodiscard]] double time_s() const { return time_s_; }

private:
    bool step_on(const haptics::TickRecord& record, const devices::DeviceSample& sample, Nanoseconds now_ns,
                 OperatorAct act);
    [[nodiscard]] devices::DeviceSample sample_of(const haptics::TickRecord& record) const;

    StageTouch touch_;
    StageSetup setup_;
    StageState state_;
    std::vector<StageEvent> events_;
    std::vector<AttemptTick> attempt_;
    FeltForces forces_;
    Nanoseconds begun_ns_ = 0;
    double time_s_ = 0.0;
    bool was_running_ = false, follows_ = false;
    devices::DeviceSample sample_;
};

// What the haptic model makes of an attempt's motion (W18): a tick a millisecond, whatever the device's rate, since
// what a wall gives depends on the period of its ticks; with the tube and the funnels pressing on the wand, and both
// proxies on the axis at the start cap before the first. The motion goes straight between the times at which the device
// was read, or those of its ticks where it does not say. Forces are each point's own, before the force limit; the frame
// of all is the world's.
struct ModelTouch {
    std::vector<Nanoseconds> times_ns;
    std::array<std::vector<Vec3>, 2> points_m, collision_points_m, forces_N;  // top, bottom
};
[[nodiscard]] ModelTouch touch_by_model(const Protocol& protocol, const Stage& stage, const FeltWorld& world,
                                        std::span<const AttemptTick> attempt);

}  // namespace burin::study

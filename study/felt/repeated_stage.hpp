// SPDX-License-Identifier: MIT
// A stage's recorded samples in the place of a hand: each goes through the haptic tick once more, on the surface of the
// study's world and with the stage's settings. Recordings of before December 2026 are compared so, whose ticks were run
// on that surface alone, and so is made what the haptic model gives of any recorded motion.
//
// Data flow: sample, time -> StageTouch (settings) -> haptics::SampleRepeater -> record; with an operator's act ->
// StageSession. Where the start cap is touched both proxies are set on the axis there before the next tick (W17).
// Frame: the world's. One thread; allocates as an attempt grows.
#pragma once

#include "haptics/sample_repeater.hpp"
#include "study/felt/stage_session.hpp"

namespace burin::study {

// Ticks alone.
class RepeatedTouch {
public:
    // All must outlive it. Both proxies are on the axis at the start cap before the first tick.
    RepeatedTouch(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world,
                  TouchPurpose purpose = TouchPurpose::stage);

    // Computes the next tick. The record stays until the next call.
    const haptics::TickRecord& tick(const devices::DeviceSample& sample, Nanoseconds now_ns);
    // Sets both proxies on the axis at the start cap, from where the next tick takes them to the hand.
    void begin_at_start();
    [[nodiscard]] const StageTouch& touch() const { return touch_; }

private:
    const FeltWorld& world_;
    StageTouch touch_;
    haptics::SampleRepeater ticks_;
};

// Ticks and what becomes of the stage.
class RepeatedStage {
public:
    // All must outlive it.
    RepeatedStage(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world)
        : touch_(protocol, stage, group, world), session_(protocol, stage, group, world) {}

    // Computes the next tick and takes it. The record stays until the next call.
    const haptics::TickRecord& take(const devices::DeviceSample& sample, Nanoseconds now_ns,
                                    OperatorAct act = OperatorAct::none);
    // The stage, which may be told other ticks as well.
    [[nodiscard]] StageSession& session() { return session_; }
    [[nodiscard]] const StageSession& session() const { return session_; }

private:
    RepeatedTouch touch_;
    StageSession session_;
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

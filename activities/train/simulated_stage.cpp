// SPDX-License-Identifier: MIT
#include "activities/train/simulated_stage.hpp"

#include <algorithm>

#include "activities/train/held_wand.hpp"
#include "study/people/recorded_trial.hpp"

namespace burin::activities {
namespace {

using study::OperatorAct;

constexpr Nanoseconds kPeriod_ns = 1'000'000;
constexpr double kLongestStage_s = 4.0 * 3600.0;  // then the operator stops it

// Only the time of a page passes: a tick a second, and one at its end.
SimulatedStage page(const StageInputs& in) {
    const study::StageSetup setup = study::setup_of(in.protocol, in.stage);
    SimulatedStage made;
    double time_s = 0.0;
    while (made.end.phase != study::StagePhase::done) {
        const bool ends = !in.stage.ends_after_s && time_s >= study::kOperatorWaits_s;
        const study::StageStep stepped =
            study::step(setup, made.end, {time_s, {}, ends ? OperatorAct::next : OperatorAct::none, false});
        for (std::size_t i = 0; i < stepped.event_count; ++i) made.events.push_back(stepped.events[i]);
        made.end = stepped.state;
        made.duration_s = time_s;
        time_s = in.stage.ends_after_s && time_s < *in.stage.ends_after_s
                     ? std::min(time_s + 1.0, *in.stage.ends_after_s)
                     : time_s + 1.0;
    }
    return made;
}

devices::HandTarget target_of(const study::StageTouch& touch, const study::HandWish& wish, const Vec3& velocity) {
    devices::HandTarget target;
    target.position_device_m = touch.place_at_device(wish.middle_m);
    target.velocity_device_m_per_s = velocity;
    target.orientation_device = wish.orientation;
    return target;
}

}  // namespace

SimulatedStage simulate_stage(const StageInputs& in, study::Random& random, const OnStageTick& on_tick) {
    if (in.world == nullptr) return page(in);
    study::StageSession session(in.protocol, in.stage, in.group, *in.world);
    study::LearnerHand hand(in.protocol, in.stage, in.world->world(), in.learner, in.population,
                            session.touch().leads(), random);
    study::HandWish wish = hand.next(session.state(), 0.0);
    HeldWand wand(session.touch().device(), target_of(session.touch(), wish, Vec3(0.0)));
    while (!session.done()) {
        const devices::DeviceSample sample = wand.read();
        const OperatorAct act = session.time_s() > kLongestStage_s ? OperatorAct::stop : wish.act;
        const haptics::TickRecord& record = session.take(sample, sample.time_ns, act);
        wand.write(record.gate.given);
        if (on_tick) on_tick(record, act);
        // From where the hand meant to be to where it means to be, over the next period.
        const Vec3 from_m = wish.middle_m;
        wish = hand.next(session.state(), session.time_s() + seconds(kPeriod_ns));
        study::HandWish begins = wish;
        begins.middle_m = from_m;
        wand.hold(target_of(session.touch(), begins, (wish.middle_m - from_m) / seconds(kPeriod_ns)), wish.gives_way);
        wand.advance(kPeriod_ns);
    }
    SimulatedStage made{session.state(), session.events(), {}, session.ticks(), session.time_s()};
    if (in.stage.kind == study::StageKind::trial) {
        made.record = study::trial_record(in.world->world(), session.state(), session.events(),
                                          study::touch_by_model(in.protocol, in.stage, *in.world, session.attempt()));
    } else {
        made.record = study::forces_record(session.forces());
    }
    return made;
}

}  // namespace burin::activities

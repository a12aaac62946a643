// SPDX-License-Identifier: MIT
#include "activities/train/simulated_stage.hpp"

#include <algorithm>

#include "devices/haptic/simulated_wand.hpp"
#include "study/felt/stage_session.hpp"

namespace burin::activities {
namespace {

using study::OperatorAct;

constexpr Nanoseconds kPeriod_ns = 1'000'000;
// Without anything new in a trial for so long, the operator stops it: nobody who can do it needs as long.
constexpr double kLongestAttempt_s = 120.0;
constexpr double kLimpDamping = 0.5;  // of the grip's, in a hand that gives way

// Only the time of a page passes: a tick a second, and one at its end.
EndedStage page(const StageInputs& in) {
    const study::StageSetup setup = study::setup_of(in.protocol, in.stage);
    EndedStage made;
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

devices::HandGrip limp_grip() {
    devices::HandGrip grip;
    grip.stiffness_N_per_m = grip.torsion_Nm_per_rad = 0.0;
    grip.damping_Ns_per_m *= kLimpDamping;
    grip.angular_damping_Nms_per_rad *= kLimpDamping;
    return grip;
}

// Returns whether a trial stands still: nothing has happened for longer than an attempt takes.
bool waits_too_long(const study::Stage& stage, const study::StageSession& session) {
    if (stage.kind != study::StageKind::trial) return false;
    const double last_s = session.events().empty() ? 0.0 : session.events().back().time_s;
    return session.time_s() - last_s > kLongestAttempt_s;
}

// From a place in the world to where the hand means to be a period later.
devices::HandDirection direction_of(const study::StageTouch& touch, const Vec3& from_m, const study::HandWish& wish,
                                    double since_s) {
    devices::HandDirection direction;
    direction.since_s = since_s;
    const Vec3 from_device_m = touch.place_at_device(from_m);
    direction.target.position_device_m = from_device_m;
    direction.target.orientation_device = wish.orientation;
    if (wish.gives_way)
        direction.grip = limp_grip();
    else
        direction.target.velocity_device_m_per_s =
            (touch.place_at_device(wish.middle_m) - from_device_m) / seconds(kPeriod_ns);
    return direction;
}

}  // namespace

EndedStage simulate_stage(const StageInputs& in, study::Random& random, const OnStageTick& on_tick) {
    if (in.world == nullptr) return page(in);
    study::StageSession session(in.protocol, in.stage, in.group, *in.world);
    study::LearnerHand hand(in.protocol, in.stage, in.world->world(), in.learner, in.population,
                            session.touch().leads(), random);
    study::HandWish wish = hand.next(session.state(), 0.0);
    devices::HandDirection direction = direction_of(session.touch(), wish.middle_m, wish, 0.0);
    SimulatedClock clock;
    clock.sleep_until(kNanosecondsPerSecond);  // a loop's clock is never 0
    devices::SimulatedWand wand(devices::DirectedHand(direction), session.touch().wand(), &clock);
    while (!session.done()) {
        const devices::DeviceSample sample = wand.read();
        const OperatorAct act = waits_too_long(in.stage, session) ? OperatorAct::stop : wish.act;
        const haptics::TickRecord& record = session.take(sample, clock.now_ns(), act);
        wand.write(record.gate.given);
        if (on_tick) on_tick(record, act, session);
        // The operator sees to it at once; the attempt is lost.
        if (wand.tripped()) static_cast<void>(wand.switch_amplifiers(true));
        const Vec3 from_m = wish.middle_m;
        wish = hand.next(session.state(), session.time_s() + seconds(kPeriod_ns));
        direction = direction_of(session.touch(), from_m, wish, seconds(wand.time_ns()));
        clock.sleep_until(clock.now_ns() + kPeriod_ns);
    }
    return ended_stage(in.protocol, in.stage, *in.world, session);
}

}  // namespace burin::activities

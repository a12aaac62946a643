// SPDX-License-Identifier: MIT
#include "activities/train/simulated_stage.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "activities/train/participant_session.hpp"
#include "base/try.hpp"
#include "session/drive/headless_session.hpp"
#include "session/live/session.hpp"
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
    const study::Stage& stage = *in.at.stage;
    const study::StageSetup setup = study::setup_of(in.protocol, stage);
    EndedStage made;
    double time_s = 0.0;
    while (made.end.phase != study::StagePhase::done) {
        const bool ends = !stage.ends_after_s && time_s >= study::kOperatorWaits_s;
        const study::StageStep stepped =
            study::step(setup, made.end, {time_s, {}, ends ? OperatorAct::next : OperatorAct::none, false});
        for (std::size_t i = 0; i < stepped.event_count; ++i) made.events.push_back(stepped.events[i]);
        made.end = stepped.state;
        made.duration_s = time_s;
        time_s = stage.ends_after_s && time_s < *stage.ends_after_s ? std::min(time_s + 1.0, *stage.ends_after_s)
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

// A learner with what its hand means to do.
struct LearnersWand {
    LearnersWand(const StageInputs& in, const study::FeltWorld& world, study::Random& random)
        : touch(in.protocol, *in.at.stage, in.group, world),
          hand(in.protocol, *in.at.stage, world.world(), in.learner, in.population, touch.leads(), random),
          wish(hand.next({}, 0.0)) {
        plan->push_back(direction_of(touch, wish.middle_m, wish, 0.0));
    }

    const study::StageTouch touch;  // for where the wand stands in the world
    study::LearnerHand hand;
    study::HandWish wish;  // the last
    std::shared_ptr<devices::HandPlan> plan = std::make_shared<devices::HandPlan>();
};

// The learner and the operator at the frames of a session.
class LearnerFrames {
public:
    // All must outlive it.
    LearnerFrames(const study::Stage& stage, const StudyActivity& activity, LearnersWand& learner)
        : stage_(stage), activity_(activity), learner_(learner) {}

    // The learner goes on by the state that it has seen in the last frame, from when the stage has begun.
    [[nodiscard]] bool plan(Nanoseconds time_ns) {
        const Nanoseconds until = time_ns / kPeriod_ns;
        if (!is_under_way() || until == planned_) {
            if (!is_under_way()) begun_ = planned_ = until;
            return true;
        }
        study::HandWish& wish = learner_.wish;
        learner_.plan->clear();
        for (; planned_ < until; ++planned_) {
            const Vec3 from_m = wish.middle_m;
            wish =
                learner_.hand.next(activity_.run().session()->state(), seconds((planned_ + 1 - begun_) * kPeriod_ns));
            if (wish.act != OperatorAct::none) act_ = wish.act;
            learner_.plan->push_back(direction_of(learner_.touch, from_m, wish, seconds(planned_ * kPeriod_ns)));
        }
        return true;
    }

    [[nodiscard]] Result<void> make(const session::HeadlessFrame& frame) {
        std::vector<session::InputEvent> inputs;
        const auto say = [&](const char* command, const char* word) {
            inputs.push_back({frame.time_ns, session::CommandInput{command, {word}}});
        };
        if (frames_++ == kFirstFrames) say("do", "start");
        if (is_under_way()) {
            if (waits_too_long()) act_ = OperatorAct::stop;
            const OperatorAct act = std::exchange(act_, OperatorAct::none);
            if (act == OperatorAct::next) say("do", "next");
            if (act == OperatorAct::stop) say("do", "stop");
        }
        // The operator sees to it at once; the attempt is lost.
        if (frame.tools.front().cause == haptics::GateCause::device_fault) say("amplifiers", "on");
        return frame.step(inputs);
    }

private:
    [[nodiscard]] bool is_under_way() const {
        return activity_.run().phase() == TrainingRun::Phase::in_stage && activity_.run().session()->ticks() > 0;
    }

    // Returns whether a trial stands still: nothing has happened for longer than an attempt takes.
    [[nodiscard]] bool waits_too_long() const {
        if (stage_.kind != study::StageKind::trial) return false;
        const study::StageSession& session = *activity_.run().session();
        const double last_s = session.events().empty() ? 0.0 : session.events().back().time_s;
        return session.time_s() - last_s > kLongestAttempt_s;
    }

    const study::Stage& stage_;
    const StudyActivity& activity_;
    LearnersWand& learner_;
    OperatorAct act_ = OperatorAct::none;
    int frames_ = 0;
    Nanoseconds planned_ = 0, begun_ = 0;  // periods of the wand's time
};

}  // namespace

Result<EndedStage> simulate_stage(const StageInputs& in, study::Random& random, const OnStageTick& on_tick) {
    const auto world = in.worlds.find(in.at.stage->world);
    if (world == in.worlds.end()) return page(in);
    std::optional<EndedStage> ended;
    StageKeeper keeper;
    keeper.tick = [&](const TrainingRun::Ticked& ticked) {
        if (on_tick) on_tick(*ticked.record, ticked.act, *ticked.session);
    };
    keeper.ended = [&](const EndedStage& stage) {
        ended = stage;
        return Result<void>{};
    };
    const devices::WandDescription wand = study::study_wand(in.protocol);
    LearnersWand learner(in, *world->second, random);
    BURIN_TRY(device, led_wand(wand, devices::PlannedHand(learner.plan), {}));
    const auto activity =
        std::make_shared<StudyActivity>(in.protocol, in.group, in.worlds, std::vector{in.at}, "study run --simulated",
                                        std::move(device), std::move(keeper));
    SimulatedClock clock;
    clock.sleep_until(kNanosecondsPerSecond);  // a loop's clock is never 0
    BURIN_TRY(session, session::Session::create(unseen_session(activity), clock));
    session->log().print_nothing();
    LearnerFrames frames(*in.at.stage, *activity, learner);
    session::HeadlessRun run{.frames_a_second = kFramesASecond};
    run.plan = [&](Nanoseconds time_ns) { return frames.plan(time_ns); };
    run.make_frame = [&](const session::HeadlessFrame& frame) { return frames.make(frame); };
    BURIN_TRY_DO(session::run_headless(*session, clock, run));
    if (ended) return std::move(*ended);
    return fail("stage " + in.at.stage->name, "has not ended with its session", "report it as a fault of the program");
}

}  // namespace burin::activities

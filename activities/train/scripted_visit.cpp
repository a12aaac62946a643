// SPDX-License-Identifier: MIT
#include "activities/train/scripted_visit.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "activities/train/participant_session.hpp"
#include "base/try.hpp"
#include "session/drive/headless_session.hpp"
#include "session/live/session.hpp"
#include "study/folder/interruption.hpp"

namespace burin::activities {
namespace {

// An operator's command as an act of the activity.
std::vector<std::string> words_of(const OperatorCommand& command) {
    switch (command.says) {
        case OperatorSays::start: return {"start"};
        case OperatorSays::next: return {"next"};
        case OperatorSays::pause: return {"pause"};
        case OperatorSays::go_on: return {"go-on"};
        case OperatorSays::stop: return {"stop"};
        case OperatorSays::repeat: return {"repeat"};
        case OperatorSays::note: return {"note", command.text};
    }
    return {};
}

// What becomes of the stages: their files, the figures, and what is told of them. The first failure ends the visit.
class ScriptedStages {
public:
    ScriptedStages(StageOnDisk& disk, const VisitOptions& options) : disk_(disk), options_(options) {}

    [[nodiscard]] StageKeeper keeper() {
        return {[this](const TrainingRun& run) { return note(disk_.begin(run)); },
                [this](const TrainingRun::Ticked& ticked) {
                    disk_.take(ticked);
                    ++figures_.ticks;
                },
                [this](const std::vector<RunEvent>& events) {
                    std::ranges::copy(events, std::back_inserter(events_));
                    return note(disk_.take(events));
                },
                [this](const EndedStage& ended) { return note(end_stage(ended)); },
                [this] { return note(disk_.close()); }};
    }
    // Is told which activity the stages are of, before the first.
    void follow(const StudyActivity& activity) { activity_ = &activity; }

    void begin_frame(Nanoseconds time_ns) { figures_.simulated_s = seconds(time_ns); }
    [[nodiscard]] Result<void> end_frame() {
        BURIN_TRY_DO(show());
        return failure_ ? Result<void>(std::unexpected(*failure_)) : Result<void>{};
    }
    void refuse(const VisitScript::Said& said, const std::string& why) {
        ++figures_.without_effect;
        tell(said.where + ": " + said.text + " had no effect: " + why);
    }
    [[nodiscard]] Result<VisitFigures> outcome() const {
        return failure_ ? Result<VisitFigures>(std::unexpected(*failure_)) : Result<VisitFigures>(figures_);
    }

private:
    Result<void> note(Result<void> done) {
        if (!done && !failure_) failure_ = done.error();
        return done;
    }
    Result<void> show() {
        if (!options_.on_frame) return {};
        TrainingShown shown = activity_->shown();
        shown.events = std::exchange(events_, {});
        return options_.on_frame(figures_.simulated_s, shown, activity_->run());
    }
    void tell(const std::string& line) const {
        if (options_.tell) options_.tell(figures_.simulated_s, line);
    }
    Result<void> end_stage(const EndedStage& ended) {
        BURIN_TRY_DO(show());
        ++figures_.stages;
        tell(outcome_text(*disk_.at().stage, ended.end));
        return disk_.end(ended);
    }

    StageOnDisk& disk_;
    const VisitOptions& options_;
    const StudyActivity* activity_ = nullptr;
    VisitFigures figures_;
    std::vector<RunEvent> events_;
    std::optional<Error> failure_;
};

// From the script's frame into the device's.
std::vector<devices::HandPose> at_device(std::vector<devices::HandPose> hand, const devices::WandDescription& wand) {
    const Similarity device_from_scene = inverse(devices::scene_from_device(wand));
    for (devices::HandPose& pose : hand) {
        pose.position_device_m = device_from_scene * pose.position_device_m;
        pose.orientation_device =
            device_from_scene.orientation * pose.orientation_device * glm::conjugate(device_from_scene.orientation);
    }
    return hand;
}

// The script at the frames of a session: its words, and what became of them.
class ScriptFrames {
public:
    // All must outlive it.
    ScriptFrames(const VisitScript& script, const StudyActivity& activity, ScriptedStages& stages)
        : script_(script),
          activity_(activity),
          stages_(stages),
          end_ns_(nanoseconds(script.end_s) + kAfterLastWord_ns) {}

    [[nodiscard]] bool plan(Nanoseconds time_ns) const { return time_ns <= end_ns_; }

    [[nodiscard]] Result<void> make(const session::HeadlessFrame& frame) {
        stages_.begin_frame(frame.time_ns);
        BURIN_TRY_DO(frame.step({}));
        if (frames_++ >= kFirstFrames) BURIN_TRY_DO(say(frame));
        return stages_.end_frame();
    }

    // Tells the words that the visit's end has left unsaid.
    void refuse_the_rest() {
        for (; said_ < script_.said.size(); ++said_)
            stages_.refuse(script_.said[said_], "the visit has ended before; leave it out");
    }

private:
    // What is said last acts with the next tick, of which a frame knows later.
    static constexpr Nanoseconds kAfterLastWord_ns = 3 * kNanosecondsPerSecond / kFramesASecond;

    [[nodiscard]] Result<void> say(const session::HeadlessFrame& frame) {
        const Nanoseconds time_ns = frame.time_ns;
        for (; said_ < script_.said.size() && nanoseconds(script_.said[said_].time_s) <= time_ns; ++said_) {
            const VisitScript::Said& said = script_.said[said_];
            if (const auto ok = activity_.run().check(said.command); !ok) {
                stages_.refuse(said, ok.error().what + "; " + ok.error().remedy);
                continue;
            }
            const std::array input{session::InputEvent{time_ns, session::CommandInput{"do", words_of(said.command)}}};
            BURIN_TRY_DO(frame.step(input));
        }
        return {};
    }

    const VisitScript& script_;
    const StudyActivity& activity_;
    ScriptedStages& stages_;
    Nanoseconds end_ns_;
    int frames_ = 0;
    std::size_t said_ = 0;
};

}  // namespace

Result<VisitFigures> run_scripted_visit(study::StudyFolder& study, const std::string& participant,
                                        const VisitScript& script, const VisitOptions& options) {
    BURIN_TRY(plan, plan_visit(study, participant, options.leave, study::now_utc_ns()));
    const std::size_t wanted = plan.places.size();
    const std::vector<study::Participant> people = study.participants();
    const study::Participant& person = *std::ranges::find(people, participant, &study::Participant::id);
    const auto group = std::ranges::find(study.protocol().groups, person.group, &study::Group::code);
    if (group == study.protocol().groups.end())
        return fail(participant, "is in a group that the protocol has not", "restore the journal from a copy");
    BURIN_TRY(worlds, felt_worlds(study.protocol()));
    const devices::WandDescription wand = study::study_wand(study.protocol());
    BURIN_TRY(hand, devices::SimulatedHand::create(at_device(script.hand, wand)));
    const study::HeldDevice held{study::kScriptedDevice, study::Hand::script};
    BURIN_TRY_DO(begin_visit(study, participant, held, plan));
    StageOnDisk disk(study, participant, *group,
                     options.records ? StageOnDisk::Motion::ticks : StageOnDisk::Motion::none, held,
                     options.provenance);
    ScriptedStages stages(disk, options);
    BURIN_TRY(device, led_wand(wand, std::move(hand), participant));
    const auto activity = std::make_shared<StudyActivity>(study.protocol(), *group, worlds, plan.places,
                                                          "study run --input", std::move(device), stages.keeper());
    stages.follow(*activity);
    SimulatedClock clock;
    clock.sleep_until(kNanosecondsPerSecond);  // a loop's clock is never 0
    BURIN_TRY(session, session::Session::create(unseen_session(activity), clock));
    session->log().print_nothing();
    ScriptFrames frames(script, *activity, stages);
    session::HeadlessRun run{.frames_a_second = kFramesASecond};
    run.plan = [&](Nanoseconds time_ns) { return frames.plan(time_ns); };
    run.make_frame = [&](const session::HeadlessFrame& frame) { return frames.make(frame); };
    BURIN_TRY_DO(session::run_headless(*session, clock, run));
    frames.refuse_the_rest();
    BURIN_TRY(figures, stages.outcome());
    figures.interrupted = activity->run().phase() == TrainingRun::Phase::in_stage;
    figures.left = wanted - figures.stages;
    return figures;
}

}  // namespace burin::activities

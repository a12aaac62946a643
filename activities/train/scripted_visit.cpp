// SPDX-License-Identifier: MIT
#include "activities/train/scripted_visit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "study/folder/interruption.hpp"

namespace burin::activities {
namespace {

constexpr Nanoseconds kVisitTick_ns = 1'000'000;
constexpr std::int64_t kFramesASecond = 60;

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

// Runs the visit in simulated time, tick by tick.
class ScriptedVisit {
public:
    ScriptedVisit(TrainingRun& run, StageOnDisk& disk, const VisitScript& script, const VisitOptions& options,
                  devices::SimulatedHand hand, const devices::WandDescription& wand)
        : run_(run), disk_(disk), script_(script), options_(options), wand_(std::move(hand), wand, &clock_) {}

    Result<VisitFigures> go() {
        constexpr double kSameTick = 1e-6;  // of rounding; the last line's time is reached
        const auto last = static_cast<std::int64_t>(std::ceil(script_.end_s * 1000.0 - kSameTick));
        for (std::int64_t tick = 0; tick <= last && run_.phase() != TrainingRun::Phase::finished; ++tick) {
            clock_.sleep_until(kNanosecondsPerSecond + tick * kVisitTick_ns);  // a loop's clock is never 0
            const bool is_frame =
                tick * kFramesASecond / 1000 != (tick - 1) * kFramesASecond / 1000 || tick == 0 || tick == last;
            if (is_frame) BURIN_TRY_DO(frame(seconds(tick * kVisitTick_ns)));
            const TrainingRun::Ticked ticked = run_.tick(wand_.read(), clock_.now_ns());
            wand_.write(ticked.record != nullptr ? ticked.record->gate.given : devices::DeviceWrench{});
            disk_.take(ticked);
            figures_.ticks += ticked.record != nullptr ? 1 : 0;
            if (run_.phase() == TrainingRun::Phase::ended) {
                BURIN_TRY_DO(end_stage(seconds(tick * kVisitTick_ns)));
                if (run_.stopped()) break;
            }
            figures_.simulated_s = seconds(tick * kVisitTick_ns);
        }
        for (; said_ < script_.said.size(); ++said_)
            refuse(figures_.simulated_s, script_.said[said_], "the visit has ended before; leave it out");
        figures_.interrupted = run_.phase() == TrainingRun::Phase::in_stage;
        BURIN_TRY_DO(disk_.take(run_.frame(clock_.now_ns()).events));
        BURIN_TRY_DO(disk_.close());
        return figures_;
    }

private:
    Result<void> frame(double time_s) {
        for (; said_ < script_.said.size() && script_.said[said_].time_s <= time_s; ++said_) {
            const VisitScript::Said& said = script_.said[said_];
            if (const auto ok = run_.check(said.command); !ok) {
                refuse(time_s, said, ok.error().what + "; " + ok.error().remedy);
                continue;
            }
            const auto before = run_.phase();
            run_.command(said.command, clock_.now_ns());
            if (before == TrainingRun::Phase::between && run_.phase() == TrainingRun::Phase::in_stage)
                BURIN_TRY_DO(disk_.begin(run_));
        }
        const TrainingShown shown = run_.frame(clock_.now_ns());
        BURIN_TRY_DO(disk_.take(shown.events));
        if (options_.on_frame) BURIN_TRY_DO(options_.on_frame(time_s, shown, run_));
        return {};
    }

    void refuse(double time_s, const VisitScript::Said& said, const std::string& why) {
        ++figures_.without_effect;
        tell(time_s, said.where + ": " + said.text + " had no effect: " + why);
    }

    void tell(double time_s, const std::string& line) const {
        if (options_.tell) options_.tell(time_s, line);
    }

    Result<void> end_stage(double time_s) {
        const TrainingShown shown = run_.frame(clock_.now_ns());
        BURIN_TRY_DO(disk_.take(shown.events));
        if (options_.on_frame) BURIN_TRY_DO(options_.on_frame(time_s, shown, run_));
        ++figures_.stages;
        const study::Stage& stage = *run_.place()->stage;
        const EndedStage ended = run_.take_end();
        tell(time_s, outcome_text(stage, ended.end));
        return disk_.end(ended);
    }

    TrainingRun& run_;
    StageOnDisk& disk_;
    const VisitScript& script_;
    const VisitOptions& options_;
    SimulatedClock clock_;
    devices::SimulatedWand wand_;
    VisitFigures figures_;
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
    TrainingRun run(study.protocol(), *group, worlds, plan.places);
    StageOnDisk disk(study, participant, *group,
                     options.records ? StageOnDisk::Motion::ticks : StageOnDisk::Motion::none, held,
                     options.provenance);
    auto figures = ScriptedVisit(run, disk, script, options, std::move(hand), wand).go();
    if (figures) figures->left = wanted - figures->stages;
    return figures;
}

}  // namespace burin::activities

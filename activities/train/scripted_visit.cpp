// SPDX-License-Identifier: MIT
#include "activities/train/scripted_visit.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "study/folder/interruption.hpp"
#include "study/folder/stage_recording.hpp"

namespace burin::activities {
namespace {

constexpr Nanoseconds kVisitTick_ns = 1'000'000, kVisitBlock_ns = kNanosecondsPerSecond;
constexpr std::int64_t kFramesASecond = 60;

// The files of the stage that is under way.
class StageOnDisk {
public:
    StageOnDisk(study::StudyFolder& study, const study::Participant& person, const study::Group& group, bool records)
        : study_(study), person_(person), group_(group), records_(records) {}

    Result<void> begin(const TrainingRun& run) {
        at_ = *run.place();
        const study::StageSession* session = run.session();
        const bool has_motion = session != nullptr && at_.stage->records && records_;
        auto files = study_.begin_stage(person_.id, at_, has_motion);
        if (!files) return std::unexpected(files.error());
        files_ = std::move(*files);
        recording_.reset();
        if (!has_motion) return {};
        auto facts =
            study::facts_of_stage(study_.facts().protocol_digest, group_, *at_.stage, *run.world(), session->touch());
        facts.emplace_back("participant", person_.id);
        facts.emplace_back("hand", "scripted");
        auto made = study::StageRecording::create(study_.path() / files_.recording, session->touch(), std::move(facts),
                                                  kVisitBlock_ns);
        if (!made) return std::unexpected(made.error());
        recording_ = std::move(*made);
        return {};
    }
    void take(const TrainingRun::Ticked& ticked) {
        if (recording_ && ticked.record != nullptr) recording_->take(*ticked.record, ticked.act);
    }
    Result<void> take(const std::vector<RunEvent>& events) {
        for (const RunEvent& event : events) {
            if (recording_) recording_->note(event.time_ns, event.name, event.value);
            if (event.name != "note") continue;
            if (const auto ok = study_.note_of(person_.id, event.value); !ok) return ok;
        }
        return {};
    }
    Result<void> end(const EndedStage& ended) {
        if (const auto ok = close(); !ok) return ok;
        return study_.end_stage(person_.id, at_, study::name_of(ended.end.result), ended.record, files_);
    }
    // What is recorded stays, of a stage without an end too.
    Result<void> close() {
        if (!recording_) return {};
        const auto closed = recording_->close();
        recording_.reset();
        return closed;
    }

private:
    study::StudyFolder& study_;
    const study::Participant& person_;
    const study::Group& group_;
    bool records_;
    study::StagePlace at_;
    study::StageFiles files_;
    std::unique_ptr<study::StageRecording> recording_;
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

// What happens in simulated time, tick by tick.
class ScriptedVisit {
public:
    ScriptedVisit(TrainingRun& run, StageOnDisk& disk, const VisitScript& script, const VisitOptions& options,
                  devices::SimulatedHand hand, const devices::WandDescription& wand)
        : run_(run), disk_(disk), script_(script), options_(options), wand_(std::move(hand), wand, &clock_) {}

    Result<VisitFigures> go() {
        const auto last = static_cast<std::int64_t>(script_.end_s * 1000.0);
        for (std::int64_t tick = 0; tick <= last && run_.phase() != TrainingRun::Phase::finished; ++tick) {
            clock_.sleep_until(kNanosecondsPerSecond + tick * kVisitTick_ns);  // a loop's clock is never 0
            const bool is_frame = tick * kFramesASecond / 1000 != (tick - 1) * kFramesASecond / 1000 || tick == 0;
            if (is_frame)
                if (const auto ok = frame(seconds(tick * kVisitTick_ns)); !ok) return std::unexpected(ok.error());
            const TrainingRun::Ticked ticked = run_.tick(wand_.read(), clock_.now_ns());
            wand_.write(ticked.record != nullptr ? ticked.record->gate.given : devices::DeviceWrench{});
            disk_.take(ticked);
            figures_.ticks += ticked.record != nullptr ? 1 : 0;
            if (run_.phase() == TrainingRun::Phase::ended) {
                if (const auto ok = end_stage(); !ok) return std::unexpected(ok.error());
                if (run_.stopped()) break;
            }
            figures_.simulated_s = seconds(tick * kVisitTick_ns);
        }
        figures_.interrupted = run_.phase() == TrainingRun::Phase::in_stage;
        if (const auto ok = disk_.take(run_.frame(clock_.now_ns()).events); !ok) return std::unexpected(ok.error());
        if (const auto ok = disk_.close(); !ok) return std::unexpected(ok.error());
        return figures_;
    }

private:
    Result<void> frame(double time_s) {
        for (; said_ < script_.said.size() && script_.said[said_].time_s <= time_s; ++said_) {
            const auto before = run_.phase();
            run_.command(script_.said[said_].command, clock_.now_ns());
            if (before == TrainingRun::Phase::between && run_.phase() == TrainingRun::Phase::in_stage)
                if (const auto ok = disk_.begin(run_); !ok) return ok;
        }
        const TrainingShown shown = run_.frame(clock_.now_ns());
        if (const auto ok = disk_.take(shown.events); !ok) return ok;
        if (options_.on_frame)
            if (const auto ok = options_.on_frame(time_s, shown, run_); !ok) return ok;
        return {};
    }

    Result<void> end_stage() {
        const TrainingShown shown = run_.frame(clock_.now_ns());
        if (const auto ok = disk_.take(shown.events); !ok) return ok;
        ++figures_.stages;
        return disk_.end(run_.take_end());
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

Result<std::vector<study::StagePlace>> places_left(const study::StudyFolder& study, const std::string& participant,
                                                   bool any_delay, std::int64_t now_utc_ns) {
    const std::vector<study::Participant> people = study.participants();
    const auto person = std::ranges::find(people, participant, &study::Participant::id);
    if (person == people.end())
        return fail(participant, "is not in this study", "enrol them first: burin study enrol STUDY " + participant);
    if (person->withdrawn) return fail(participant, "has withdrawn", "nobody goes on for them");
    if (person->simulated)
        return fail(participant, "is a simulated learner", "take it through with burin study run STUDY --simulated");
    std::vector<study::StagePlace> places;
    std::int64_t day_before_ns = 0;
    for (const study::StagePlace& at : study::places_of(study.protocol())) {
        if (!places.empty() && at.day != places.front().day) break;
        if (!person->has_ended(at.day, at.place)) {
            places.push_back(at);
            continue;
        }
        for (const study::StageVisit& v : person->visits)
            if (v.day == at.day && v.place == at.place && v.status == study::StageStatus::ended)
                day_before_ns = std::max(day_before_ns, study::utc_of(v.ended_utc));
    }
    if (places.empty()) return fail(participant, "has gone through all stages", "burin study analyse STUDY");
    const bool new_day = places.front().place == 1 && places.front().day > 1;
    const double hours = static_cast<double>(now_utc_ns - day_before_ns) * 1e-9 / 3600.0;
    const study::DayVerdict verdict = study::day_verdict(study.protocol(), places.front().day, hours);
    if (new_day && !any_delay && verdict != study::DayVerdict::in_time)
        return fail(participant,
                    formatted("comes %.1f h after the day before, too %s by the protocol", hours,
                              verdict == study::DayVerdict::too_early ? "early" : "late"),
                    "give --resume to begin the day all the same, or come at another time");
    return places;
}

Result<VisitFigures> run_scripted_visit(study::StudyFolder& study, const std::string& participant,
                                        const VisitScript& script, const VisitOptions& options) {
    auto places = places_left(study, participant, options.any_delay, study::now_utc_ns());
    if (!places) return std::unexpected(places.error());
    const std::size_t wanted = places->size();
    const std::vector<study::Participant> people = study.participants();
    const study::Participant& person = *std::ranges::find(people, participant, &study::Participant::id);
    const auto group = std::ranges::find(study.protocol().groups, person.group, &study::Group::code);
    if (group == study.protocol().groups.end())
        return fail(participant, "is in a group that the protocol has not", "restore the journal from a copy");
    const auto worlds = felt_worlds(study.protocol());
    if (!worlds) return std::unexpected(worlds.error());
    const devices::WandDescription wand = study::study_wand(study.protocol());
    auto hand = devices::SimulatedHand::create(at_device(script.hand, wand));
    if (!hand) return std::unexpected(hand.error());
    if (const auto ok = study.begin_visit(participant, study::StudyFolder::kScriptedDevice); !ok)
        return std::unexpected(ok.error());
    TrainingRun run(study.protocol(), *group, *worlds, std::move(*places));
    StageOnDisk disk(study, person, *group, options.records);
    auto figures = ScriptedVisit(run, disk, script, options, std::move(*hand), wand).go();
    if (figures) figures->left = wanted - figures->stages;
    return figures;
}

}  // namespace burin::activities

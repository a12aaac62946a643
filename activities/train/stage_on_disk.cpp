// SPDX-License-Identifier: MIT
#include "activities/train/stage_on_disk.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "study/folder/interruption.hpp"

namespace burin::activities {
namespace {

// How long a block of ticks and a transaction are: a quarter of the second that a kill may cost, as for learners.
constexpr Nanoseconds kVisitBlock_ns = kNanosecondsPerSecond / 4;

// The stages that are left of the first day that has not ended.
std::vector<study::StagePlace> places_left(const study::Protocol& protocol, const study::Participant& person) {
    std::vector<study::StagePlace> places;
    for (const study::StagePlace& at : study::places_of(protocol)) {
        if (!places.empty() && at.day != places.front().day) break;
        if (!person.has_ended(at.day, at.place)) places.push_back(at);
    }
    return places;
}

// Says how long after the day before a day begins that is too early or too late; nothing where it is in time or has
// begun already.
std::optional<std::string> off_the_calendar(const study::Protocol& protocol, const study::Participant& person,
                                            std::size_t day, std::int64_t now_utc_ns) {
    if (std::ranges::find(person.visits, day, &study::StageVisit::day) != person.visits.end()) return std::nullopt;
    std::int64_t day_before_ns = 0;
    for (const study::StageVisit& v : person.visits)
        if (v.day < day && v.status == study::StageStatus::ended)
            day_before_ns = std::max(day_before_ns, study::utc_of(v.ended_utc));
    const double hours = static_cast<double>(now_utc_ns - day_before_ns) * 1e-9 / 3600.0;
    const study::DayVerdict verdict = study::day_verdict(protocol, day, hours);
    if (verdict == study::DayVerdict::in_time) return std::nullopt;
    const study::Day& wanted = protocol.days[day - 1];
    return formatted("%.1f h after the day before, too %s by the protocol (%g to %g h)", hours,
                     verdict == study::DayVerdict::too_early ? "early" : "late", wanted.least_delay_h,
                     wanted.most_delay_h);
}

}  // namespace

Result<VisitPlan> plan_visit(const study::StudyFolder& study, const std::string& participant, const VisitLeave& leave,
                             std::int64_t now_utc_ns) {
    const std::vector<study::Participant> people = study.participants();
    const auto person = std::ranges::find(people, participant, &study::Participant::id);
    if (person == people.end())
        return fail(participant, "is not in this study", "enrol them first: burin study enrol STUDY " + participant);
    if (person->withdrawn) return fail(participant, "has withdrawn", "nobody goes on for them");
    if (person->simulated)
        return fail(participant, "is a simulated learner", "take it through with burin study run STUDY --simulated");
    VisitPlan plan;
    plan.places = places_left(study.protocol(), *person);
    if (plan.places.empty()) return fail(participant, "has gone through all stages", "burin study analyse STUDY");
    if (const auto late = study::late_resumption(study, *person, now_utc_ns)) {
        if (!leave.resumes_late) return std::unexpected(study::check_resumption(study, *person, now_utc_ns).error());
        plan.deviations.push_back(late->text(study.protocol()));
    }
    if (const auto off = off_the_calendar(study.protocol(), *person, plan.places.front().day, now_utc_ns)) {
        if (!leave.any_delay)
            return fail(participant, "comes " + *off,
                        "come at another time, or give --any-delay to begin the day all the same, which journal and "
                        "report name as a deviation from the protocol");
        plan.deviations.push_back(formatted("day %zu was begun ", plan.places.front().day) + *off);
    }
    return plan;
}

Result<void> begin_visit(study::StudyFolder& study, const std::string& participant, const study::HeldDevice& held,
                         const VisitPlan& plan) {
    BURIN_TRY_DO(study.begin_visit(participant, held));
    for (const std::string& text : plan.deviations) BURIN_TRY_DO(study.note_deviation(participant, text));
    return {};
}

Result<void> StageOnDisk::begin(const TrainingRun& run) {
    at_ = *run.place();
    const study::StageSession* session = run.session();
    const bool has_motion = session != nullptr && at_.stage->records && motion_ != Motion::none;
    BURIN_TRY(files, study_.begin_stage(participant_, at_, has_motion));
    files_ = std::move(files);
    recording_.reset();
    if (!has_motion) return {};
    auto facts =
        study::facts_of_stage(study_.facts().protocol_digest, group_, *at_.stage, *run.world(), session->touch());
    std::ranges::move(study::facts_of_hand(participant_, held_), std::back_inserter(facts));
    facts.insert(facts.end(), provenance_.begin(), provenance_.end());
    facts.emplace_back(study::kTicksFact, study::kTicksOfSession);
    BURIN_TRY(made, study::StageRecording::create(study_.path() / files_.recording, session->touch(), std::move(facts),
                                                  kVisitBlock_ns));
    recording_ = std::move(made);
    return {};
}

void StageOnDisk::take(const TrainingRun::Ticked& ticked) {
    if (recording_ && ticked.record != nullptr) recording_->take(*ticked.record, ticked.act, *ticked.session);
}

Result<void> StageOnDisk::take(const std::vector<RunEvent>& events) {
    for (const RunEvent& event : events) {
        if (recording_) recording_->note(event.time_ns, event.name, event.value);
        if (event.name != "note") continue;
        BURIN_TRY_DO(study_.note_of(participant_, event.value));
    }
    return {};
}

Result<void> StageOnDisk::end(const EndedStage& ended) {
    BURIN_TRY_DO(close());
    const auto deviation = deviation_of(at_, ended);
    if (deviation) BURIN_TRY_DO(study_.note_deviation(participant_, *deviation));
    return study_.end_stage(participant_, at_, study::name_of(ended.end.result), ended.record, files_,
                            failures_of(*at_.stage, ended));
}

Result<void> StageOnDisk::close() {
    if (!recording_) return {};
    const auto closed = recording_->close();
    recording_.reset();
    return closed;
}

}  // namespace burin::activities

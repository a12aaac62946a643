// SPDX-License-Identifier: MIT
#include "study/people/trial_rows.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/text.hpp"

namespace burin::study {
namespace {

// The visit that counts: the one that came to the stage's end, else the last that was begun; null: there was none.
const StageVisit* visit_at(const Participant& p, const StagePlace& at) {
    const StageVisit* found = nullptr;
    for (const StageVisit& v : p.visits) {
        if (v.day != at.day || v.place != at.place) continue;
        if (found == nullptr || found->status != StageStatus::ended) found = &v;
    }
    return found;
}

// "no attempt left: strayed 1, went back 2"
std::string with_failures(std::string why, const StageVisit& visit) {
    const char* between = ": ";
    for (const auto& [name, times] : visit.failures) {
        why += between + name + (name == kNeverTouched ? "" : formatted(" %zu", times));
        between = ", ";
    }
    return why;
}

// Why a trial has no measures; empty where it has.
std::string reason_of(const Stage& stage, const StageVisit& visit, bool is_damaged) {
    std::string why;
    if (visit.status != StageStatus::ended)
        why = "interrupted";
    else if (visit.result != name_of(StageResult::valid_exit))
        why = with_failures(visit.result, visit);
    else if (is_damaged || visit.file.empty())
        why = "its file is missing or damaged";
    if (stage.outcome) return why;
    return "baseline" + (why.empty() ? "" : ": " + why);
}

TrialRow row_of(const Participant& p, const StageVisit& visit, const NumberedTrial& trial) {
    TrialRow row{p.id, p.group, p.stratum, visit.stage, visit.day, trial.number, Json::object(), visit.held.hand};
    row.world = trial.at.stage->world;
    row.place = visit.place;
    row.run = visit.run;
    if (visit.status != StageStatus::ended) return row;
    const FailureCounts failed = failure_counts(visit);
    row.failed_attempts = failed.of_person;
    row.interrupted_attempts = failed.of_operator_or_device;
    return row;
}

// Whether the attempts are told by their reasons: an earlier Burin's journal counts none, and its trials both kinds
// together.
bool tells_attempts(const TrialRow& row, const StageVisit& visit) {
    if (visit.result == name_of(StageResult::no_attempt_left)) return *row.failed_attempts > 0;
    const auto failed = row.record.find(kFailedFigure);
    if (row.record.contains(kInterruptedFigure) || failed == row.record.end() || !failed->is_number_unsigned())
        return true;
    return failed->get<std::size_t>() == *row.failed_attempts + *row.interrupted_attempts;
}

}  // namespace

std::vector<NumberedTrial> numbered_trials(const Protocol& protocol) {
    std::vector<NumberedTrial> trials;
    for (const StagePlace& at : places_of(protocol))
        if (at.stage->kind == StageKind::trial) trials.push_back({trials.size() + 1, at});
    return trials;
}

std::size_t outcome_trials(const Protocol& protocol) {
    const auto trials = numbered_trials(protocol);
    return static_cast<std::size_t>(
        std::ranges::count_if(trials, [](const NumberedTrial& t) { return t.at.stage->outcome; }));
}

std::size_t TrialRows::valid() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(rows, [](const TrialRow& row) { return row.reason.empty(); }));
}

FailureCounts failure_counts(const StageVisit& visit) {
    FailureCounts counts;
    for (const auto& [name, times] : visit.failures) {
        const std::optional<Failure> failure = failure_named(name);
        if (failure)
            (is_of_person(*failure) ? counts.of_person : counts.of_operator_or_device) += times;
        else
            counts.never_begun = counts.never_begun || name == kNeverTouched;
    }
    return counts;
}

TrialRows trial_rows(const StudyFolder& study) {
    TrialRows made;
    const std::vector<NumberedTrial> trials = numbered_trials(study.protocol());
    for (const Participant& p : study.participants()) {
        if (p.withdrawn) continue;
        for (const NumberedTrial& trial : trials) {
            const StageVisit* visit = visit_at(p, trial.at);
            if (visit == nullptr) continue;
            TrialRow row = row_of(p, *visit, trial);
            bool is_damaged = false;
            if (!visit->file.empty()) {
                auto record = study.recorded(*visit);
                is_damaged = !record;
                if (record)
                    row.record = std::move(*record);
                else
                    made.damage.push_back(record.error().line());
            }
            if (row.failed_attempts && !tells_attempts(row, *visit))
                row.failed_attempts = row.interrupted_attempts = std::nullopt;
            row.reason = reason_of(*trial.at.stage, *visit, is_damaged);
            made.rows.push_back(std::move(row));
        }
    }
    return made;
}

std::vector<FlowOfGroup> flow_of_groups(const StudyFolder& study, const TrialRows& trials) {
    std::map<std::string, std::size_t> valid;
    for (const TrialRow& row : trials.rows) valid[row.participant] += row.reason.empty() ? 1 : 0;
    const std::vector<StagePlace> places = places_of(study.protocol());
    const std::size_t outcomes = outcome_trials(study.protocol());
    std::vector<FlowOfGroup> flows;
    for (const Group& group : study.protocol().groups) {
        FlowOfGroup flow{.group = group.code};
        for (const Participant& p : study.participants()) {
            if (p.group != group.code) continue;
            const bool finished =
                std::ranges::all_of(places, [&](const StagePlace& at) { return p.has_ended(at.day, at.place); });
            ++flow.allocated;
            ++(p.withdrawn              ? flow.withdrew
               : valid[p.id] == 0       ? (finished ? flow.without_valid_trial : flow.unfinished)
               : valid[p.id] < outcomes ? flow.with_some
                                        : flow.with_all);
        }
        flows.push_back(std::move(flow));
    }
    return flows;
}

}  // namespace burin::study

// SPDX-License-Identifier: MIT
#include "app/study_trials.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "app/output_files.hpp"
#include "base/text.hpp"
#include "study/people/recorded_trial.hpp"

namespace burin::app {
namespace {

using study::Participant;
using study::StageStatus;
using study::StageVisit;

bool is_outcome(const study::Protocol& protocol, const StageVisit& visit) {
    const study::Stage* stage = protocol.stage(visit.stage);
    return stage != nullptr && stage->outcome && visit.status == StageStatus::ended && !visit.file.empty();
}

bool is_chosen(const TrialChoice& choice, const study::TrialRow& row) {
    return (!choice.day || *choice.day == row.day) && (choice.stage.empty() || choice.stage == row.stage);
}

// Where the outcome trials are not all of one day and one world; else empty.
std::string pooled_fact(const study::Protocol& protocol) {
    std::set<std::size_t> days;
    std::set<std::string> worlds;
    for (const study::StagePlace& at : study::places_of(protocol)) {
        if (!at.stage->outcome) continue;
        days.insert(at.day);
        worlds.insert(at.stage->world);
    }
    if (days.size() < 2 && worlds.size() < 2) return {};
    return formatted(
        "The outcome trials are of %zu days and %zu worlds: a participant's value is the mean over all of them. "
        "burin study analyse STUDY --day N or --stage NAME takes some of them alone.",
        days.size(), worlds.size());
}

study::Hand hand_of(const Participant& p, const StageVisit& visit) {
    if (p.simulated) return study::Hand::learner;
    if (visit.device == study::StudyFolder::kScriptedDevice) return study::Hand::script;
    return visit.device.starts_with("simulated") ? study::Hand::simulated_device : study::Hand::device;
}

// A damaged file is left out and named; the others are used.
std::vector<study::TrialRow> rows_of(const study::StudyFolder& study) {
    std::vector<study::TrialRow> rows;
    for (const Participant& p : study.participants()) {
        if (p.withdrawn) continue;
        std::size_t number = 0;
        for (const StageVisit& visit : p.visits) {
            if (!is_outcome(study.protocol(), visit)) continue;
            ++number;
            auto record = study.recorded(visit);
            if (!record) {
                std::fprintf(stderr, "left out: %s\n", record.error().line().c_str());
                continue;
            }
            rows.push_back(
                {p.id, p.group, p.stratum, visit.stage, visit.day, number, std::move(*record), hand_of(p, visit)});
        }
    }
    return rows;
}

}  // namespace

std::vector<std::string> study_facts(const study::StudyFolder& study) {
    const std::vector<Participant> people = study.participants();
    const std::size_t stages = study::places_of(study.protocol()).size();
    std::size_t finished = 0, withdrawn = 0, simulated = 0, aborted = 0, invalid = 0, scripted = 0;
    for (const Participant& p : people) {
        std::size_t ended = 0;
        for (const StageVisit& v : p.visits) {
            ended += v.status == StageStatus::ended ? 1 : 0;
            aborted += v.status == StageStatus::aborted ? 1 : 0;
            const study::Stage* stage = study.protocol().stage(v.stage);
            const bool trial = stage != nullptr && stage->kind == study::StageKind::trial;
            invalid += trial && v.status == StageStatus::ended && v.file.empty() ? 1 : 0;
        }
        finished += !p.withdrawn && ended >= stages ? 1 : 0;
        withdrawn += p.withdrawn ? 1 : 0;
        simulated += p.simulated ? 1 : 0;
        scripted += p.device.starts_with("simulated") ? 1 : 0;
    }
    std::vector<std::string> facts;
    if (simulated > 0)
        facts.push_back(formatted(
            "%zu of %zu participants are simulated learners: no person took part, hand and wand are simulated; "
            "effect %g SD.",
            simulated, people.size(), study.simulated_effect().value_or(0.0)));
    if (scripted > 0)
        facts.push_back(formatted(
            "%zu of %zu participants went through with a simulated device, whose hand is a script or a mouse.",
            scripted, people.size()));
    facts.push_back("Protocol " + study.protocol().name + ", SHA-256 " + study.facts().protocol_digest + ", " +
                    (study.facts().seed_given ? "allocation by seed " + std::to_string(study.facts().seed)
                                              : "allocation drawn by the system's randomness") +
                    ", sealed.");
    facts.push_back(formatted("Participants: %zu enrolled, %zu went through all %zu stages, %zu withdrew.",
                              people.size(), finished, stages, withdrawn));
    for (const study::Group& g : study.protocol().groups) {
        const auto of_group = [&](const Participant& p) { return p.group == g.code; };
        const auto stayed = [&](const Participant& p) { return p.group == g.code && !p.withdrawn; };
        facts.push_back(formatted("Group %s: %zu allocated, %zu stayed.", g.code.c_str(),
                                  static_cast<std::size_t>(std::ranges::count_if(people, of_group)),
                                  static_cast<std::size_t>(std::ranges::count_if(people, stayed))));
    }
    facts.push_back(formatted("%zu stages were aborted and %zu trials ended without a valid exit.", aborted, invalid));
    if (const std::string pooled = pooled_fact(study.protocol()); !pooled.empty()) facts.push_back(pooled);
    if (!study.journal().faults.empty())
        facts.push_back(
            formatted("The journal is damaged in %zu lines, which are not used.", study.journal().faults.size()));
    return facts;
}

void warn_of_journal(const study::StudyFolder& study) {
    const std::string file = (study.path() / "journal.jsonl").string();
    for (const study::JournalFault& f : study.journal().faults)
        std::fprintf(stderr, "%s:%zu: %s; %s\n", file.c_str(), f.line, f.what.c_str(), f.remedy.c_str());
    for (const std::string& note : study.journal().notes) std::fprintf(stderr, "%s: %s\n", file.c_str(), note.c_str());
}

Result<TrialsMade> make_trials(const std::string& folder) {
    const auto study = study::StudyFolder::open(folder, study::StudyAccess::read);
    if (!study) return std::unexpected(study.error());
    warn_of_journal(*study);
    const std::vector<study::TrialRow> rows = rows_of(*study);
    if (rows.empty()) return fail(folder, "has no valid outcome trial yet", "run it first: burin study run");
    const std::string path = (study->path() / "trials.csv").string();
    if (const auto ok = write_text(path, study::trials_csv(rows)); !ok) return std::unexpected(ok.error());
    std::vector<std::string> groups;
    for (const study::Group& group : study->protocol().groups) groups.push_back(group.code);
    return TrialsMade{rows.size(), study_facts(*study), std::move(groups), study::simulated_fact(rows),
                      pooled_fact(study->protocol())};
}

Result<ChosenTrials> chosen_trials(const std::string& folder, const TrialChoice& choice) {
    const auto study = study::StudyFolder::open(folder, study::StudyAccess::read);
    if (!study) return std::unexpected(study.error());
    const study::Protocol& protocol = study->protocol();
    if (choice.day && (*choice.day == 0 || *choice.day > protocol.days.size()))
        return fail(formatted("--day %u", *choice.day), formatted("the protocol has %zu days", protocol.days.size()),
                    "count them from 1");
    const study::Stage* stage = protocol.stage(choice.stage);
    if (!choice.stage.empty() && (stage == nullptr || !stage->outcome))
        return fail("--stage " + choice.stage, "is no stage with outcome = true in the protocol",
                    "name one whose trials are analysed");
    std::vector<study::TrialRow> rows = rows_of(*study);
    std::erase_if(rows, [&](const study::TrialRow& row) { return !is_chosen(choice, row); });
    if (rows.empty()) return fail(folder, "has no valid trial of that day and stage", "leave --day or --stage out");
    return ChosenTrials{study::trials_csv(rows), study::simulated_fact(rows)};
}

}  // namespace burin::app

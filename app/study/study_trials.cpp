// SPDX-License-Identifier: MIT
#include "app/study/study_trials.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "app/cli/output_files.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/people/trial_rows.hpp"

namespace burin::app {
namespace {

using study::Participant;
using study::StageStatus;
using study::StageVisit;

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

// A damaged file is named; the others are used.
study::TrialRows rows_of(const study::StudyFolder& study) {
    study::TrialRows made = study::trial_rows(study);
    for (const std::string& line : made.damage) std::fprintf(stderr, "without measures: %s\n", line.c_str());
    return made;
}

const char* what_of(study::Hand hand) {
    switch (hand) {
        case study::Hand::learner: return "";
        case study::Hand::script: return "by a script, with a simulated device in simulated time: no person took part";
        case study::Hand::recording: return "as a recording that was played again: no person took part";
        case study::Hand::simulated_device:
            return "with a simulated device, led by mouse, keys or a log: no person felt it";
        case study::Hand::emulated_device:
            return "with a device's driver and an emulated device behind it: no person felt it";
        case study::Hand::untold:
            return "with what an earlier Burin calls a simulated wand, as it did every wand: whether a person felt it "
                   "is not told";
        case study::Hand::device: return "with a device that a person held and felt";
    }
    return "";
}

// Tells how many participants went through with a device, a script and so on, and names the devices. Whoever came with
// several counts with each.
std::vector<std::string> hand_facts(const std::vector<Participant>& people) {
    std::map<study::Hand, std::pair<std::size_t, std::set<std::string>>> held;
    for (const Participant& p : people) {
        std::map<study::Hand, std::set<std::string>> of_person;
        for (const StageVisit& v : p.visits) of_person[v.held.hand].insert(v.held.device);
        for (const auto& [hand, devices] : of_person) {
            ++held[hand].first;
            held[hand].second.insert(devices.begin(), devices.end());
        }
    }
    std::vector<std::string> facts;
    for (const auto& [hand, of] : held) {
        if (hand == study::Hand::learner) continue;
        const std::vector<std::string_view> names(of.second.begin(), of.second.end());
        facts.push_back(formatted("%zu of %zu participants went through %s (%s).", of.first, people.size(),
                                  what_of(hand), joined(names).c_str()));
    }
    return facts;
}

}  // namespace

std::vector<std::string> study_facts(const study::StudyFolder& study) {
    const std::vector<Participant> people = study.participants();
    const std::size_t stages = study::places_of(study.protocol()).size();
    std::size_t finished = 0, withdrawn = 0, simulated = 0, aborted = 0, invalid = 0;
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
    }
    std::vector<std::string> facts;
    if (simulated > 0)
        facts.push_back(formatted(
            "%zu of %zu participants are simulated learners: no person took part, hand and wand are simulated; "
            "effect %g SD.",
            simulated, people.size(), study.simulated_effect().value_or(0.0)));
    std::ranges::move(hand_facts(people), std::back_inserter(facts));
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
    BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::read));
    warn_of_journal(study);
    const study::TrialRows made = rows_of(study);
    if (made.rows.empty()) return fail(folder, "has no trial yet", "run it first: burin study run");
    const std::string path = (study.path() / "trials.csv").string();
    BURIN_TRY_DO(write_text(path, study::trials_csv(made.rows)));
    std::vector<std::string> groups;
    for (const study::Group& group : study.protocol().groups) groups.push_back(group.code);
    return TrialsMade{made.valid(),      made.rows.size() - made.valid(),  study_facts(study),
                      std::move(groups), study::simulated_fact(made.rows), pooled_fact(study.protocol())};
}

std::string TrialsMade::count_text() const {
    return formatted("%zu trials", trials) +
           (without > 0 ? formatted(", and %zu rows without measures (lost, or a baseline)", without) : "");
}

Result<ChosenTrials> chosen_trials(const std::string& folder, const TrialChoice& choice) {
    BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::read));
    const study::Protocol& protocol = study.protocol();
    if (choice.day && (*choice.day == 0 || *choice.day > protocol.days.size()))
        return fail(formatted("--day %u", *choice.day), formatted("the protocol has %zu days", protocol.days.size()),
                    "count them from 1");
    const study::Stage* stage = protocol.stage(choice.stage);
    if (!choice.stage.empty() && (stage == nullptr || !stage->outcome))
        return fail("--stage " + choice.stage, "is no stage with outcome = true in the protocol",
                    "name one whose trials are analysed");
    std::vector<study::TrialRow> rows = rows_of(study).rows;
    std::erase_if(rows, [&](const study::TrialRow& row) { return !is_chosen(choice, row); });
    if (std::ranges::none_of(rows, [](const study::TrialRow& row) { return row.reason.empty(); }))
        return fail(folder, "has no valid trial of that day and stage", "leave --day or --stage out");
    return ChosenTrials{study::trials_csv(rows), study::simulated_fact(rows)};
}

}  // namespace burin::app

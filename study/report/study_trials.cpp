// SPDX-License-Identifier: MIT
#include "study/report/study_trials.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/folder/study_access.hpp"
#include "study/people/trial_rows.hpp"

namespace burin::study {
namespace {

namespace fs = std::filesystem;

bool is_chosen(const TrialChoice& choice, const TrialRow& row) {
    return (!choice.day || *choice.day == row.day) && (choice.stage.empty() || choice.stage == row.stage);
}

// Writes the table of trials where it is not there as it is: a study that may only be read can still be analysed.
Result<void> renew(const StudyFolder& study, const std::string& table) {
    const fs::path file = study.path() / "trials.csv";
    const auto bytes = std::as_bytes(std::span(table));
    if (const auto there = read_file(file); there && std::ranges::equal(*there, bytes)) return {};
    for (const fs::path& place : {file, study.path()}) BURIN_TRY_DO(check_may_write_results(place));
    return write_file_atomically(file, bytes);
}

// Where the outcome trials are not all of one day and one world; else empty.
std::string pooled_fact(const Protocol& protocol) {
    std::set<std::size_t> days;
    std::set<std::string> worlds;
    for (const StagePlace& at : places_of(protocol)) {
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

TrialRows rows_of(const StudyFolder& study, const TellDamage& tell) {
    TrialRows rows = trial_rows(study);
    for (const std::string& line : rows.damage) tell(line);
    return rows;
}

Result<void> check_choice(const Protocol& protocol, const TrialChoice& choice) {
    if (choice.day && (*choice.day == 0 || *choice.day > protocol.days.size()))
        return fail(formatted("--day %u", *choice.day), formatted("the protocol has %zu days", protocol.days.size()),
                    "count them from 1");
    const Stage* stage = protocol.stage(choice.stage);
    if (!choice.stage.empty() && (stage == nullptr || !stage->outcome))
        return fail("--stage " + choice.stage, "is no stage with outcome = true in the protocol",
                    "name one whose trials are analysed");
    return {};
}

const char* what_of(Hand hand) {
    switch (hand) {
        case Hand::learner: return "";
        case Hand::script: return "by a script, with a simulated device in simulated time: no person took part";
        case Hand::recording: return "as a recording that was played again: no person took part";
        case Hand::simulated_device: return "with a simulated device, led by mouse, keys or a log: no person felt it";
        case Hand::emulated_device: return "with a device's driver and an emulated device behind it: no person felt it";
        case Hand::untold:
            return "with what an earlier Burin calls a simulated wand, as it did every wand: whether a person felt it "
                   "is not told";
        case Hand::device: return "with a device that a person held and felt";
    }
    return "";
}

// Tells how many participants went through with a device, a script and so on, and names the devices. Whoever came with
// several counts with each.
std::vector<std::string> hand_facts(const std::vector<Participant>& people) {
    std::map<Hand, std::pair<std::size_t, std::set<std::string>>> held;
    for (const Participant& p : people) {
        std::map<Hand, std::set<std::string>> of_person;
        for (const StageVisit& v : p.visits) of_person[v.held.hand].insert(v.held.device);
        for (const auto& [hand, devices] : of_person) {
            ++held[hand].first;
            held[hand].second.insert(devices.begin(), devices.end());
        }
    }
    std::vector<std::string> facts;
    for (const auto& [hand, of] : held) {
        if (hand == Hand::learner) continue;
        const std::vector<std::string_view> names(of.second.begin(), of.second.end());
        facts.push_back(formatted("%zu of %zu participants went through %s (%s).", of.first, people.size(),
                                  what_of(hand), joined(names).c_str()));
    }
    return facts;
}

}  // namespace

std::vector<std::string> study_facts(const StudyFolder& study) {
    const std::vector<Participant> people = study.participants();
    const std::size_t stages = places_of(study.protocol()).size();
    std::size_t finished = 0, withdrawn = 0, simulated = 0, aborted = 0, invalid = 0;
    for (const Participant& p : people) {
        std::size_t ended = 0;
        for (const StageVisit& v : p.visits) {
            ended += v.status == StageStatus::ended ? 1 : 0;
            aborted += v.status == StageStatus::aborted ? 1 : 0;
            const Stage* stage = study.protocol().stage(v.stage);
            const bool trial = stage != nullptr && stage->kind == StageKind::trial;
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
    for (const Group& g : study.protocol().groups) {
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

Result<TrialsMade> make_trials(const StudyFolder& study, const TellDamage& tell) {
    const TrialRows rows = rows_of(study, tell);
    if (rows.rows.empty()) return fail(study.path().string(), "has no trial yet", "run it first: burin study run");
    BURIN_TRY_DO(renew(study, trials_csv(rows.rows)));
    std::vector<std::string> groups;
    for (const Group& group : study.protocol().groups) groups.push_back(group.code);
    return TrialsMade{rows.valid(),      rows.rows.size() - rows.valid(), study_facts(study),
                      std::move(groups), simulated_fact(rows.rows),       pooled_fact(study.protocol())};
}

std::string TrialsMade::count_text() const {
    return formatted("%zu trials", trials) +
           (without > 0 ? formatted(", and %zu rows without measures (lost, or a baseline)", without) : "");
}

Result<ChosenTrials> chosen_trials(const StudyFolder& study, const TrialChoice& choice, const TellDamage& tell) {
    BURIN_TRY_DO(check_choice(study.protocol(), choice));
    TrialRows made = rows_of(study, tell);
    std::erase_if(made.rows, [&](const TrialRow& row) { return !is_chosen(choice, row); });
    if (std::ranges::none_of(made.rows, [](const TrialRow& row) { return row.reason.empty(); }))
        return fail(study.path().string(), "has no valid trial of that day and stage", "leave --day or --stage out");
    return ChosenTrials{trials_csv(made.rows), simulated_fact(made.rows)};
}

}  // namespace burin::study

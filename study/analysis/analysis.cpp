// SPDX-License-Identifier: MIT
#include "study/analysis/analysis.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "study/statistics/agreement.hpp"
#include "study/statistics/effect_size.hpp"
#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/permutation.hpp"
#include "study/statistics/spearman.hpp"

namespace burin::study {
namespace {

struct ParticipantTrials {
    std::string participant;
    std::string group;
    std::vector<Decimal> times, deviations;
};

// By participant, in the order of the table.
std::vector<ParticipantTrials> by_participant(const TrialTable& table) {
    std::vector<ParticipantTrials> participants;
    std::map<std::string, std::size_t> place;
    for (const Trial& trial : table.trials) {
        const auto [at, fresh] = place.emplace(trial.participant, participants.size());
        if (fresh)
            participants.push_back(
                {.participant = trial.participant, .group = trial.group, .times = {}, .deviations = {}});
        participants[at->second].times.push_back(trial.exact_time);
        participants[at->second].deviations.push_back(trial.exact_deviation);
    }
    return participants;
}

using Measure = std::vector<Int128> GroupSummary::*;

Comparison compare(const GroupSummary& a, const GroupSummary& b, Measure measure, const Step& step,
                   std::uint64_t seed) {
    const std::vector<Int128>&first = a.*measure, &second = b.*measure;
    return {.measure = {},
            .unit = {},
            .first = a.group,
            .second = b.group,
            .n_first = first.size(),
            .n_second = second.size(),
            .median_first = median_of(first, step),
            .median_second = median_of(second, step),
            .mann_whitney = mann_whitney(first, second),
            .mann_whitney_normal = mann_whitney_normal(first, second),
            .difference_of_means = permutation_of_means(first, second, step, seed),
            .rank_biserial = rank_biserial(first, second),
            .hodges_lehmann = hodges_lehmann(first, second, step)};
}

struct NamedMeasure {
    const char* name;
    Measure values;
    Step step;
    std::string unit;
};

void compare_groups(UnitAnalysis& analysis, const TrialTable& table, std::uint64_t seed) {
    const NamedMeasure measures[] = {
        {"time", &GroupSummary::exact_times, analysis.time_step, table.time_unit},
        {"deviation", &GroupSummary::exact_deviations, analysis.deviation_step, table.deviation_unit}};
    for (GroupSummary& group : analysis.groups)
        group.deviation_with_time = spearman(group.exact_times, group.exact_deviations, seed);
    for (std::size_t i = 0; i < analysis.groups.size(); ++i) {
        for (std::size_t k = i + 1; k < analysis.groups.size(); ++k) {
            for (const NamedMeasure& measure : measures) {
                Comparison one = compare(analysis.groups[i], analysis.groups[k], measure.values, measure.step, seed);
                one.measure = measure.name;
                one.unit = measure.unit;
                analysis.comparisons.push_back(std::move(one));
            }
        }
    }
}

std::vector<GroupSummary> empty_groups(const TrialTable& table) {
    std::vector<GroupSummary> groups;
    for (const std::string& name : table.groups) groups.emplace_back().group = name;
    return groups;
}

// Whom a unit's values are of; a participant's means have trial number 0.
struct UnitOf {
    std::string participant, group;
    int trial = 0;
};

void add_units(UnitAnalysis& analysis, const std::vector<UnitOf>& units, const ExactValues& times,
               const ExactValues& deviations) {
    analysis.time_step = times.step;
    analysis.deviation_step = deviations.step;
    for (std::size_t i = 0; i < units.size(); ++i) {
        GroupSummary& group = *std::ranges::find(analysis.groups, units[i].group, &GroupSummary::group);
        group.participants.push_back(units[i].participant);
        group.trial_numbers.push_back(units[i].trial);
        group.times.push_back(times.value(i));
        group.deviations.push_back(deviations.value(i));
        group.exact_times.push_back(times.steps[i]);
        group.exact_deviations.push_back(deviations.steps[i]);
    }
}

// Each participant's trials of one measure.
std::vector<std::vector<Decimal>> samples_of(const std::vector<ParticipantTrials>& participants,
                                             std::vector<Decimal> ParticipantTrials::* measure) {
    std::vector<std::vector<Decimal>> samples;
    for (const ParticipantTrials& one : participants) samples.push_back(one.*measure);
    return samples;
}

UnitAnalysis empty_analysis(Unit unit, const TrialTable& table) {
    return {.unit = unit,
            .groups = empty_groups(table),
            .time_step = {},
            .deviation_step = {},
            .comparisons = {},
            .warnings = {}};
}

void warn_of_sizes(UnitAnalysis& analysis) {
    for (const GroupSummary& group : analysis.groups) {
        const std::size_t n = group.times.size();
        if (n >= 5) continue;
        analysis.warnings.push_back(formatted("Group %s has %zu %s%s: with so few, hardly any p can be small.",
                                              group.group.c_str(), n, name_of(analysis.unit), n == 1 ? "" : "s"));
    }
}

// "trial 2 (transfer)", as the table tells it.
std::string name_of_place(const Trial& trial) {
    std::string name = formatted("trial %d", trial.number);
    if (!trial.stage.empty()) name += " (" + trial.stage + ")";
    return name;
}

// Warns of who has only some of the trials that others have: the mean of one is of other tasks or days than another's.
// Asked of tables that tell the trials' stages alone; elsewhere a number is no place of a protocol.
void warn_of_places(UnitAnalysis& analysis, const TrialTable& table) {
    constexpr std::size_t kMostSets = 8;
    if (std::ranges::all_of(table.trials, [](const Trial& t) { return t.stage.empty(); })) return;
    std::map<std::string, std::map<int, std::string>> of_person;
    std::map<std::string, std::string> group_of;
    for (const Trial& trial : table.trials) {
        of_person[trial.participant][trial.number] = name_of_place(trial);
        group_of[trial.participant] = trial.group;
    }
    std::map<std::string, std::map<std::string, std::size_t>> sets;  // by what they have, then by group
    for (const auto& [person, places] : of_person) {
        std::string names;
        for (const auto& [number, name] : places) names += (names.empty() ? "" : ", ") + name;
        ++sets[names][group_of[person]];
    }
    if (sets.size() < 2) return;
    std::string text =
        "Participants do not have valid trials of the same places of the protocol, so that means of different trials "
        "stand against each other";
    std::size_t told = 0;
    for (const auto& [names, groups] : sets) {
        if (++told > kMostSets) break;
        text += (told == 1 ? ": " : "; ") + names + ":";
        const char* between = " ";
        for (const auto& [group, count] : groups) {
            text += between + formatted("%zu of ", count) + group;
            between = ", ";
        }
    }
    if (sets.size() > kMostSets) text += formatted("; %zu more ways", sets.size() - kMostSets);
    analysis.warnings.push_back(text + ". Take a stage or a day alone to compare like with like.");
}

UnitAnalysis of_participants(const TrialTable& table, const std::vector<ParticipantTrials>& participants,
                             std::uint64_t seed) {
    UnitAnalysis analysis = empty_analysis(Unit::participant, table);
    std::vector<UnitOf> units;
    for (const ParticipantTrials& one : participants) units.push_back({one.participant, one.group, 0});
    add_units(analysis, units, exact_means(samples_of(participants, &ParticipantTrials::times)),
              exact_means(samples_of(participants, &ParticipantTrials::deviations)));
    compare_groups(analysis, table, seed);
    warn_of_sizes(analysis);
    warn_of_places(analysis, table);
    const auto trials = [](const ParticipantTrials& one) { return one.times.size(); };
    const auto [fewest, most] = std::ranges::minmax(participants, {}, trials);
    if (trials(fewest) != trials(most)) {
        analysis.warnings.push_back(formatted(
            "Participants have from %zu to %zu trials; each one's mean counts alike, however many trials it is of.",
            trials(fewest), trials(most)));
    }
    return analysis;
}

UnitAnalysis of_trials(const TrialTable& table, std::size_t participants, std::uint64_t seed) {
    UnitAnalysis analysis = empty_analysis(Unit::trial, table);
    std::vector<UnitOf> units;
    std::vector<Decimal> times, deviations;
    for (const Trial& trial : table.trials) {
        units.push_back({trial.participant, trial.group, trial.number});
        times.push_back(trial.exact_time);
        deviations.push_back(trial.exact_deviation);
    }
    add_units(analysis, units, exact_values(times), exact_values(deviations));
    compare_groups(analysis, table, seed);
    warn_of_sizes(analysis);
    if (participants < table.trials.size()) {
        analysis.warnings.push_back(formatted(
            "%zu trials come from %zu participants. Trials of one participant are not independent, as these tests "
            "assume, so p is too small where they agree: report the analysis of participants.",
            table.trials.size(), participants));
    }
    return analysis;
}

// The steps of each participant's trials.
std::vector<std::vector<Int128>> exact_trials(const std::vector<ParticipantTrials>& participants,
                                              std::vector<Decimal> ParticipantTrials::* measure) {
    std::vector<Decimal> pooled;
    for (const ParticipantTrials& one : participants)
        pooled.insert(pooled.end(), (one.*measure).begin(), (one.*measure).end());
    const ExactValues all = exact_values(pooled);
    std::vector<std::vector<Int128>> trials;
    auto next = all.steps.begin();
    for (const ParticipantTrials& one : participants) {
        trials.emplace_back(next, next + std::ssize(one.*measure));
        next += std::ssize(one.*measure);
    }
    return trials;
}

std::vector<Agreement> agreement_of(const std::vector<ParticipantTrials>& participants) {
    return {{.measure = "time",
             .intraclass = exact_intraclass_correlation(exact_trials(participants, &ParticipantTrials::times))},
            {.measure = "deviation",
             .intraclass = exact_intraclass_correlation(exact_trials(participants, &ParticipantTrials::deviations))}};
}

// How many rows have no measures and why, in the table's order of the reasons, and which groups have nothing else.
void note_lost(Analysis& analysis) {
    const std::vector<LostTrial>& lost = analysis.table.lost;
    if (lost.empty()) return;
    std::vector<std::pair<std::string, std::size_t>> reasons;
    std::set<std::string> without;
    for (const LostTrial& one : lost) {
        const std::string reason = one.reason.substr(0, one.reason.find(':'));
        const auto found = std::ranges::find(reasons, reason, [](const auto& r) { return r.first; });
        if (found == reasons.end())
            reasons.emplace_back(reason, 1);
        else
            ++found->second;
        if (std::ranges::find(analysis.table.groups, one.group) == analysis.table.groups.end())
            without.insert(one.group);
    }
    std::string text = formatted("%zu rows have no measures and are not analysed", lost.size());
    for (std::size_t i = 0; i < reasons.size(); ++i)
        text += (i == 0 ? ": " : ", ") + formatted("%zu ", reasons[i].second) + reasons[i].first;
    analysis.notes.push_back(text + ".");
    for (const std::string& group : without)
        analysis.notes.push_back("Group " + group + " has no valid trial, and is not compared.");
}

}  // namespace

const char* name_of(Unit unit) { return unit == Unit::participant ? "participant" : "trial"; }

Analysis analyse(TrialTable table, std::uint64_t seed) {
    Analysis analysis;
    analysis.table = std::move(table);
    analysis.seed = seed;
    note_lost(analysis);
    const std::vector<ParticipantTrials> participants = by_participant(analysis.table);
    if (participants.empty()) {
        analysis.notes.emplace_back("The table holds no valid trial, so that nothing is analysed.");
        return analysis;
    }
    analysis.participants = of_participants(analysis.table, participants, seed);
    analysis.trials = of_trials(analysis.table, participants.size(), seed);
    analysis.agreement = agreement_of(participants);
    const std::size_t groups = analysis.table.groups.size();
    if (groups == 1) analysis.notes.emplace_back("There is one group, so that nothing is compared between groups.");
    if (groups > 2) {
        analysis.notes.push_back(
            formatted("%zu groups are compared two by two; p is not corrected for so many comparisons.", groups));
    }
    std::string others;
    for (const std::string& name : analysis.table.other_columns) others += (others.empty() ? "" : ", ") + name;
    if (!others.empty()) analysis.notes.push_back("Columns that are not analysed: " + others + ".");
    if (analysis.table.deviation_unit.empty())
        analysis.notes.emplace_back(
            "The table states no unit of deviation; name its column deviation_m or deviation_mm.");
    return analysis;
}

}  // namespace burin::study

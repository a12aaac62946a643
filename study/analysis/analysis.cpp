// SPDX-License-Identifier: MIT
#include "study/analysis/analysis.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/statistics.hpp"
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
    std::vector<double> times, deviations;
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
        participants[at->second].times.push_back(trial.time);
        participants[at->second].deviations.push_back(trial.deviation);
    }
    return participants;
}

// The median as statistics books have it: the mean of the two in the middle of an even number.
double middle_of(std::vector<double> values) {
    if (values.empty()) return kUndefined;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

using Measure = std::vector<double> GroupSummary::*;

Comparison compare(const GroupSummary& a, const GroupSummary& b, Measure measure, std::uint64_t seed) {
    const std::vector<double>&first = a.*measure, &second = b.*measure;
    return {.measure = {},
            .unit = {},
            .first = a.group,
            .second = b.group,
            .n_first = first.size(),
            .n_second = second.size(),
            .median_first = middle_of(first),
            .median_second = middle_of(second),
            .mann_whitney = mann_whitney(first, second),
            .mann_whitney_normal = mann_whitney_normal(first, second),
            .difference_of_means = permutation_of_means(first, second, seed),
            .rank_biserial = rank_biserial(first, second),
            .hodges_lehmann = hodges_lehmann(first, second)};
}

struct NamedMeasure {
    const char* name;
    Measure values;
    std::string unit;
};

void compare_groups(UnitAnalysis& analysis, const TrialTable& table, std::uint64_t seed) {
    const NamedMeasure measures[] = {{"time", &GroupSummary::times, table.time_unit},
                                     {"deviation", &GroupSummary::deviations, table.deviation_unit}};
    for (GroupSummary& group : analysis.groups)
        group.deviation_with_time = spearman(group.times, group.deviations, seed);
    for (std::size_t i = 0; i < analysis.groups.size(); ++i) {
        for (std::size_t k = i + 1; k < analysis.groups.size(); ++k) {
            for (const NamedMeasure& measure : measures) {
                Comparison one = compare(analysis.groups[i], analysis.groups[k], measure.values, seed);
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

// The values of one unit: of a trial, or the means of a participant, whose trial has number 0.
void add_unit(std::vector<GroupSummary>& groups, const Trial& unit) {
    GroupSummary& group = *std::ranges::find(groups, unit.group, &GroupSummary::group);
    group.participants.push_back(unit.participant);
    group.trial_numbers.push_back(unit.number);
    group.times.push_back(unit.time);
    group.deviations.push_back(unit.deviation);
}

void warn_of_sizes(UnitAnalysis& analysis) {
    for (const GroupSummary& group : analysis.groups) {
        const std::size_t n = group.times.size();
        if (n >= 5) continue;
        analysis.warnings.push_back(formatted("Group %s has %zu %s%s: with so few, hardly any p can be small.",
                                              group.group.c_str(), n, name_of(analysis.unit), n == 1 ? "" : "s"));
    }
}

UnitAnalysis of_participants(const TrialTable& table, const std::vector<ParticipantTrials>& participants,
                             std::uint64_t seed) {
    UnitAnalysis analysis{.unit = Unit::participant, .groups = empty_groups(table), .comparisons = {}, .warnings = {}};
    for (const ParticipantTrials& one : participants) {
        add_unit(analysis.groups, {.participant = one.participant,
                                   .group = one.group,
                                   .number = 0,
                                   .deviation = mean(one.deviations),
                                   .time = mean(one.times)});
    }
    compare_groups(analysis, table, seed);
    warn_of_sizes(analysis);
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
    UnitAnalysis analysis{.unit = Unit::trial, .groups = empty_groups(table), .comparisons = {}, .warnings = {}};
    for (const Trial& trial : table.trials) add_unit(analysis.groups, trial);
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

std::vector<Agreement> agreement_of(const std::vector<ParticipantTrials>& participants) {
    std::vector<std::vector<double>> times, deviations;
    for (const ParticipantTrials& one : participants) {
        times.push_back(one.times);
        deviations.push_back(one.deviations);
    }
    return {{.measure = "time", .intraclass = intraclass_correlation(times)},
            {.measure = "deviation", .intraclass = intraclass_correlation(deviations)}};
}

}  // namespace

const char* name_of(Unit unit) { return unit == Unit::participant ? "participant" : "trial"; }

Analysis analyse(TrialTable table, std::uint64_t seed) {
    Analysis analysis;
    analysis.table = std::move(table);
    analysis.seed = seed;
    const std::vector<ParticipantTrials> participants = by_participant(analysis.table);
    if (participants.empty()) {
        analysis.notes.emplace_back("The table holds no trial.");
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

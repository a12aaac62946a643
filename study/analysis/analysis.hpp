// SPDX-License-Identifier: MIT
// The analysis of a table of trials: whether deviation goes with time within each group, and whether the groups differ
// in time and in deviation. It is done twice. With participants as units (each one's mean over their trials) the units
// are independent, as every test here assumes; that analysis is the one to report. With trials as units the trials of
// one participant count as if they were several people's, so that p comes out too small where they agree; it is there
// beside the first to compare with reports that did so. Values are ranked, and their differences taken, as the decimals
// of the table and exact means of these; doubles are for printing. Pure; any thread; the same table and seed give the
// same bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/statistics/exact.hpp"
#include "study/statistics/outcome.hpp"
#include "study/table/trial_table.hpp"

namespace burin::study {

enum class Unit { participant, trial };
[[nodiscard]] const char* name_of(Unit unit);  // "participant", "trial"

// One group's values and whether they go together.
struct GroupSummary {
    std::string group;
    // One for each unit, in the table's order; the trial's number is 0 where the unit is the participant.
    std::vector<std::string> participants;
    std::vector<int> trial_numbers;
    std::vector<double> times, deviations;              // rounded
    std::vector<Int128> exact_times, exact_deviations;  // in steps of the unit's analysis, the same for all groups
    Outcome deviation_with_time;                        // Spearman
};

// Two groups in one measure. Signs are the first group's.
struct Comparison {
    std::string measure;        // "time" or "deviation"
    std::string unit;           // of the measure; empty: not stated
    std::string first, second;  // groups
    std::size_t n_first = 0, n_second = 0;
    double median_first = kUndefined, median_second = kUndefined;
    Outcome mann_whitney;
    Outcome mann_whitney_normal;
    Outcome difference_of_means;  // permutation test
    Estimate rank_biserial, hodges_lehmann;
};

struct UnitAnalysis {
    Unit unit = Unit::participant;
    std::vector<GroupSummary> groups;
    Step time_step, deviation_step;       // of the exact values
    std::vector<Comparison> comparisons;  // every two groups, time before deviation
    std::vector<std::string> warnings;    // whole sentences
};

// How far the trials of a participant agree, over all groups.
struct Agreement {
    std::string measure;
    Estimate intraclass;
};

struct Analysis {
    TrialTable table;
    std::uint64_t seed = 1;
    UnitAnalysis participants, trials;
    std::vector<Agreement> agreement;
    std::vector<std::string> notes;
};

// The seed matters only where a permutation distribution is sampled; methods then name it.
[[nodiscard]] Analysis analyse(TrialTable table, std::uint64_t seed = 1);

}  // namespace burin::study

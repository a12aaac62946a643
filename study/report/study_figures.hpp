// SPDX-License-Identifier: MIT
// Figures of a whole study: how many people came how far, how each person's trials follow each other, and effect sizes
// with their intervals. SVG as text, readable in grey. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "study/analysis/analysis.hpp"

namespace burin::study {

struct FlowOfGroup {
    std::string group;
    std::size_t allocated = 0, withdrew = 0, unfinished = 0, without_valid_trial = 0, analysed = 0;
};
[[nodiscard]] std::string flow_figure(const std::vector<FlowOfGroup>& groups);

// A line for each participant over their outcome trials, and each group's median. `values`: times or deviations.
[[nodiscard]] std::string learning_figure(const UnitAnalysis& trials, const std::string& measure,
                                          const std::string& unit, std::vector<double> GroupSummary::* values);

// A row for each estimate: a dot with its interval.
struct IntervalRow {
    std::string name;
    Estimate estimate;
};
[[nodiscard]] std::string interval_figure(const std::string& title, const std::string& axis,
                                          const std::vector<IntervalRow>& rows);

}  // namespace burin::study

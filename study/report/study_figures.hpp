// SPDX-License-Identifier: MIT
// Figures of a whole study: how many people came how far, how each person's trials follow each other, and effect sizes
// with their intervals. SVG as text, readable in grey. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "study/analysis/analysis.hpp"
#include "study/people/trial_rows.hpp"

namespace burin::study {

// Each participant is in one box of each row: allocated are those that are not analysed and those that are.
[[nodiscard]] std::string flow_figure(const std::vector<FlowOfGroup>& groups);

// A plot for each stage and world, over the protocol's trials by their numbers: a line for each participant, which ends
// where another day begins or a trial was lost, and each group's median in the group's colour. `values`: times or
// deviations.
[[nodiscard]] std::string learning_figure(const TrialTable& table, const std::string& measure, const std::string& unit,
                                          double Trial::* values);

// A row for each estimate: a dot with its interval.
struct IntervalRow {
    std::string name;
    Estimate estimate;
};
[[nodiscard]] std::string interval_figure(const std::string& title, const std::string& axis,
                                          const std::vector<IntervalRow>& rows);

}  // namespace burin::study

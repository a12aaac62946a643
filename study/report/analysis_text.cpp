// SPDX-License-Identifier: MIT
#include "study/report/analysis_text.hpp"

#include <cmath>

#include "base/text.hpp"

namespace burin::study {
namespace {

std::string with_unit(double value, const std::string& unit) {
    return number_text(value) + (unit.empty() || std::isnan(value) ? "" : " " + unit);
}

std::string outcome_line(const char* statistic, const Outcome& outcome) {
    std::string line = std::string(statistic) + " = " + number_text(outcome.statistic) + ", p = " + p_text(outcome.p);
    if (!outcome.undefined.empty()) line += " (undefined: " + outcome.undefined + ")";
    return line + "  [" + outcome.method + "]\n";
}

std::string estimate_line(const char* name, const Estimate& estimate, const std::string& unit) {
    std::string line = std::string(name) + " = " + with_unit(estimate.value, unit);
    if (!std::isnan(estimate.low)) {
        line += formatted(", %.4g %% interval ", 100.0 * estimate.confidence) + number_text(estimate.low) + " to " +
                with_unit(estimate.high, unit);
    }
    if (!estimate.undefined.empty()) line += " (undefined: " + estimate.undefined + ")";
    return line + "  [" + estimate.method + "]\n";
}

std::string comparison_text(const Comparison& c) {
    std::string text = "  " + c.measure + (c.unit.empty() ? "" : " (" + c.unit + ")") + ", " + c.first +
                       formatted(" (n = %zu, median ", c.n_first) + number_text(c.median_first) + ") against " +
                       c.second + formatted(" (n = %zu, median ", c.n_second) + number_text(c.median_second) + "):\n";
    const std::string u_name = "    U(" + c.first + ")";
    text += outcome_line(u_name.c_str(), c.mann_whitney);
    if (c.mann_whitney.exact) text += outcome_line(u_name.c_str(), c.mann_whitney_normal);
    text += outcome_line("    difference of means", c.difference_of_means);
    text += estimate_line("    rank-biserial r", c.rank_biserial, "");
    text += estimate_line("    shift", c.hodges_lehmann, c.unit);
    return text;
}

std::string unit_text(const UnitAnalysis& analysis) {
    std::string text = analysis.unit == Unit::participant
                           ? "Unit of analysis: participant (the mean of each one's trials). Report this one.\n"
                           : "Unit of analysis: trial (for comparison only).\n";
    for (const std::string& warning : analysis.warnings) text += "  Warning: " + warning + "\n";
    for (const GroupSummary& group : analysis.groups) {
        const std::string name =
            formatted("  deviation with time, %s (n = %zu): r_s", group.group.c_str(), group.times.size());
        text += outcome_line(name.c_str(), group.deviation_with_time);
    }
    for (const Comparison& comparison : analysis.comparisons) text += comparison_text(comparison);
    return text;
}

}  // namespace

std::string number_text(double value) { return std::isnan(value) ? "undefined" : formatted("%.6g", value); }

std::string p_text(double p) {
    if (std::isnan(p)) return "undefined";
    return p < 0.0001 ? "< 0.0001" : formatted("%.4f", p);
}

std::string analysis_text(const Analysis& analysis) {
    std::string text =
        formatted("%zu trials, %zu groups\n", analysis.table.trials.size(), analysis.table.groups.size());
    for (const std::string& note : analysis.notes) text += "Note: " + note + "\n";
    text += "\n" + unit_text(analysis.participants) + "\n" + unit_text(analysis.trials) + "\n";
    text += "Agreement of a participant's trials, all groups together:\n";
    for (const Agreement& one : analysis.agreement)
        text += estimate_line(("  " + one.measure + " ICC").c_str(), one.intraclass, "");
    text +=
        "\nSigns are the first group's: r is P(first > second) - P(first < second), a shift is first less second.\n";
    return text;
}

}  // namespace burin::study

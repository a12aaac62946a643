// SPDX-License-Identifier: MIT
#include "study/report/html_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/plot/html.hpp"
#include "base/plot/svg.hpp"
#include "study/report/analysis_text.hpp"
#include "study/report/published_text.hpp"
#include "study/report/strip_plot.hpp"
#include "study/report/study_figures.hpp"

namespace burin::study {
namespace {

using plot::cell;
using plot::element;
using plot::number_cell;

std::string method_of(const std::string& method, const std::string& undefined) {
    return method + (undefined.empty() ? "" : "; undefined: " + undefined);
}

std::string outcome_row(const std::string& what, const std::string& figure, const Outcome& o) {
    return "<tr>" + cell(what) + cell(figure) + number_cell(number_text(o.statistic)) + number_cell(p_text(o.p)) +
           number_cell("") + cell(method_of(o.method, o.undefined)) + "</tr>\n";
}

std::string estimate_row(const std::string& what, const std::string& figure, const Estimate& e) {
    const std::string interval = std::isnan(e.low) ? ""
                                                   : number_text(e.low) + " to " + number_text(e.high) +
                                                         formatted(" (%.4g %%)", 100.0 * e.confidence);
    return "<tr>" + cell(what) + cell(figure) + number_cell(number_text(e.value)) + number_cell("") +
           number_cell(interval) + cell(method_of(e.method, e.undefined)) + "</tr>\n";
}

std::string figures_table(const std::string& rows) {
    return "<div class=\"wide\"><table "
           "class=\"figures\">\n<tr><th>of</th><th>figure</th><th>value</th><th>p</th><th>interval</th>"
           "<th>method</th></tr>\n" +
           rows + "</table></div>\n";
}

std::string comparison_rows(const Comparison& c) {
    const std::string what =
        c.measure + (c.unit.empty() ? "" : " in " + c.unit) + ": " + c.first + " against " + c.second;
    return outcome_row(what, "U of " + c.first, c.mann_whitney) +
           outcome_row(what, "U of " + c.first, c.mann_whitney_normal) +
           outcome_row(what, "difference of means", c.difference_of_means) +
           estimate_row(what, "rank-biserial r", c.rank_biserial) +
           estimate_row(what, "Hodges-Lehmann shift", c.hodges_lehmann);
}

std::string label_of(const GroupSummary& group, std::size_t i) {
    return group.participants[i] + (group.trial_numbers[i] > 0 ? formatted(", trial %d", group.trial_numbers[i]) : "");
}

std::string plot_of(const UnitAnalysis& analysis, const std::string& measure, const std::string& unit,
                    std::vector<double> GroupSummary::* values) {
    std::vector<Strip> strips;
    for (const GroupSummary& group : analysis.groups) {
        Strip strip{.name = group.group, .values = group.*values, .labels = {}};
        for (std::size_t i = 0; i < group.participants.size(); ++i) strip.labels.push_back(label_of(group, i));
        strips.push_back(std::move(strip));
    }
    return strip_plot(measure + " of each " + name_of(analysis.unit),
                      unit.empty() ? measure : measure + " (" + unit + ")", strips);
}

std::string unit_section(const UnitAnalysis& analysis, const TrialTable& table) {
    std::string html = element("h2", std::string("Unit of analysis: ") + name_of(analysis.unit));
    html += element("p",
                    analysis.unit == Unit::participant
                        ? "Each participant counts once, with the mean of their trials. This is the analysis to report."
                        : "Each trial counts by itself. For comparison with reports that did so.");
    for (const std::string& warning : analysis.warnings)
        html += "<p class=\"warning\">Warning: " + plot::escaped(warning) + "</p>\n";
    html += "<div class=\"plots\">\n" + plot_of(analysis, "Time", table.time_unit, &GroupSummary::times) +
            plot_of(analysis, "Deviation", table.deviation_unit, &GroupSummary::deviations) + "</div>\n";
    std::string rows;
    for (const GroupSummary& group : analysis.groups)
        rows += outcome_row("deviation with time, " + group.group, "r_s", group.deviation_with_time);
    for (const Comparison& comparison : analysis.comparisons) rows += comparison_rows(comparison);
    return html + figures_table(rows);
}

std::string figures_of(const std::vector<std::string>& svgs) {
    std::string html = "<div class=\"plots\">\n";
    for (const std::string& svg : svgs) html += svg;
    return html + "</div>\n";
}

// Of figures with long rows, which are scrolled where the screen is narrower than they can be read.
std::string wide_figures_of(const std::vector<std::string>& svgs) {
    std::string html;
    for (const std::string& svg : svgs) html += "<div class=\"wide\">\n" + svg + "</div>\n";
    return html;
}

std::string section_of(const ReportSection& section) {
    std::string html = element("h2", section.heading);
    for (const std::string& sentence : section.sentences) html += element("p", sentence);
    return section.figures.empty() ? html : html + figures_of(section.figures);
}

// All comparisons of both units, participants first.
std::string effects_section(const Analysis& analysis) {
    std::vector<IntervalRow> ranks;
    std::map<std::string, std::vector<IntervalRow>> shifts;  // by measure and unit, which are of one scale
    for (const UnitAnalysis* unit : {&analysis.participants, &analysis.trials}) {
        for (const Comparison& c : unit->comparisons) {
            const std::string pair = analysis.table.groups.size() > 2 ? ", " + c.first + " - " + c.second : "";
            ranks.push_back({c.measure + pair + ", by " + name_of(unit->unit), c.rank_biserial});
            shifts[c.measure + (c.unit.empty() ? "" : " (" + c.unit + ")")].push_back(
                {"by " + std::string(name_of(unit->unit)) + pair, c.hodges_lehmann});
        }
    }
    if (ranks.empty()) return "";
    const std::vector<std::string>& groups = analysis.table.groups;
    const std::string sign = groups.size() == 2 ? groups[0] + " less " + groups[1] : "first group less second";
    std::vector<std::string> figures{interval_figure("Rank-biserial correlation", "r: " + sign, ranks)};
    for (const auto& [measure, rows] : shifts)
        figures.push_back(interval_figure("Shift of " + measure, "Hodges-Lehmann: " + sign, rows));
    return element("h2", "Effect sizes") + wide_figures_of(figures);
}

std::string learning_section(const Analysis& analysis) {
    const TrialTable& table = analysis.table;
    const bool several = std::ranges::any_of(table.trials, [](const Trial& t) { return t.number > 1; });
    if (!several) return "";
    return element("h2", "Learning curves") +
           element("p",
                   "A line for each participant within a stage, its world and a day; it is broken where a trial was "
                   "lost. The thick line is the group's median.") +
           figures_of({learning_figure(table, "deviation", table.deviation_unit, &Trial::deviation),
                       learning_figure(table, "time", table.time_unit, &Trial::time)});
}

std::string agreement_section(const Analysis& analysis) {
    std::string rows;
    for (const Agreement& one : analysis.agreement) rows += estimate_row(one.measure, "ICC(1)", one.intraclass);
    return element("h2", "Agreement of a participant's trials") + figures_table(rows);
}

std::string data_section(const TrialTable& table) {
    const auto has_stage = [](const auto& trial) { return !trial.stage.empty(); };
    const bool staged = std::ranges::any_of(table.trials, has_stage) || std::ranges::any_of(table.lost, has_stage);
    const auto begin = [&](const auto& t) {
        return "<tr>" + cell(t.participant) + cell(t.group) + number_cell(std::to_string(t.number)) +
               (staged ? cell(t.stage) + cell(t.world) + cell(t.day) : "");
    };
    std::string rows;
    for (const Trial& t : table.trials)
        rows += begin(t) + number_cell(number_text(t.deviation)) + number_cell(number_text(t.time)) +
                (table.lost.empty() ? "" : cell("")) + "</tr>\n";
    for (const LostTrial& t : table.lost)
        rows += begin(t) + number_cell("") + number_cell("") + cell(t.reason) + "</tr>\n";
    const std::string unit = table.deviation_unit.empty() ? "" : " (" + table.deviation_unit + ")";
    return element("h2", "The data") +
           "<div class=\"wide\"><table>\n<tr><th>participant</th><th>group</th><th>trial</th>" +
           (staged ? "<th>stage</th><th>world</th><th>day</th>" : "") + "<th>deviation" + plot::escaped(unit) +
           "</th><th>time (" + plot::escaped(table.time_unit) + ")</th>" +
           (table.lost.empty() ? "" : "<th>no measures, since</th>") + "</tr>\n" + rows + "</table></div>\n";
}

}  // namespace

std::string html_report(const Analysis& analysis, const std::vector<PublishedComparison>& published,
                        const ReportOrigin& origin) {
    std::string html = plot::page_begin("Analysis of a study") +
                       element("h1", origin.title.empty() ? "Analysis of " + origin.data : origin.title);
    html += element("p", formatted("%zu trials, %zu groups. %s, seed %llu.", analysis.table.trials.size(),
                                   analysis.table.groups.size(), origin.program.c_str(),
                                   static_cast<unsigned long long>(analysis.seed)));
    for (const std::string& fact : origin.facts) html += element("p", fact);
    for (const std::string& note : analysis.notes) html += element("p", note);
    for (const ReportSection& section : origin.sections) html += section_of(section);
    html += unit_section(analysis.participants, analysis.table) + unit_section(analysis.trials, analysis.table);
    html += element("p",
                    "Signs are the first group's: r is P(first > second) - P(first < second), a shift is first less "
                    "second. Mann-Whitney's test is not one of means or medians.");
    html += effects_section(analysis) + learning_section(analysis) + agreement_section(analysis);
    for (const PublishedComparison& comparison : published)
        html += element("h2", "Published figures beside the data") + element("pre", published_text(comparison));
    return html + data_section(analysis.table) + plot::page_end();
}

}  // namespace burin::study

// SPDX-License-Identifier: MIT
#include "study/report/analysis_tables.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/csv.hpp"
#include "study/statistics/ranks.hpp"

namespace burin::study {
namespace {

// A line of fields with commas between them.
template <typename... Fields>
std::string csv_line(const Fields&... fields) {
    std::string line;
    bool first = true;
    const auto add = [&](const auto& field) {
        if (!std::exchange(first, false)) line += ',';
        if constexpr (requires { std::string_view(field); }) {
            line += csv_field(field);
        } else {
            line += csv_number(static_cast<double>(field));
        }
    };
    (add(fields), ...);
    return line + "\n";
}

// ---- JSON

Json outcome_json(const Outcome& outcome) {
    Json json = {
        {"statistic", outcome.statistic}, {"p", outcome.p}, {"method", outcome.method}, {"exact", outcome.exact}};
    if (!outcome.undefined.empty()) json["undefined"] = outcome.undefined;
    return json;
}

Json estimate_json(const Estimate& estimate) {
    Json json = {{"value", estimate.value},           {"low", estimate.low},       {"high", estimate.high},
                 {"confidence", estimate.confidence}, {"method", estimate.method}, {"exact", estimate.exact}};
    if (!estimate.undefined.empty()) json["undefined"] = estimate.undefined;
    return json;
}

Json unit_json(const UnitAnalysis& analysis) {
    Json json = {{"unit", name_of(analysis.unit)},
                 {"warnings", analysis.warnings},
                 {"groups", Json::array()},
                 {"comparisons", Json::array()}};
    for (const GroupSummary& group : analysis.groups) {
        json["groups"].push_back({{"group", group.group},
                                  {"n", group.times.size()},
                                  {"deviation_with_time", outcome_json(group.deviation_with_time)}});
    }
    for (const Comparison& c : analysis.comparisons) {
        json["comparisons"].push_back({{"measure", c.measure},
                                       {"unit", c.unit},
                                       {"first", c.first},
                                       {"second", c.second},
                                       {"n_first", c.n_first},
                                       {"n_second", c.n_second},
                                       {"median_first", c.median_first},
                                       {"median_second", c.median_second},
                                       {"mann_whitney", outcome_json(c.mann_whitney)},
                                       {"mann_whitney_normal", outcome_json(c.mann_whitney_normal)},
                                       {"difference_of_means", outcome_json(c.difference_of_means)},
                                       {"rank_biserial", estimate_json(c.rank_biserial)},
                                       {"hodges_lehmann", estimate_json(c.hodges_lehmann)}});
    }
    return json;
}

// ---- CSV

std::string trials_csv(const TrialTable& table) {
    const std::string deviation = table.deviation_unit.empty() ? "deviation" : "deviation_" + table.deviation_unit,
                      time = "time_" + table.time_unit;
    const auto has_stage = [](const auto& trial) { return !trial.stage.empty(); };
    if (table.lost.empty() && std::ranges::none_of(table.trials, has_stage)) {
        std::string text = csv_line("participant", "group", "trial", deviation, time);
        for (const Trial& t : table.trials) text += csv_line(t.participant, t.group, t.number, t.deviation, t.time);
        return text;
    }
    std::string text = csv_line("participant", "group", "trial", deviation, time, "stage", "world", "day", "reason");
    for (const Trial& t : table.trials)
        text += csv_line(t.participant, t.group, t.number, t.deviation, t.time, t.stage, t.world, t.day, "");
    for (const LostTrial& t : table.lost)
        text += csv_line(t.participant, t.group, t.number, "", "", t.stage, t.world, t.day, t.reason);
    return text;
}

std::string ranks_in_groups(const UnitAnalysis& analysis) {
    std::string text;
    for (const GroupSummary& g : analysis.groups) {
        const std::vector<double> times = midranks(g.exact_times), deviations = midranks(g.exact_deviations);
        for (std::size_t i = 0; i < times.size(); ++i) {
            const double d = times[i] - deviations[i];
            text += csv_line(name_of(analysis.unit), g.group, g.participants[i], g.trial_numbers[i], g.times[i],
                             times[i], g.deviations[i], deviations[i], d, d * d);
        }
    }
    return text;
}

// One measure of a group's units, as it is ranked and as it is printed.
struct RankedMeasure {
    std::vector<Int128> GroupSummary::* exact;
    std::vector<double> GroupSummary::* printed;
};

std::string ranks_of_pair(const UnitAnalysis& analysis, const GroupSummary& first, const GroupSummary& second,
                          const RankedMeasure& measure) {
    std::vector<Int128> all = first.*measure.exact;
    all.insert(all.end(), (second.*measure.exact).begin(), (second.*measure.exact).end());
    const std::vector<double> ranks = midranks(all);
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool in_first = i < first.participants.size();
        const GroupSummary& group = in_first ? first : second;
        const std::size_t at = in_first ? i : i - first.participants.size();
        text += csv_line(name_of(analysis.unit), first.group, second.group, group.group, group.participants[at],
                         group.trial_numbers[at], (group.*measure.printed)[at], ranks[i]);
    }
    return text;
}

std::string ranks_of(const Analysis& analysis, const RankedMeasure& measure) {
    std::string text = csv_line("unit", "first", "second", "group", "participant", "trial", "value", "rank");
    for (const UnitAnalysis* unit : {&analysis.participants, &analysis.trials}) {
        for (std::size_t i = 0; i < unit->groups.size(); ++i) {
            for (std::size_t k = i + 1; k < unit->groups.size(); ++k)
                text += ranks_of_pair(*unit, unit->groups[i], unit->groups[k], measure);
        }
    }
    return text;
}

std::string outcome_csv(const std::string& begin, const char* figure, const Outcome& o) {
    return begin + "," + csv_line(figure, o.statistic, o.p, "", "", "", o.exact ? "yes" : "no", o.method, o.undefined);
}

std::string estimate_csv(const std::string& begin, const char* figure, const Estimate& e) {
    return begin + "," +
           csv_line(figure, e.value, "", e.low, e.high, e.confidence, e.exact ? "yes" : "no", e.method, e.undefined);
}

// The fields that say what a figure is of, without a line end.
std::string subject(const auto&... fields) {
    std::string line = csv_line(fields...);
    line.pop_back();
    return line;
}

std::string tests_of(const UnitAnalysis& analysis) {
    std::string text;
    const char* unit = name_of(analysis.unit);
    for (const GroupSummary& g : analysis.groups) {
        text += outcome_csv(subject(unit, "deviation with time", g.group, "", g.times.size(), ""), "Spearman's r_s",
                            g.deviation_with_time);
    }
    for (const Comparison& c : analysis.comparisons) {
        const std::string begin = subject(unit, c.measure, c.first, c.second, c.n_first, c.n_second);
        text += outcome_csv(begin, "U of the first", c.mann_whitney);
        text += outcome_csv(begin, "U of the first", c.mann_whitney_normal);
        text += outcome_csv(begin, "difference of means", c.difference_of_means);
        text += estimate_csv(begin, "rank-biserial r", c.rank_biserial);
        text += estimate_csv(begin, "Hodges-Lehmann shift", c.hodges_lehmann);
    }
    return text;
}

std::string tests_csv(const Analysis& analysis) {
    std::string text = csv_line("unit", "measure", "first", "second", "n_first", "n_second", "figure", "value", "p",
                                "low", "high", "confidence", "exact", "method", "undefined");
    text += tests_of(analysis.participants) + tests_of(analysis.trials);
    for (const Agreement& one : analysis.agreement)
        text += estimate_csv(subject("participant", one.measure, "", "", "", ""), "ICC", one.intraclass);
    return text;
}

}  // namespace

Json analysis_json(const Analysis& analysis) {
    Json json = {{"trials", analysis.table.trials.size()},
                 {"rows_without_measures", analysis.table.lost.size()},
                 {"groups", analysis.table.groups},
                 {"time_unit", analysis.table.time_unit},
                 {"deviation_unit", analysis.table.deviation_unit},
                 {"other_columns", analysis.table.other_columns},
                 {"seed", analysis.seed},
                 {"notes", analysis.notes},
                 {"unit_to_report", name_of(Unit::participant)},
                 {"analyses", {unit_json(analysis.participants), unit_json(analysis.trials)}},
                 {"agreement", Json::array()}};
    for (const Agreement& one : analysis.agreement)
        json["agreement"].push_back({{"measure", one.measure}, {"icc", estimate_json(one.intraclass)}});
    return json;
}

Json published_json(const PublishedComparison& comparison) {
    Json json = {{"title", comparison.title},
                 {"figures", comparison.checks.size()},
                 {"disagreeing", comparison.disagreeing()},
                 {"differences", Json::array()}};
    for (const PublishedCheck& check : comparison.checks) {
        if (check.agrees) continue;
        json["differences"].push_back({{"table", check.value.table},
                                       {"quantity", name_of(check.value.quantity)},
                                       {"group", check.value.group},
                                       {"participant", check.value.participant},
                                       {"trial", check.value.trial},
                                       {"printed", check.value.text},
                                       {"from_data", check.from_data},
                                       {"remark", check.remark}});
    }
    return json;
}

std::vector<NamedText> analysis_tables(const Analysis& analysis) {
    const std::string ranks_header = csv_line("unit", "group", "participant", "trial", "time", "time_rank", "deviation",
                                              "deviation_rank", "d", "d_squared");
    return {
        {"trials.csv", trials_csv(analysis.table)},
        {"ranks-in-groups.csv",
         ranks_header + ranks_in_groups(analysis.participants) + ranks_in_groups(analysis.trials)},
        {"ranks-of-time.csv", ranks_of(analysis, {&GroupSummary::exact_times, &GroupSummary::times})},
        {"ranks-of-deviation.csv", ranks_of(analysis, {&GroupSummary::exact_deviations, &GroupSummary::deviations})},
        {"tests.csv", tests_csv(analysis)}};
}

}  // namespace burin::study

// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/baseline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <string>
#include <string_view>

#include "activities/rehab/exercise/person_range.hpp"
#include "base/plot/html.hpp"
#include "base/plot/svg.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

constexpr const char* kAssessment = "assess";
constexpr double kDegreesOfRad = 180.0 / std::numbers::pi;

std::optional<double> measure_in(const Json& json, const std::string& path) {
    const Json* const value = find_value(json, path);
    return value != nullptr && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

bool is_carried_to_its_end(const KeptRun& run) {
    const auto is = [&](const char* name, std::string_view text) {
        const auto* const found = run.report.at(name).get_ptr<const std::string*>();
        return found != nullptr && *found == text;
    };
    return is("exercise", kAssessment) && is("ended", "done");
}

// The findings of an assessment's finger by their names; null where it has none.
const Json* finger_in(const Json& report, const Json& name) {
    const Json* const fingers = find_value(report, std::string("/") + kAssessment + "/fingers");
    if (fingers == nullptr || !fingers->is_array()) return nullptr;
    const auto found = std::ranges::find_if(*fingers, [&](const Json& finger) {
        const Json* const own = finger.is_object() ? find_value(finger, "/finger") : nullptr;
        return own != nullptr && *own == name;
    });
    return found != fingers->end() ? &*found : nullptr;
}

// The sum of a finger's bending joints, in degrees.
std::optional<double> bending_of(const Json& finger) {
    const Json* const ranges = find_value(finger, "/range_of_motion_rad");
    if (ranges == nullptr || !ranges->is_array() || ranges->size() < 2) return std::nullopt;
    double sum_rad = 0.0;
    for (std::size_t joint = 1; joint < ranges->size(); ++joint) {
        if (!ranges->at(joint).is_number()) return std::nullopt;
        sum_rad += ranges->at(joint).get<double>();
    }
    return kDegreesOfRad * sum_rad;
}

// "48.0", or "48.0, at first 40.0" where the first assessment is another one.
std::string measure_text(const std::optional<double>& now, const std::optional<double>& first, bool is_first,
                         int decimals, const PageTexts& texts) {
    const auto number = [&](const std::optional<double>& value) {
        return value ? texts.number(*value, decimals) : std::string("-");
    };
    return is_first ? number(now) : texts.filled("at_first", {{"now", number(now)}, {"first", number(first)}});
}

}  // namespace

std::string side_of(const KeptRun& run) {
    const Json* const side = find_value(run.report, "/side");
    return side != nullptr && side->is_string() ? side->get<std::string>() : std::string(kUsualSide);
}

std::optional<Baseline> baseline_of(std::span<const KeptRun> runs, unsigned participant, std::string_view side) {
    for (const KeptRun& run : runs | std::views::reverse) {
        if (run.participant != participant || side_of(run) != side || !is_carried_to_its_end(run)) continue;
        Baseline baseline{run.date, run.time, measure_in(run.report, "/person_range/open"),
                          measure_in(run.report, "/person_range/closed"),
                          measure_in(run.report, "/person_range/most_N")};
        if (!baseline.open || !baseline.closed) baseline.open = baseline.closed = std::nullopt;
        return baseline;
    }
    return std::nullopt;
}

FittedValues fitted_by(const SettingValues& values, const Baseline& baseline) {
    FittedValues fitted{values, {}, {}};
    const auto leave_out = [&](const std::string& why) {
        fitted.left_out += (fitted.left_out.empty() ? "" : "; ") + why;
    };
    const bool takes_way =
        values.has("open") && values.has("closed") && !values.was_set("open") && !values.was_set("closed");
    if (takes_way && baseline.open) {
        fitted.values.set("open", *baseline.open);
        fitted.values.set("closed", *baseline.closed);
        const auto wrong = too_short_a_way(fitted.values);
        if (wrong || !problems(fitted.values).empty()) {
            leave_out("its way is none that exercises go by: " +
                      (wrong ? wrong->what : problems(fitted.values)[0].what));
            fitted.values = values;
        } else {
            fitted.taken = {"open", "closed"};
        }
    }
    if (!values.has("most_N") || values.was_set("most_N") || !baseline.most_N) return fitted;
    const SettingValues before = fitted.values;
    fitted.values.set("most_N", *baseline.most_N);
    // The lowest level asks for a quarter.
    constexpr double kLowestShare = 0.25;
    if (*baseline.most_N * kLowestShare < kLeastTarget_N || !problems(fitted.values).empty()) {
        leave_out(formatted("its most force, %.2f N, is too little for a target", *baseline.most_N));
        fitted.values = before;
    } else {
        fitted.taken.push_back("most_N");
    }
    return fitted;
}

std::string text_of(const Baseline& baseline, const FittedValues& fitted) {
    std::string text;
    for (const std::string& key : fitted.taken)
        text += (text.empty() ? ": " : ", ") + key + formatted(" %.3g", fitted.values.number(key));
    return "the assessment of " + baseline.date + " " + baseline.time + text;
}

std::string baseline_table(std::span<const KeptRun* const> all, const PageTexts& texts) {
    std::vector<const KeptRun*> runs(all.begin(), all.end());
    std::erase_if(runs, [](const KeptRun* run) { return !is_carried_to_its_end(*run); });
    const std::string title = plot::element("h3", texts.text("assessment"));
    if (runs.empty()) return title + plot::element("p", texts.text("assessment_none"));
    const KeptRun &first = *runs.front(), &now = *runs.back();
    const bool is_first = runs.size() == 1;
    std::string rows = "<tr>";
    for (const char* head : {"finger", "bending_head", "strength_head", "speed_head", "fractionation"})
        rows += "<th>" + plot::escaped(texts.text(head)) + "</th>";
    rows += "</tr>\n";
    for (const Json& measured : now.report.at("fingers")) {
        const Json name = measured.at("finger");
        const Json none = Json::object();
        const Json *const found = finger_in(now.report, name), *const before = finger_in(first.report, name);
        const Json &finger = found != nullptr ? *found : none, &then = before != nullptr ? *before : none;
        const auto of = [](const Json& one, const char* key, double unit) {
            const auto number = measure_in(one, std::string("/") + key);
            return number ? std::optional(*number * unit) : std::nullopt;
        };
        const auto cell_of = [&](const char* key, double unit, int decimals) {
            return plot::number_cell(
                measure_text(of(finger, key, unit), of(then, key, unit), is_first, decimals, texts));
        };
        rows += "<tr>" + plot::cell(texts.named(name.get<std::string>())) +
                plot::number_cell(measure_text(bending_of(finger), bending_of(then), is_first, 0, texts)) +
                cell_of("strength_N", 1.0, 2) + cell_of("peak_speed_rad_per_s", kDegreesOfRad, 0) +
                cell_of("fractionation", 1.0, 2) + "</tr>\n";
    }
    const auto together = [](const KeptRun& run) { return measure_in(run.report, "/assess/strength_together_N"); };
    return title +
           plot::element(
               "p", texts.filled("assessment_baseline",
                                 {{"date", texts.date(now.date)},
                                  {"time", now.time},
                                  {"strength", measure_text(together(now), together(first), is_first, 2, texts)}})) +
           "<div class=\"wide\"><table>\n" + rows + "</table></div>\n";
}

}  // namespace burin::activities

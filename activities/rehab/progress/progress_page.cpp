// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "activities/rehab/progress/baseline.hpp"
#include "activities/rehab/progress/progress.hpp"
#include "base/plot/figures.hpp"
#include "base/plot/html.hpp"
#include "base/plot/svg.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

using plot::cell;
using plot::element;
using plot::number_cell;
using Runs = std::vector<const KeptRun*>;

constexpr double kDegrees = 180.0 / std::numbers::pi;

double number_at(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_number() ? found->get<double>() : std::nan("");
}

// Returns the range of motion of a finger: the sum of its three joints that bend, in degrees.
double bending_deg(const Json& finger) {
    const auto ranges = finger.find("range_of_motion_rad");
    if (ranges == finger.end() || !ranges->is_array() || ranges->size() < 2) return std::nan("");
    return kDegrees * std::accumulate(ranges->begin() + 1, ranges->end(), 0.0, [](double sum, const Json& range) {
               return sum + (range.is_number() ? range.get<double>() : std::nan(""));
           });
}

// A plot over the days since the first run, from zero to at least `highest`: so that what hardly changes looks so.
plot::Plot over_days(const std::string& title, const std::string& unit, double highest) {
    plot::Plot made;
    made.title = title;
    made.x_label = "day";
    made.y_label = unit;
    made.x_linear = made.y_linear = made.x_whole = true;
    made.y_highest = highest;
    return made;
}

// A line for each finger, of one figure of it.
template <typename Figure>
plot::Plot of_fingers(const Runs& runs, int first_day, const std::string& title, const std::string& unit,
                      double highest, Figure figure) {
    plot::Plot made = over_days(title, unit, highest);
    std::map<std::string, std::size_t> places;
    for (const KeptRun* run : runs)
        for (const Json& finger : run->report.at("fingers")) {
            const auto name = finger.find("finger");
            if (name == finger.end() || !name->is_string()) continue;
            const auto [place, is_new] = places.try_emplace(name->get<std::string>(), made.series.size());
            if (is_new) made.series.push_back({place->first, {}, 0.0});
            made.series[place->second].points.push_back(
                {static_cast<double>(day_of(run->date) - first_day), figure(finger), ""});
        }
    return made;
}

std::string figures_of(const Runs& runs) {
    const int first_day = day_of(runs.front()->date);
    plot::Plot scores = over_days("Score", "of 100", 100.0);
    std::map<double, std::size_t> levels;
    for (const KeptRun* run : runs) {
        const double level = number_at(run->report.at("settings"), "level");
        const auto [place, is_new] = levels.try_emplace(std::isfinite(level) ? level : 0.0, scores.series.size());
        if (is_new) scores.series.push_back({formatted("level %.0f", place->first), {}, 0.0});
        scores.series[place->second].points.push_back(
            {static_cast<double>(day_of(run->date) - first_day), number_at(run->report, "score"), ""});
    }
    const auto of = [](const char* key) { return [key](const Json& finger) { return number_at(finger, key); }; };
    std::vector<plot::Plot> plots{
        scores,
        of_fingers(runs, first_day, "Highest force", "N", 1.0, of("peak_force_N")),
        of_fingers(runs, first_day, "Mean force while pushed", "N", 1.0, of("mean_force_N")),
        of_fingers(runs, first_day, "Bending of three joints together", "degrees", 90.0, bending_deg),
        of_fingers(runs, first_day, "Mean speed of bending", "degrees a second", 60.0,
                   [](const Json& finger) { return kDegrees * number_at(finger, "mean_speed_rad_per_s"); }),
        of_fingers(runs, first_day, "Fractionation", "1: others still, 0: all move", 1.0, of("fractionation"))};
    std::erase_if(plots.back().series, [](const plot::PlotSeries& series) {
        return std::ranges::none_of(series.points, [](const plot::PlotPoint& point) { return std::isfinite(point.y); });
    });
    if (plots.back().series.empty()) plots.pop_back();
    return "<div class=\"wide\">\n" + plot::svg_figure("Day by day", plots, 3) + "</div>\n";
}

std::string pairs_of(const Json& object) {
    std::string text;
    for (const auto& [key, value] : object.items())
        text += (text.empty() ? "" : ", ") + key + " " +
                (value.is_string()   ? value.get<std::string>()
                 : value.is_number() ? formatted("%g", value.get<double>())
                                     : "?");
    return text;
}

// Returns the highest of each finger's forces; a dash where nothing is known.
std::string forces_of(const Json& report, const char* key) {
    std::string text;
    for (const Json& finger : report.at("fingers")) {
        const double force_N = number_at(finger, key);
        text += (text.empty() ? "" : ", ") + (std::isfinite(force_N) ? formatted("%.2f", force_N) : "-");
    }
    return text;
}

std::string table_of(const Runs& runs) {
    std::string rows;
    for (const KeptRun* run : runs) {
        const Json& report = run->report;
        rows += "<tr>" + cell(run->date) + cell(run->time) + cell(run->hand) + cell(pairs_of(report.at("settings"))) +
                cell(report.at("ended").get<std::string>()) +
                number_cell(formatted("%.0f", number_at(report, "score"))) + cell(pairs_of(report.at("counts"))) +
                number_cell(formatted("%.1f", number_at(report, "time_s"))) + cell(forces_of(report, "peak_force_N")) +
                cell(forces_of(report, "peak_measured_N")) + "</tr>\n";
    }
    return "<div class=\"wide\"><table>\n<tr><th>date</th><th>time</th><th>hand</th><th>settings</th><th>ended</th>"
           "<th>score</th><th>counted</th><th>seconds</th><th>asked, N</th><th>given, N</th></tr>\n" +
           rows + "</table></div>\n";
}

std::string title_of(std::string name) {
    if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
    return name;
}

std::string section_of(unsigned participant, const std::string& exercise, const Runs& runs, unsigned levels) {
    const auto scripted = std::ranges::count_if(runs, &KeptRun::is_scripted);
    std::string html = element("h2", formatted("Participant %u: ", participant) + title_of(exercise));
    html += element("p", formatted("%zu %s from %s to %s, the last with a score of %.0f.", runs.size(),
                                   runs.size() == 1 ? "run" : "runs", runs.front()->date.c_str(),
                                   runs.back()->date.c_str(), number_at(runs.back()->report, "score")));
    if (scripted > 0)
        html += "<p class=\"warning\">" +
                plot::escaped(formatted("%td of these runs were done by a simulated hand, by script: no person did "
                                        "them.",
                                        scripted)) +
                "</p>\n";
    html += element("p", proposed(runs, levels).reason + " Settings change only where somebody changes them.");
    if (exercise == "assess") html += baseline_table(runs);
    return html + figures_of(runs) + table_of(runs);
}

}  // namespace

std::string progress_page(const KeptRuns& kept, unsigned (*levels)(std::string_view exercise),
                          const std::string& program) {
    std::map<std::pair<unsigned, std::string>, Runs> sections;
    for (const KeptRun& run : kept.runs)
        sections[{run.participant, run.report.at("exercise").get<std::string>()}].push_back(&run);
    std::string html = plot::page_begin("Progress of exercises") + element("h1", "Progress of exercises");
    html += element("p",
                    formatted("%zu %s. %s. Forces are those that the device was asked to give; beside them stand those "
                              "that it measured that it gave, the highest of thumb, index, middle and ring.",
                              kept.runs.size(), kept.runs.size() == 1 ? "run" : "runs", program.c_str()));
    for (const Error& error : kept.errors)
        html += "<p class=\"warning\">Left out: " + plot::escaped(error.line()) + "</p>\n";
    for (const auto& [of, runs] : sections) html += section_of(of.first, of.second, runs, levels(of.second));
    return html + plot::page_end();
}

}  // namespace burin::activities

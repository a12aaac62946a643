// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/patient_page.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "activities/rehab/measures/hand_measures.hpp"
#include "activities/rehab/progress/baseline.hpp"
#include "activities/rehab/progress/line_fit.hpp"
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
constexpr double kDaysOfWeek = 7.0;

// Large enough to be read at arm's length, and on paper.
constexpr std::string_view kLarge = "body { font-size: 20px; }\ntable { font-size: 0.8em; }\n";

double number_at(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::string text_of(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

// Returns the range of motion of a finger: the sum of its three joints that bend, in degrees.
double bending_deg(const Json& finger) {
    const auto ranges = finger.find("range_of_motion_rad");
    if (ranges == finger.end() || !ranges->is_array() || ranges->size() < 2) return std::nan("");
    return kDegrees * std::accumulate(ranges->begin() + 1, ranges->end(), 0.0, [](double sum, const Json& range) {
               return sum + (range.is_number() ? range.get<double>() : std::nan(""));
           });
}

// A figure of each finger, that the page shows over days.
struct FingerFigure {
    const char *title, *unit;                    // keys of texts
    double highest = 1.0;                        // that its plot shows at least
    int decimals = 0;                            // in tables
    double (*of)(const Json& finger) = nullptr;  // NaN: not known
};
constexpr std::array<FingerFigure, 5> kFingerFigures{{
    {"peak_force", "force_unit", 1.0, 2, [](const Json& f) { return number_at(f, "peak_force_N"); }},
    {"mean_force", "force_unit", 1.0, 2, [](const Json& f) { return number_at(f, "mean_force_N"); }},
    {"bending", "bending_unit", 90.0, 0, bending_deg},
    {"speed", "speed_unit", 60.0, 0, [](const Json& f) { return kDegrees * number_at(f, "mean_speed_rad_per_s"); }},
    {"fractionation", "fractionation_unit", 1.0, 2, [](const Json& f) { return number_at(f, "fractionation"); }},
}};

// Returns the figure of a run's finger; NaN where the run has none.
double figure_of(const KeptRun& run, std::string_view finger, const FingerFigure& figure) {
    for (const Json& one : run.report.at("fingers"))
        if (text_of(one, "finger") == finger) return figure.of(one);
    return std::nan("");
}

// A plot over the days since the first run, from zero to at least `highest`: so that what hardly changes looks so.
plot::Plot over_days(const PageTexts& texts, const std::string& unit, double highest) {
    plot::Plot made;
    made.x_label = texts.text("day");
    made.y_label = unit;
    made.x_linear = made.y_linear = made.x_whole = true;
    made.y_highest = highest;
    made.decimal = texts.text("decimal");
    return made;
}

std::string figures_of(const Runs& runs, const PageTexts& texts) {
    const int first_day = day_of(runs.front()->date);
    const auto day = [&](const KeptRun* run) { return static_cast<double>(day_of(run->date) - first_day); };
    std::string html = "<div class=\"plots\">\n";
    plot::Plot scores = over_days(texts, texts.text("score_unit"), 100.0);
    std::map<double, std::size_t> levels;
    for (const KeptRun* run : runs) {
        const double level = number_at(run->report.at("settings"), "level");
        const auto [place, is_new] = levels.try_emplace(std::isfinite(level) ? level : 0.0, scores.series.size());
        if (is_new)
            scores.series.push_back({texts.filled("level", {{"level", texts.number(place->first, 0)}}), {}, 0.0});
        scores.series[place->second].points.push_back({day(run), number_at(run->report, "score"), ""});
    }
    html += plot::svg_figure(texts.text("score"), {scores});
    for (const FingerFigure& figure : kFingerFigures) {
        plot::Plot made = over_days(texts, texts.text(figure.unit), figure.highest);
        for (std::size_t i = 0; i < kFingerNames.size(); ++i) {
            plot::PlotSeries series{
                texts.text(kFingerNames[i]), {}, 0.0, {}, i};  // a finger's colour is the same in all
            for (const KeptRun* run : runs)
                if (const double value = figure_of(*run, kFingerNames[i], figure); std::isfinite(value))
                    series.points.push_back({day(run), value, ""});
            if (!series.points.empty()) made.series.push_back(std::move(series));
        }
        if (!made.series.empty()) html += plot::svg_figure(texts.text(figure.title), {made});
    }
    return html + "</div>\n";
}

std::string head_of(const PageTexts& texts, std::initializer_list<const char*> keys) {
    std::string html = "<tr>";
    for (const char* key : keys) html += "<th>" + plot::escaped(texts.text(key)) + "</th>";
    return html + "</tr>\n";
}

std::string table(const std::string& rows) { return "<div class=\"wide\"><table>\n" + rows + "</table></div>\n"; }

// ---- How much was done

std::string iso_date(int day) {
    const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(day))};
    return formatted("%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

// Returns the Monday of a day's week; 1970-01-01, day 0, was a Thursday.
int monday_of(int day) { return day - ((day + 3) % 7 + 7) % 7; }

// Returns how often a run did what its exercise repeats: squeezes, kneads or catches; else 0.
double repetitions_of(const KeptRun& run) {
    const Json& counts = run.report.at("counts");
    for (const char* key : {"repetitions", "kneads", "catches"})
        if (const double number = number_at(counts, key); std::isfinite(number)) return number;
    return 0.0;
}

std::string dose_of(const Runs& runs, const PageTexts& texts) {
    struct Week {
        std::set<int> days;
        double seconds = 0.0, repetitions = 0.0;
    };
    std::map<int, Week> weeks;
    for (const KeptRun* run : runs) {
        Week& week = weeks[monday_of(day_of(run->date))];
        week.days.insert(day_of(run->date));
        week.seconds += number_at(run->report, "time_s");
        week.repetitions += repetitions_of(*run);
    }
    std::string rows = head_of(texts, {"week_from", "visits", "minutes", "repetitions"});
    for (int monday = weeks.begin()->first; monday <= weeks.rbegin()->first; monday += 7) {  // a week without is told
        const Week& week = weeks[monday];
        rows += "<tr>" + cell(texts.date(iso_date(monday))) + number_cell(std::to_string(week.days.size())) +
                number_cell(texts.number(week.seconds / 60.0, 1)) + number_cell(texts.number(week.repetitions, 0)) +
                "</tr>\n";
    }
    return element("h3", texts.text("dose")) + table(rows);
}

// ---- How measures have changed

// A row of one measure; nothing where the runs have too little of it.
std::string change_row(const std::string& name, const Runs& runs, const PageTexts& texts, int decimals,
                       const std::function<double(const KeptRun&)>& figure) {
    std::vector<std::pair<double, double>> points;
    for (const KeptRun* run : runs)
        if (const double value = figure(*run); std::isfinite(value))
            points.emplace_back(day_of(run->date) / kDaysOfWeek, value);
    const auto fit = line_through(points);
    if (!fit) return "";
    const auto number = [&](double value) { return texts.number(value, decimals); };
    // A change is told one decimal finer than what changes. One that is told as zero is none.
    const auto change = [&](double value) { return texts.number(value, decimals + 1); };
    const bool is_told = change(fit->slope) != change(0.0);
    return "<tr>" + cell(name) + number_cell(number(points.front().second)) +
           number_cell(number(points.back().second)) +
           number_cell((is_told && fit->slope > 0.0 ? "+" : "") + change(fit->slope)) +
           number_cell(change(fit->lowest) + " \xE2\x80\xA6 " + change(fit->highest)) +
           cell(texts.text(is_told && fit->is_beyond_scatter() ? "yes" : "no")) + "</tr>\n";
}

std::string change_of(const Runs& all, const PageTexts& texts) {
    const std::string title = element("h3", texts.text("change"));
    const Runs runs = alike(all);
    const std::string count = std::to_string(runs.size());
    std::string rows = change_row(texts.text("score"), runs, texts, 0,
                                  [](const KeptRun& run) { return number_at(run.report, "score"); });
    if (rows.empty()) return title + element("p", texts.filled("change_few", {{"runs", count}}));
    for (const FingerFigure& figure : kFingerFigures)
        for (const char* finger : kFingerNames)
            rows += change_row(texts.text(figure.title) + ", " + texts.text(finger), runs, texts, figure.decimals,
                               [&](const KeptRun& run) { return figure_of(run, finger, figure); });
    return title + table(head_of(texts, {"measure", "baseline", "last", "per_week", "interval", "beyond"}) + rows) +
           element("p", texts.filled("baseline_note", {{"date", texts.date(runs.front()->date)}})) +
           element("p", texts.filled("change_note", {{"runs", count}, {"freedom", std::to_string(runs.size() - 2)}}));
}

// ---- All runs

std::string settings_text(const Json& settings) {
    std::string text;
    for (const auto& [key, value] : settings.items())
        text += (text.empty() ? "" : ", ") + key + " " +
                (value.is_string()   ? value.get<std::string>()
                 : value.is_number() ? formatted("%g", value.get<double>())
                                     : "?");
    return text;
}

std::string counts_text(const Json& counts, const PageTexts& texts) {
    std::string text;
    for (const auto& [key, value] : counts.items())
        if (value.is_number())
            text += (text.empty() ? "" : ", ") + texts.number(value.get<double>(), 0) + " " +
                    (texts.has("count_" + key) ? texts.text("count_" + key) : key);
    return text;
}

// Returns the highest of each finger's forces; a dash where nothing is known.
std::string forces_of(const Json& report, const char* key, const PageTexts& texts) {
    std::string text;
    for (const Json& finger : report.at("fingers"))
        text += (text.empty() ? "" : "; ") + texts.number(number_at(finger, key), 2);
    return text;
}

std::string ended_key(const std::string& ended) {
    std::string key = ended;
    std::ranges::replace(key, ' ', '_');
    return key;
}

std::string table_of(const Runs& runs, const PageTexts& texts) {
    std::string rows = head_of(texts, {"date_head", "time_head", "hand", "settings", "ended", "score", "counted",
                                       "seconds", "asked", "given", "comment"});
    for (const KeptRun* run : runs) {
        const Json& report = run->report;
        rows +=
            "<tr>" + cell(texts.date(run->date)) + cell(run->time) + cell(run->hand) +
            cell(settings_text(report.at("settings"))) +
            cell(texts.named(ended_key(report.at("ended").get<std::string>()))) +
            number_cell(texts.number(number_at(report, "score"), 0)) + cell(counts_text(report.at("counts"), texts)) +
            number_cell(texts.number(number_at(report, "time_s"), 1)) + cell(forces_of(report, "peak_force_N", texts)) +
            cell(forces_of(report, "peak_measured_N", texts)) + cell(text_of(report, "comment")) + "</tr>\n";
    }
    return element("h3", texts.text("all_runs")) + table(rows);
}

// ---- The page

std::string proposal_text(const Proposal& proposal, const PageTexts& texts) {
    std::string scores;
    for (const double score : proposal.scores) scores += (scores.empty() ? "" : "; ") + texts.number(score, 0);
    const std::string stays = std::to_string(proposal.stays);
    switch (proposal.why) {
        case Proposal::Why::up:
            return texts.filled("proposal_up", {{"level", std::to_string(proposal.level)}, {"scores", scores}});
        case Proposal::Why::scores: return texts.filled("proposal_scores", {{"level", stays}, {"scores", scores}});
        case Proposal::Why::few:
            return texts.filled("proposal_few", {{"level", stays}, {"runs", std::to_string(proposal.ended)}});
        case Proposal::Why::differ: return texts.filled("proposal_differ", {{"level", stays}});
        case Proposal::Why::none: break;
    }
    return texts.text("proposal_none");
}

std::string section_of(const std::string& exercise, const Runs& runs, LevelsOf levels, const PageTexts& texts) {
    const KeptRun& last = *runs.back();
    std::string html = element("h2", texts.named(exercise));
    html += element("p", texts.filled("section", {{"runs", std::to_string(runs.size())},
                                                  {"last", texts.date(last.date)},
                                                  {"score", texts.number(number_at(last.report, "score"), 0)}}));
    html += element("p", texts.filled("side", {{"side", texts.named(side_of(last))}}));
    const auto scripted = std::ranges::count_if(runs, &KeptRun::is_scripted);
    if (scripted > 0)
        html += "<p class=\"warning\">" +
                plot::escaped(texts.filled("scripted", {{"count", std::to_string(scripted)}})) + "</p>\n";
    if (const unsigned known = levels(exercise); known > 0)
        html += element("p", proposal_text(proposed(runs, known), texts) + " " + texts.text("settings_stay"));
    if (exercise == "assess") html += baseline_table(runs, texts);
    return html + figures_of(runs, texts) + dose_of(runs, texts) + change_of(runs, texts) + table_of(runs, texts);
}

std::map<std::string, Runs> by_exercise(std::span<const KeptRun* const> runs) {
    std::map<std::string, Runs> sections;  // a hand's of its own: left and right are not one line
    for (const KeptRun* run : runs)
        sections[run->report.at("exercise").get<std::string>() + "/" + side_of(*run)].push_back(run);
    return sections;
}

// A cell of CSV, in quotation marks where it needs them.
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csv_number(double value) { return std::isfinite(value) ? formatted("%.10g", value) : ""; }

}  // namespace

std::string language_of(std::span<const KeptRun* const> runs) {
    for (std::size_t i = runs.size(); i-- > 0;)
        if (std::string language = text_of(runs[i]->report, "language"); !language.empty()) return language;
    return PageTexts::kUsual;
}

std::string patient_page(std::span<const KeptRun* const> runs, LevelsOf levels, const PageTexts& texts,
                         const std::string& program) {
    const std::string title = texts.filled("title", {{"participant", std::to_string(runs.front()->participant)}});
    std::set<std::string> days;
    for (const KeptRun* run : runs) days.insert(run->date);
    std::string html = plot::page_begin(title, texts.code(), kLarge) + element("h1", title);
    html += element("p", texts.filled("summary", {{"runs", std::to_string(runs.size())},
                                                  {"days", std::to_string(days.size())},
                                                  {"first", texts.date(runs.front()->date)},
                                                  {"last", texts.date(runs.back()->date)}}));
    for (const auto& [of, own] : by_exercise(runs)) html += section_of(of.substr(0, of.find('/')), own, levels, texts);
    html += element("p", texts.text("forces_note") + " " + texts.filled("made_by", {{"program", program}}));
    return html + plot::page_end();
}

std::string patient_table(std::span<const KeptRun* const> runs) {
    std::string csv = "date,time,hand,side,exercise,level,ended,score,time_s,repetitions,comment";
    for (const char* finger : kFingerNames)
        for (const char* column :
             {"asked_peak_N", "given_peak_N", "asked_mean_N", "bending_deg", "speed_deg_per_s", "fractionation"})
            csv += "," + std::string(finger) + "_" + column;
    csv += "\r\n";
    for (const KeptRun* run : runs) {
        const Json& report = run->report;
        std::vector<std::string> cells{run->date,
                                       run->time,
                                       run->hand,
                                       side_of(*run),
                                       text_of(report, "exercise"),
                                       csv_number(number_at(report.at("settings"), "level")),
                                       text_of(report, "ended"),
                                       csv_number(number_at(report, "score")),
                                       csv_number(number_at(report, "time_s")),
                                       csv_number(repetitions_of(*run)),
                                       text_of(report, "comment")};
        static constexpr FingerFigure kGiven{"", "", 1.0, 2,
                                             [](const Json& f) { return number_at(f, "peak_measured_N"); }};
        for (const char* finger : kFingerNames) {
            cells.push_back(csv_number(figure_of(*run, finger, kFingerFigures[0])));
            cells.push_back(csv_number(figure_of(*run, finger, kGiven)));
            for (std::size_t i = 1; i < kFingerFigures.size(); ++i)
                cells.push_back(csv_number(figure_of(*run, finger, kFingerFigures.at(i))));
        }
        for (std::size_t i = 0; i < cells.size(); ++i) csv += (i > 0 ? "," : "") + csv_cell(cells[i]);
        csv += "\r\n";
    }
    return csv;
}

std::string index_page(const KeptRuns& kept, const Withdrawals& withdrawn, const std::string& program,
                       std::string (*page_of)(unsigned participant)) {
    std::map<unsigned, Runs> people;
    for (const KeptRun& run : kept.runs)
        if (!has_withdrawn(withdrawn, run.participant)) people[run.participant].push_back(&run);
    std::string html = plot::page_begin("Participants of exercises", "en", kLarge) +
                       element("h1", "Participants of exercises") + element("p", "Made by " + program + ".");
    for (const Error& error : kept.errors)
        html += "<p class=\"warning\">Left out: " + plot::escaped(error.line()) + "</p>\n";
    std::string rows = "<tr><th>participant</th><th>runs</th><th>last</th></tr>\n";
    for (const auto& [participant, runs] : people)
        rows += "<tr><td><a href=\"" + plot::escaped(page_of(participant)) + "\">" +
                plot::escaped(formatted("Participant %u", participant)) + "</a></td>" +
                number_cell(std::to_string(runs.size())) + cell(runs.back()->date) + "</tr>\n";
    html += people.empty() ? element("p", "There are no runs.") : table(rows);
    return html + plot::page_end();
}

}  // namespace burin::activities

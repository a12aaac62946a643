// SPDX-License-Identifier: MIT
// Fills the screens of an exercise: the person's with forces against what is asked, the therapist's with measures,
// settings and the device's state.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "activities/rehab/rehab.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

using session::ActivityPanel;

constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;
constexpr std::uint32_t kTogether_srgb = 0xd0d4d8;

// Rounds what is drawn, so that what changes by less is drawn no more.
double drawn_N(double force_N) { return std::round(50.0 * force_N) / 50.0; }

ActivityPanel::Task::Bar bar_of(std::string name, double asked_N, std::optional<double> given_N) {
    ActivityPanel::Task::Bar bar;
    bar.name = std::move(name);
    bar.asked_N = drawn_N(asked_N);
    if (given_N) bar.given_N = drawn_N(*given_N);
    return bar;
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

// A bar of each finger that presses, and one of them all.
std::vector<ActivityPanel::Task::Bar> bars_of(const ExerciseGoal& goal, const WhichFingers& presses,
                                              const FingersTurn& shown) {
    std::vector<ActivityPanel::Task::Bar> bars;
    if (!(goal.together_N > 0.0)) return bars;
    double asked_N = 0.0, given_N = 0.0;
    bool measures = true;
    for (std::size_t i = 0; i < presses.size(); ++i) {
        if (!presses[i]) continue;
        bars.push_back(bar_of(kFingerNames[i], shown.forces_N[i], shown.measured_N[i]));
        bars.back().target_N = goal.of_each_N;
        bars.back().full_N = std::max({0.5 * goal.together_N, 2.0 * goal.of_each_N, 0.5});
        bars.back().colour_srgb = kFingerColours_srgb[i];
        asked_N += shown.forces_N[i];
        given_N += shown.measured_N[i].value_or(0.0);
        measures = measures && shown.measured_N[i].has_value();
    }
    bars.push_back(bar_of("together", asked_N, measures ? std::optional(given_N) : std::nullopt));
    bars.back().target_N = goal.together_N;
    bars.back().full_N = 1.5 * goal.together_N;
    bars.back().colour_srgb = kTogether_srgb;
    return bars;
}

ActivityPanel::Table measures_table(const HandMeasures& measures) {
    ActivityPanel::Table table{
        "Measures so far", {"", "peak N", "given N", "mean N", "bent \xC2\xB0", "\xC2\xB0/s"}, {}};
    for (std::size_t i = 0; i < measures.fingers.size(); ++i) {
        const FingerMeasures& finger = measures.fingers[i];
        double bent_rad = 0.0;
        for (std::size_t joint = 1; joint < finger.least_rad.size(); ++joint) bent_rad += finger.range_rad(joint);
        table.rows.push_back({kFingerNames[i], formatted("%.2f", finger.peak_N),
                              finger.mean_measured_N() ? formatted("%.2f", finger.measured_peak_N) : "-",
                              formatted("%.2f", finger.mean_N()), formatted("%.0f", kDegreesOfRadian * bent_rad),
                              formatted("%.0f", kDegreesOfRadian * finger.mean_rad_per_s())});
    }
    return table;
}

ActivityPanel::Table device_table(const FingersTurn& shown) {
    ActivityPanel::Table table{"Device now", {"", "asked N", "given N", "other N", "state"}, {}};
    for (std::size_t i = 0; i < shown.forces_N.size(); ++i)
        table.rows.push_back({kFingerNames[i], formatted("%.1f", shown.forces_N[i]),
                              shown.measured_N[i] ? formatted("%.1f", *shown.measured_N[i]) : "-",
                              formatted("%.1f", shown.elsewhere_N[i]), shown.has_fault[i] ? "fault" : "sound"});
    return table;
}

ActivityPanel::Table settings_table(const SettingValues& values) {
    ActivityPanel::Table table{"Settings", {"", ""}, {}};
    for (std::size_t i = 0; i < values.kinds().size(); ++i) {
        const SettingKind& kind = values.kinds()[i];
        table.rows.push_back(
            {kind.key, kind.words.empty() ? formatted("%g", values.number(kind.key)) : values.text(i)});
    }
    return table;
}

}  // namespace

std::string Rehab::state_text() const {
    if (exercise_->end() != ExerciseEnd::not_yet) return "";
    if (start_.has_failed()) return "Broken off: " + failure();
    switch (control_.phase) {
        case RunPhase::ready: return "Ready: the time begins with Start";
        case RunPhase::paused: return "Paused: no force, no clock";
        case RunPhase::rests: return "Rest: no force, no clock";
        case RunPhase::settles: return "Let go of all, then it goes on";
        case RunPhase::stopped: return "Stopped";
        case RunPhase::runs: break;
    }
    return is_asking() ? "Press with each finger once: " + start_.missing() : "";
}

ActivityPanel::Task Rehab::task() const {
    const ExerciseGoal goal = exercise_->goal();
    ActivityPanel::Task task;
    task.state = state_text();
    task.next = goal.next;
    task.progress = goal.progress;
    task.bars = bars_of(goal, exercise_->pressing_fingers(), shown_);
    task.hold_s = goal.hold_s;
    task.held_s = std::round(50.0 * goal.held_s) / 50.0;
    return task;
}

std::vector<ActivityPanel::Table> Rehab::tables() const {
    const ExerciseCourse course = exercise_->course();
    const SettingValues& values = exercise_->settings();
    ActivityPanel::Table run{"Course", {"", ""}, {}};
    if (values.has("time_limit_s"))
        run.rows.push_back(
            {"remaining", formatted("%.0f s", std::max(values.number("time_limit_s") - course.time_s, 0.0))});
    run.rows.push_back({"score so far", formatted("%.0f of 100", course.score)});
    run.rows.push_back({"pauses", formatted("%u, %.0f s", control_.pauses, control_.paused_s)});
    run.rows.push_back({"rests", formatted("%u, %.0f s", control_.rests, control_.rested_s)});
    if (asks_) run.rows.push_back({"gave nothing at the start", start_.missing().empty() ? "none" : start_.missing()});
    if (fitted_.is_object()) run.rows.push_back({"fitted by", fitted_.at("text").get<std::string>()});
    return {std::move(run), measures_table(measures_), device_table(shown_), settings_table(values)};
}

std::vector<ActivityPanel::Button> Rehab::buttons() const {
    const bool over = exercise_->end() != ExerciseEnd::not_yet || start_.has_failed();
    const auto can = [&](RunOrder order) { return !over && control_.takes(order); };
    const bool begins = control_.phase == RunPhase::ready || is_asking() || control_.runs();
    return {{begins ? "Start" : "Go on",
             {"start"},
             can(RunOrder::start) || (!over && control_.runs() && is_asking()),
             {},
             session::Key::f5},
            {"Pause", {"pause"}, can(RunOrder::pause), {}, session::Key::f6},
            {"Rest", {"rest"}, can(RunOrder::rest), {}, session::Key::f7},
            {"Stop", {"stop"}, can(RunOrder::stop), {}, session::Key::f8}};
}

ActivityPanel Rehab::panel() const {
    const ExerciseCourse course = exercise_->course();
    ActivityPanel panel{.title = capital(exercise_->name()), .page = exercise_->task()};
    if (is_asking()) panel.page = "Press with each finger once, then the time begins: " + start_.missing();
    if (start_.has_failed()) panel.page = "Broken off: " + failure();
    for (const ExerciseCourse::Count& count : course.counts)
        if (count.wanted > 0)
            panel.widgets.push_back(ActivityPanel::Row{count.name, formatted("%u of %u", count.number, count.wanted)});
        else if (count.number > 0)
            panel.widgets.push_back(ActivityPanel::Row{count.name, formatted("%u", count.number)});
    const SettingValues& values = exercise_->settings();
    panel.widgets.push_back(ActivityPanel::Row{
        "Time", values.has("time_limit_s") ? formatted("%.0f of %.0f s", course.time_s, values.number("time_limit_s"))
                                           : formatted("%.0f s", course.time_s)});
    if (fitted_.is_object())
        panel.widgets.push_back(ActivityPanel::Row{"Fitted by", fitted_.at("text").get<std::string>()});
    if (course.end != ExerciseEnd::not_yet)
        panel.widgets.push_back(ActivityPanel::Row{"Score", formatted("%.0f of 100", course.score)});
    panel.add(buttons());
    panel.hides_scene = true;
    panel.task = task();
    panel.tables = tables();
    panel.help = exercise_->help();
    panel.help.insert(panel.help.begin(), exercise_->task());
    return panel;
}

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
// Writes the report of a run, the part of it that is kept while the run goes on, and the range that the hand showed.
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "activities/rehab/rehab.hpp"

namespace burin::activities {
namespace {

// pressed: whether it gave a force when the start asked for one; nothing where it did not ask.
Json json_of(const FingerMeasures& finger, const char* name, std::optional<bool> pressed) {
    Json ranges = Json::array();
    for (std::size_t joint = 0; joint < finger.least_rad.size(); ++joint) ranges.push_back(finger.range_rad(joint));
    const std::optional<double> fractionation = finger.fractionation(), measured = finger.mean_measured_N();
    return {{"finger", name},
            {"pressed_at_start", pressed ? Json(*pressed) : Json()},
            {"peak_force_N", finger.peak_N},
            {"mean_force_N", finger.mean_N()},
            {"peak_measured_N", measured ? Json(finger.measured_peak_N) : Json()},
            {"mean_measured_N", measured ? Json(*measured) : Json()},
            {"peak_elsewhere_N", finger.elsewhere_peak_N},
            {"pushed_s", finger.pushed_s},
            {"range_of_motion_rad", std::move(ranges)},
            {"peak_speed_rad_per_s", finger.peak_rad_per_s},
            {"mean_speed_rad_per_s", finger.mean_rad_per_s()},
            {"fractionation", fractionation ? Json(*fractionation) : Json()}};
}

// Returns the events from one of that number on.
Json json_of(const ExerciseCourse& course, std::size_t from) {
    Json events = Json::array();
    for (const ExerciseEvent& event : std::span(course.events).subspan(from))
        events.push_back(
            {{"what", event.what}, {"time_s", seconds(event.time_ns - course.begun_ns)}, {"force_N", event.force_N}});
    return events;
}

}  // namespace

Json Rehab::report() const {
    const ExerciseCourse course = exercise_->course();
    const SettingValues& values = exercise_->settings();
    Json settings = Json::object(), counts = Json::object(), fingers = Json::array();
    for (const SettingKind& kind : values.kinds())
        if (kind.words.empty())
            settings[kind.key] = values.number(kind.key);
        else
            settings[kind.key] = values.word(kind.key);
    for (const ExerciseCourse::Count& count : course.counts) counts[count.key] = count.number;
    for (std::size_t i = 0; i < kFingerNames.size(); ++i)
        fingers.push_back(json_of(measures_.fingers[i], kFingerNames[i],
                                  start_.asks[i] ? std::optional(start_.gave[i]) : std::nullopt));
    const std::string why = failure();
    Json report{{"exercise", exercise_->name()},
                {"settings", std::move(settings)},
                {"young_Pa", body_ ? Json(body_->setup().material.young_Pa) : Json()},
                {"held_N_per_m", body_ ? Json(body_->setup().held_N_per_m) : Json()},
                {"ended", text_of(course.end)},
                {"broken_off_because", why.empty() ? Json() : Json(why)},
                {"pauses", control_.pauses},
                {"paused_s", control_.paused_s},
                {"rests", control_.rests},
                {"rested_s", control_.rested_s},
                {"score", course.score},
                {"time_s", course.time_s},
                {"counts", std::move(counts)},
                {"notes", course.notes},
                {"person_range", exercise_->person_range().value_or(person_range())},
                {"rejected_sets", hand_.rejected_sets()},
                {"fingers", std::move(fingers)},
                {"events", json_of(course, 0)}};
    if (const Json found = exercise_->findings(); !found.is_null()) report[exercise_->name()] = found;
    if (!fitted_.is_null()) report["fitted_by"] = fitted_;
    report.update(told_);
    return report;
}

void Rehab::tell_keeper(session::ActivityOrders& orders) {
    if (!keeper_ || turn_ns_ == 0) return;
    const ExerciseCourse course = exercise_->course();
    const bool is_new = course.events.size() > kept_;
    const bool goes_on = course.end == ExerciseEnd::not_yet;
    const Nanoseconds since_ns = turn_ns_ - told_keeper_ns_;
    const bool due = keeper_fails_ ? since_ns >= kTriesAgain_ns : is_new || (goes_on && since_ns >= kTells_ns);
    if (!due) return;
    told_keeper_ns_ = turn_ns_;
    const Result<void> kept = keeper_(report(), json_of(course, kept_));
    if (kept)
        kept_ = course.events.size();
    else if (!keeper_fails_)
        orders.messages.push_back("the run is not kept as it goes: " + kept.error().line());
    keeper_fails_ = !kept;
}

// Returns what the hand has shown, as the next run takes it for settings; nothing of a finger that was not read.
Json Rehab::person_range() const {
    double open = 0.0, closed = 0.0;
    std::string never_free, stopped;
    const auto name = [](std::string& names, std::size_t i) {
        names += (names.empty() ? "" : ", ") + std::string(kFingerNames[i]);
    };
    for (std::size_t i = 0; i < kFelt; ++i) {
        const FingerMeasures& finger = measures_.fingers[i];
        const auto of = static_cast<geometry::Finger>(i);
        for (std::size_t joint = 0; joint < finger.least_rad.size(); ++joint)
            if (!(finger.most_rad[joint] >= finger.least_rad[joint])) return {};
        if (!finger.was_free()) {
            name(never_free, i);
            continue;
        }
        open += finger.open_closure(of) / kFelt;
        closed += finger.closed_closure(of) / kFelt;
        if (!finger.closed_freely(of)) name(stopped, i);
    }
    Json range{{"most_N", most_together_N_}};
    // One end alone fits nothing: both are the way by which closures are told.
    if (!never_free.empty()) {
        range["way_left_out"] = "pushed all the time: " + never_free;
    } else if (!stopped.empty()) {
        range["way_left_out"] =
            "stopped where it closed farthest: " + stopped + "; close the hand once with nothing in it";
    } else {
        range["open"] = open;
        range["closed"] = closed;
    }
    return range;
}

}  // namespace burin::activities

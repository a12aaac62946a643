// SPDX-License-Identifier: MIT
#include "activities/rehab/assess/scripted_fingers.hpp"

#include <algorithm>

#include "activities/rehab/assess/assessment.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

using Closed = std::array<double, devices::kGloveFingers>;
using CourseRows = std::vector<devices::FingerCourse::Row>;

constexpr double kMargin_s = 0.3;  // after a part's begin and before its end, in which nothing moves
constexpr double kSlow_s = 1.5, kStrokeRests_s = 0.5;
constexpr double kHalf = 0.5;  // closed, before a press

Closed all_closed(double share) {
    Closed closed;
    closed.fill(share);
    return closed;
}

// Adds strokes from open to `end` and back, as many as there is room for until a time.
void add_strokes(CourseRows& rows, double from_s, double until_s, const Closed& end, double stroke_s, double rest_s) {
    const double cycle_s = 2.0 * (stroke_s + rest_s);
    rows.push_back({from_s, {}});
    for (double at_s = from_s; at_s + cycle_s <= until_s + 1e-9; at_s += cycle_s) {
        rows.push_back({at_s + stroke_s, end});
        if (rest_s > 0.0) rows.push_back({at_s + stroke_s + rest_s, end});
        rows.push_back({at_s + 2.0 * stroke_s + rest_s, {}});
        if (rest_s > 0.0) rows.push_back({at_s + cycle_s, {}});
    }
}

}  // namespace

AssessedHand assessed_hand(SimulatedPerson person) {
    if (person == SimulatedPerson::healthy) return {};
    return {.closes = 0.5, .others_follow = 0.4, .stroke_s = 0.5, .holds_N = {1.5, 0.0, 1.2, 0.8}};
}

devices::FingerCourse assess_course_of(const AssessedHand& hand) {
    devices::FingerCourse course;
    course.holds_N = hand.holds_N;
    course.rows.push_back({0.0, {}});
    for (std::size_t i = 0; i < kAssessParts; ++i) {
        const AssessPart& part = assess_parts()[i];
        const double begins_s = assess_begins_s(i), from_s = begins_s + kMargin_s,
                     until_s = begins_s + part.lasts_s - kMargin_s;
        switch (part.task) {
            case AssessTask::range:
                add_strokes(course.rows, from_s, until_s, all_closed(hand.closes), kSlow_s, kStrokeRests_s);
                break;
            case AssessTask::speed:
                add_strokes(course.rows, from_s, until_s, all_closed(hand.closes), hand.stroke_s, 0.0);
                break;
            case AssessTask::alone: {
                Closed end = all_closed(hand.others_follow * hand.closes);
                end[part.finger] = hand.closes;
                add_strokes(course.rows, from_s, until_s, end, 2.0 * hand.stroke_s, 0.0);
                break;
            }
            case AssessTask::press:
                course.rows.push_back({begins_s - kReads_s + kMargin_s, {}});
                course.rows.push_back({begins_s - kMargin_s, all_closed(kHalf * hand.closes)});
                course.rows.push_back({from_s, all_closed(kHalf * hand.closes)});
                course.rows.push_back({from_s + 1.0, all_closed(hand.closes)});
                course.rows.push_back({until_s, all_closed(hand.closes)});
                course.rows.push_back({begins_s + part.lasts_s, {}});
                break;
        }
    }
    return course;
}

std::string assess_course(SimulatedPerson person) {
    return devices::finger_course_text(assess_course_of(assessed_hand(person)));
}

std::string scripted_assess(const SettingValues& /*values*/, std::uint64_t /*seed*/, std::string_view script) {
    std::string text(script.substr(0, script.find('\n')));
    text += "\n0.100 command toggle-panel\n0.500 command force on\n";
    for (const std::size_t part : {std::size_t{0}, std::size_t{1}, std::size_t{6}})
        text += formatted("%.3f command screenshot %s.png\n", assess_begins_s(part) + 2.0,
                          part == 0   ? "range"
                          : part == 1 ? "press"
                                      : "alone");
    return text + formatted("%.3f command quit\n", assess_begins_s(kAssessParts) + 0.5);
}

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
#include "devices/gloves/finger_course.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/text.hpp"

namespace burin::devices {
namespace {

constexpr const char* kCourseHeader = "burin-fingers 1";
constexpr const char* kCourseHolds = "holds_N";

}  // namespace

std::array<double, kGloveFingers> FingerCourse::closed_at(double time_s) const {
    const auto next = std::ranges::upper_bound(rows, time_s, {}, &Row::time_s);
    if (next == rows.begin()) return rows.front().closed;
    if (next == rows.end()) return rows.back().closed;
    const Row &from = *std::prev(next), &to = *next;
    const double share = (time_s - from.time_s) / (to.time_s - from.time_s);
    std::array<double, kGloveFingers> closed{};
    for (std::size_t i = 0; i < closed.size(); ++i)
        closed[i] = from.closed[i] + share * (to.closed[i] - from.closed[i]);
    return closed;
}

Result<FingerCourse> parse_finger_course(std::string_view text, const std::string& name) {
    FingerCourse course;
    std::istringstream lines{std::string(text)};
    std::string line;
    std::size_t number = 0;
    const auto wrong = [&](const std::string& what, const char* remedy) {
        return fail(formatted("%s, line %zu", name.c_str(), number), what, remedy);
    };
    while (std::getline(lines, line)) {
        ++number;
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        if (number == 1) {
            if (line.starts_with(kCourseHeader)) continue;
            return wrong("is no course of fingers", "begin it with: burin-fingers 1");
        }
        std::istringstream words(line);
        double time_s = 0.0;
        const bool holds = line.starts_with(kCourseHolds);
        std::string word;
        if (holds)
            words >> word;
        else
            words >> time_s;
        std::array<double, kGloveFingers> values{};
        for (double& value : values) words >> value;
        const auto is_sound = [](double value) { return value >= 0.0 && value <= 40.0; };
        if (!words || words >> word || !std::ranges::all_of(values, is_sound))
            return wrong("is no row of a time and four fingers", "write SECONDS THUMB INDEX MIDDLE RING");
        if (holds) {
            course.holds_N = values;
            continue;
        }
        if (!std::isfinite(time_s) || (!course.rows.empty() && time_s <= course.rows.back().time_s))
            return wrong("does not come after the row before it", "have the times rise");
        if (std::ranges::any_of(values, [](double closed) { return closed > 1.0; }))
            return wrong("closes a finger by more than 1", "write 0, open, to 1, a grasp");
        course.rows.push_back({time_s, values});
    }
    if (course.rows.empty()) return fail(name, "has no row", "write SECONDS THUMB INDEX MIDDLE RING, one a line");
    return course;
}

std::string finger_course_text(const FingerCourse& course) {
    std::string text = std::string(kCourseHeader) + "\n" + kCourseHolds;
    for (const double force_N : course.holds_N) text += formatted(" %.17g", force_N);
    for (const FingerCourse::Row& row : course.rows) {
        text += formatted("\n%.6f", row.time_s);
        for (const double closed : row.closed) text += formatted(" %.17g", closed);
    }
    return text + "\n";
}

Grip stepped(Grip grip, const FingerCourse& course, double at_s, const GloveForces& pushed_N, double time_s) {
    const auto towards = course.closed_at(at_s);
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        double way = std::clamp(towards[i] - grip.closed[i], -FingerCourse::kFree_per_s * time_s,
                                FingerCourse::kFree_per_s * time_s);
        if (pushed_N[i] > FingerCourse::kPushed_N) {
            const double holds_N = course.holds_N[i];
            const double slowed = holds_N > 0.0 ? std::max(1.0 - pushed_N[i] / holds_N, -1.0) : -1.0;
            way = std::min(way, slowed * FingerCourse::kPushed_per_s * time_s);
        }
        grip.closed[i] = std::clamp(grip.closed[i] + way, 0.0, 1.0);
    }
    return grip;
}

}  // namespace burin::devices

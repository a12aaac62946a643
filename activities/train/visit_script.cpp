// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>

#include "activities/train/scripted_visit.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

constexpr double kLongestVisit_s = 24.0 * 3600.0;
constexpr const char* kScriptHead = "burin-study-input 1";

std::string_view trimmed_line(std::string_view line) {
    line = line.substr(0, line.find('#'));
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t' || line.back() == '\r')) line.remove_suffix(1);
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    return line;
}

// Takes a finite number off the front.
std::optional<double> take_number(std::string_view& text) {
    text = trimmed_line(text);
    double value = 0.0;
    const auto [after, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(after - text.data()));
    return value;
}

std::optional<devices::HandPose> pose_in(std::string_view text, double time_s) {
    std::vector<double> numbers;
    while (const auto number = take_number(text)) numbers.push_back(*number);
    if (!trimmed_line(text).empty() || (numbers.size() != 3 && numbers.size() != 7)) return std::nullopt;
    devices::HandPose pose;
    pose.time_s = time_s;
    pose.position_device_m = {numbers[0], numbers[1], numbers[2]};
    if (numbers.size() == 7) pose.orientation_device = {numbers[6], numbers[3], numbers[4], numbers[5]};
    return pose;
}

}  // namespace

Result<VisitScript> parse_visit_script(const std::string& text, const std::string& name) {
    VisitScript script;
    std::size_t line_number = 0;
    bool has_head = false;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view line = trimmed_line(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::string where = name + ":" + std::to_string(++line_number);
        if (line.empty()) continue;
        if (!has_head) {
            if (line != kScriptHead)
                return fail(where, "is no script of a visit",
                            std::string("begin it with ") + kScriptHead +
                                "; a written log of a session begins with burin-input 1");
            has_head = true;
            continue;
        }
        const auto time_s = take_number(line);
        if (!time_s || *time_s < script.end_s || *time_s > kLongestVisit_s)
            return fail(where, "begins with no time that rises",
                        "write seconds since the visit's beginning, up to a day");
        script.end_s = *time_s;
        line = trimmed_line(line);
        if (line.starts_with("hand ")) {
            const auto pose = pose_in(line.substr(5), *time_s);
            if (!pose)
                return fail(where, "has no place of a hand", "write TIME hand X Y Z, or X Y Z QX QY QZ QW, in metres");
            script.hand.push_back(*pose);
            continue;
        }
        auto command = operator_command(line);
        if (!command) return fail(where, command.error().what, command.error().remedy + ", or hand X Y Z");
        script.said.push_back({*time_s, std::move(*command), where, std::string(line)});
    }
    if (script.hand.empty()) return fail(name, "has no hand in it", "write at least one line TIME hand X Y Z");
    return script;
}

}  // namespace burin::activities

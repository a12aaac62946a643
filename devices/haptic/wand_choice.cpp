// SPDX-License-Identifier: MIT
#include "devices/haptic/wand_choice.hpp"

#include <algorithm>
#include <charconv>

#include "base/text.hpp"

namespace burin::devices {
namespace {

// Returns so many points evenly from one to another; one alone is in the middle.
std::vector<WandPoint> points_between(const Vec3& from_m, const Vec3& to_m, std::size_t count) {
    std::vector<WandPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.5;
        points.push_back({"point " + std::to_string(i + 1), from_m + t * (to_m - from_m)});
    }
    return points;
}

}  // namespace

Result<std::vector<WandPoint>> points_named(const WandDescription& wand, const std::string& text) {
    constexpr const char* kWhere = "--points";
    std::size_t count = 0;
    if (!text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; })) {
        const auto read = std::from_chars(text.data(), text.data() + text.size(), count);
        if (read.ec != std::errc() || text.front() == '0' || count > kMostWandPoints)
            return fail(kWhere, "is " + text, formatted("write a number from 1 to %zu", kMostWandPoints));
        if (wand.points.empty()) return fail(kWhere, "the wand's description names no points", "give it [[point]]");
        return points_between(wand.points.front().offset_m, wand.points.back().offset_m, count);
    }
    std::vector<std::string_view> known{"centre"};
    for (const WandPoint& point : wand.points) known.push_back(point.name);
    std::vector<WandPoint> points;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        const std::string name = text.substr(at, comma - at);
        at = comma + 1;
        const auto found = std::ranges::find(wand.points, name, &WandPoint::name);
        if (found == wand.points.end() && name != "centre")
            return fail(kWhere, "the wand has no point named " + name,
                        "did you mean " + std::string(nearest_name(name, known)) + "? There are: " + joined(known) +
                            ", or a number of points");
        if (std::ranges::find(points, name, &WandPoint::name) != points.end())
            return fail(kWhere, "names " + name + " twice",
                        "name each point once: two in one place press twice as hard");
        points.push_back(found == wand.points.end() ? WandPoint{"centre", Vec3(0.0)} : *found);
    }
    if (points.size() > kMostWandPoints)
        return fail(kWhere, formatted("names %zu points", points.size()),
                    formatted("name at most %zu", kMostWandPoints));
    return points;
}

std::string usual_points(const WandDescription& wand) {
    const auto has = [&](const char* name) {
        return std::ranges::find(wand.points, name, &WandPoint::name) != wand.points.end();
    };
    if (has("top") && has("bottom")) return kUsualPoints;
    std::string names;
    for (const WandPoint& point : wand.points) names += (names.empty() ? "" : ",") + point.name;
    return names.empty() ? "centre" : names;
}

}  // namespace burin::devices

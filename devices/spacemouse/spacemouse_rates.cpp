// SPDX-License-Identifier: MIT
#include "devices/spacemouse/spacemouse_rates.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::devices {
namespace {

struct RateSetting {
    std::string_view key;
    double SpaceMouseSettings::* value;
    double least, most;
};
constexpr std::array kRateSettings{
    RateSetting{"speed", &SpaceMouseSettings::speed_m_per_s, 0.001, 10.0},
    RateSetting{"turn", &SpaceMouseSettings::turning_rad_per_s, 0.01, 10.0},
    RateSetting{"dead", &SpaceMouseSettings::dead_zone, 0.0, 0.9},
};
constexpr const char* kHowToWrite =
    "write a place as burin devices lists it, settings, or both with commas between them: "
    "hidraw3,speed=0.08,turn=1.2,dead=0.1";

Result<void> set(SpaceMouseSettings& settings, const std::string& where, const std::string& item) {
    const std::size_t equals = item.find('=');
    const std::string_view key = std::string_view(item).substr(0, equals);
    const auto one = std::ranges::find(kRateSettings, key, &RateSetting::key);
    if (one == kRateSettings.end()) {
        std::array<std::string_view, kRateSettings.size()> names;
        std::ranges::transform(kRateSettings, names.begin(), &RateSetting::key);
        return fail(where, "'" + item + "' says nothing that is known",
                    "the nearest is " + std::string(nearest_name(key, names)) + "=; " + kHowToWrite);
    }
    const std::string value(item.substr(equals + 1));
    double number = 0.0;
    const char* const end = value.data() + value.size();
    const auto [at, error] = std::from_chars(value.data(), end, number);
    if (error != std::errc{} || at != end || !(number >= one->least && number <= one->most))
        return fail(where, "'" + item + "' is no number of that setting",
                    formatted("write one from %g to %g", one->least, one->most));
    settings.*(one->value) = number;
    return {};
}

}  // namespace

Result<SpaceMouseSettings> spacemouse_settings(const std::string& where, const std::string& text,
                                               const SpaceMouseSettings& usual) {
    SpaceMouseSettings settings = usual;
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ',');) {
        if (item.contains('=')) {
            BURIN_TRY_DO(set(settings, where, item));
            continue;
        }
        std::string& named = item.ends_with(".toml") ? settings.file : settings.place;
        if (!named.empty() || item.empty())
            return fail(where,
                        item.empty() ? "has nothing on one side of a comma" : "names two: " + named + ", " + item,
                        kHowToWrite);
        named = item;
    }
    return settings;
}

Vec3 spacemouse_rate(const Vec3& deflection, double dead_zone, double most) noexcept {
    const double length = glm::length(deflection);
    if (!(length > dead_zone)) return Vec3(0.0);
    const double beyond = std::min((length - dead_zone) / (1.0 - dead_zone), 1.0);
    return most * beyond * beyond / length * deflection;
}

Quat turned(const Quat& orientation, const Vec3& rad_per_s, double dt_s) noexcept {
    const double angle = glm::length(rad_per_s) * dt_s;
    if (!(angle > 0.0)) return orientation;
    return glm::normalize(glm::angleAxis(angle, glm::normalize(rad_per_s)) * orientation);
}

}  // namespace burin::devices

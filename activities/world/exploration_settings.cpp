// SPDX-License-Identifier: MIT
#include "activities/world/exploration_settings.hpp"

#include <cmath>
#include <optional>

#include "base/json.hpp"
#include "haptics/tick.hpp"

namespace burin::activities {
namespace {

Json numbers_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

// Reads so many numbers, and notes where there are others.
class SettingsReader {
public:
    explicit SettingsReader(const Json& json) : json_(json) {}

    double number(const char* key) { return list(key, 1, false)[0]; }
    Vec3 vector(const char* key) {
        const auto v = list(key, 3, true);
        return {v[0], v[1], v[2]};
    }
    Quat turn(const char* key) {
        const auto q = list(key, 4, true);
        return {q[3], q[0], q[1], q[2]};
    }
    bool flag(const char* key) {
        const auto at = json_.is_object() ? json_.find(key) : json_.end();
        const bool sound = json_.is_object() && at != json_.end() && at->is_boolean();
        if (!sound && missing_.empty()) missing_ = key;
        return sound && at->get<bool>();
    }
    [[nodiscard]] const std::string& missing() const { return missing_; }

private:
    std::array<double, 4> list(const char* key, std::size_t count, bool is_list) {
        std::array<double, 4> values{};
        const auto at = json_.is_object() ? json_.find(key) : json_.end();
        bool sound = json_.is_object() && at != json_.end() && (is_list ? at->is_array() && at->size() == count : true);
        for (std::size_t i = 0; sound && i < count; ++i) {
            const Json& value = is_list ? (*at)[i] : *at;
            sound = value.is_number() && std::isfinite(value.get<double>());
            if (sound) values[i] = value.get<double>();
        }
        if (!sound && missing_.empty()) missing_ = key;
        return values;
    }

    const Json& json_;
    std::string missing_;
};

// The settings of the tick by their names: numbers, then flags. One list for writing and for reading.
template <typename Settings, typename Number, typename Flag>
void visit_tick(Settings& s, const Number& number, const Flag& flag) {
    number("clearance_ratio", s.clearance_ratio);
    number("position_noise_m", s.position_noise_m);
    number("max_surface_age_s", s.max_surface_age_s);
    number("max_force_N", s.limits.max_force_N);
    number("max_slew_N_per_s", s.limits.max_slew_N_per_s);
    number("contact_ramp_s", s.limits.contact_ramp_s);
    number("ramp_s", s.limits.ramp_s);
    number("recovery_s", s.limits.recovery_s);
    number("max_speed_m_per_s", s.limits.max_speed_m_per_s);
    number("max_sample_age_s", s.limits.max_sample_age_s);
    number("max_loop_gap_s", s.limits.max_loop_gap_s);
    number("max_ahead_s", s.limits.max_ahead_s);
    number("passivity_max_damping_Ns_per_m", s.passivity.max_damping_Ns_per_m);
    number("passivity_reserve_J", s.passivity.reserve_J);
    flag("passivity_control", s.passivity.control);
    flag("shading", s.shading);
    flag("limit_stiffness", s.limit_stiffness);
}

}  // namespace

haptics::TickParameters parameters_of(const ExplorationSettings& settings) {
    haptics::TickParameters parameters;
    parameters.workspace.object_from_device = settings.scene_from_device;
    parameters.probe = haptics::ball_probe(settings.tool_radius_m);
    parameters.action = haptics::ToolAction::touch;
    parameters.clearance_ratio = settings.clearance_ratio;
    parameters.position_noise_m = settings.position_noise_m;
    parameters.max_surface_age_s = settings.max_surface_age_s;
    parameters.shading = settings.shading;
    parameters.limit_stiffness = settings.limit_stiffness;
    parameters.limits = settings.limits;
    parameters.passivity = settings.passivity;
    return parameters;
}

std::string settings_text(const ExplorationSettings& settings) {
    const Similarity& map = settings.scene_from_device;
    Json json{{"tool_radius_m", settings.tool_radius_m},
              {"scene_from_device_m", numbers_of(map.position_m)},
              {"scene_from_device_qxyzw",
               Json::array({map.orientation.x, map.orientation.y, map.orientation.z, map.orientation.w})},
              {"scene_from_device_scale", map.scale},
              {"start_scene_m", numbers_of(settings.start_scene_m)},
              {"reach_m", settings.reach_m}};
    const auto put = [&](const char* key, auto value) { json[key] = value; };
    visit_tick(settings, put, put);
    return json.dump();
}

Result<ExplorationSettings> read_settings(const std::string& text, const std::string& where) {
    const Json json = Json::parse(text, nullptr, false);
    SettingsReader reader(json);
    ExplorationSettings settings;
    settings.tool_radius_m = reader.number("tool_radius_m");
    settings.scene_from_device = {reader.vector("scene_from_device_m"), reader.turn("scene_from_device_qxyzw"),
                                  reader.number("scene_from_device_scale")};
    settings.start_scene_m = reader.vector("start_scene_m");
    settings.reach_m = reader.number("reach_m");
    visit_tick(
        settings, [&](const char* key, double& to) { to = reader.number(key); },
        [&](const char* key, bool& to) { to = reader.flag(key); });
    const char* const remedy = "replay a recording that burin world --record has written";
    if (!reader.missing().empty())
        return fail(where, "its settings have no sound value for " + reader.missing(), remedy);
    if (!(settings.tool_radius_m > 0.0) || settings.tool_radius_m > 1.0 || !(settings.reach_m > 0.0) ||
        settings.reach_m > 1e6 || !haptics::is_felt_at(settings.scene_from_device.scale) ||
        !haptics::parameters_are_sensible(parameters_of(settings)))
        return fail(where, "its settings cannot be felt: a radius, a reach, a turn or a scale is out of range", remedy);
    return settings;
}

}  // namespace burin::activities

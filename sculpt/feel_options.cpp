// SPDX-License-Identifier: MIT
#include "sculpt/feel_options.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace burin::sculpt {
namespace {

constexpr double kStaticOverDynamic = 1.25;

// Figures of our own, chosen in simulation with a ball of 3 mm on an Omni held by a hand; no material's constants.
// Moved along at 50 mm/s and pressed with 0.3 N the tool runs at the depth where the lift bears it
// (haptics/forces/cutting.hpp): 1.5, 0.7 and 0.3 mm. The softer, the less stiff and the more damped, as clay is against
// wood. Friction is at the lower end of wood on metal (0.2 to 0.6) and below, because a tool that cuts is held back by
// the cutting. Together with the damping, the stiffness stays within what an Omni renders stably
// (haptics/stability/rendered_wall.hpp).
struct PresetDescriptor {
    FeelPreset preset;
    const char* name;
    double hardness_kPa_per_mm_s, stiffness_N_per_m, damping_Ns_per_m, friction, drag_Ns_per_m3;
};
constexpr std::array kPresets{
    PresetDescriptor{FeelPreset::soft, "soft", 1.5, 400.0, 0.6, 0.10, 3e4},      // clay
    PresetDescriptor{FeelPreset::medium, "medium", 4.0, 600.0, 0.5, 0.20, 1e4},  // wax, or green wood
    PresetDescriptor{FeelPreset::hard, "hard", 12.0, 650.0, 0.3, 0.30, 0.0}};    // hard wood

const PresetDescriptor& descriptor_of(FeelPreset preset) { return kPresets.at(static_cast<std::size_t>(preset)); }

// Parses a number from 0 on, or "inf".
std::optional<double> parse_hardness(const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end || !(value >= 0.0)) return std::nullopt;
    return value;
}

Result<void> check(const char* option, double value, double most) {
    if (value >= 0.0 && value <= most) return {};
    std::array<char, 80> remedy{};
    std::snprintf(remedy.data(), remedy.size(), "give a number from 0 to %g", most);
    return fail(option, "is out of range", remedy.data());
}

Result<FeelSettings> parse_preset_or_hardness(const std::string& text) {
    for (const PresetDescriptor& known : kPresets) {
        if (text == known.name) return FeelSettings{.preset = known.preset};
    }
    if (const auto hardness = parse_hardness(text)) return with_hardness({}, *hardness);
    return fail("--hardness " + text, "is neither a preset nor a number from 0 on",
                "use soft, medium, hard, or the pressure in kPa under which a millimetre a second goes away");
}

}  // namespace

Result<FeelSettings> parse_feel_settings(const FeelOptions& options) {
    Result<FeelSettings> settings = parse_preset_or_hardness(options.hardness);
    if (!settings) return settings;
    settings->stiffness_N_per_m = options.stiffness_N_per_m;
    settings->friction = options.friction;
    if (const auto good = check_feel(*settings); !good) return std::unexpected(good.error());
    return settings;
}

Result<void> check_feel(const FeelSettings& settings) {
    const haptics::TouchMaterial material = touch_material(settings);
    if (const auto good = check("--stiffness", material.stiffness_N_per_m, 1e5); !good) return good;
    return check("--friction", material.dynamic_friction, 2.0);
}

FeelSettings with_hardness(FeelSettings settings, double hardness_kPa_per_mm_s) {
    settings.preset = FeelPreset::medium;
    settings.hardness_kPa_per_mm_s = hardness_kPa_per_mm_s;
    return settings;
}

haptics::TouchMaterial touch_material(const FeelSettings& settings) {
    const PresetDescriptor& preset = descriptor_of(settings.preset);
    haptics::TouchMaterial material;
    material.hardness_Ns_per_m3 =
        settings.hardness_kPa_per_mm_s.value_or(preset.hardness_kPa_per_mm_s) * kHardnessUnit_Ns_per_m3;
    material.stiffness_N_per_m = settings.stiffness_N_per_m.value_or(preset.stiffness_N_per_m);
    material.damping_Ns_per_m = preset.damping_Ns_per_m;
    material.cutting_drag_Ns_per_m3 = material.hardness_Ns_per_m3 > 0.0 ? preset.drag_Ns_per_m3 : 0.0;
    material.dynamic_friction = settings.friction.value_or(preset.friction);
    material.static_friction = kStaticOverDynamic * material.dynamic_friction;
    return material;
}

Result<Feel> parse_feel(const FeelOptions& options) {
    const Result<FeelSettings> settings = parse_feel_settings(options);
    if (!settings) return std::unexpected(settings.error());
    Feel feel;
    feel.material = touch_material(*settings);
    feel.name = settings->hardness_kPa_per_mm_s ? "given" : descriptor_of(settings->preset).name;
    feel.press_N = options.press_N;
    feel.grip.stiffness_N_per_m = options.grip_N_per_m;
    // Keeps the damping ratio of the default grip: damping goes with the root of the stiffness.
    const devices::HandGrip usual;
    feel.grip.damping_Ns_per_m = usual.damping_Ns_per_m * std::sqrt(options.grip_N_per_m / usual.stiffness_N_per_m);
    if (const auto good = check("--press", feel.press_N, 10.0); !good) return std::unexpected(good.error());
    if (!(options.grip_N_per_m >= 10.0 && options.grip_N_per_m <= 5000.0))
        return fail("--grip", "is out of range",
                    "give a number from 10 to 5000 N/m; a loose hand has 100, a firm one 1000");
    return feel;
}

Json describe_feel_settings(const Feel& feel) {
    const haptics::TouchMaterial& m = feel.material;
    Json hardness = m.hardness_Ns_per_m3 / kHardnessUnit_Ns_per_m3;
    if (!std::isfinite(m.hardness_Ns_per_m3)) hardness = "infinite";
    return {{"preset", feel.name},
            {"hardness_kPa_per_mm_s", hardness},
            {"stiffness_N_per_m", m.stiffness_N_per_m},
            {"damping_Ns_per_m", m.damping_Ns_per_m},
            {"static_friction", m.static_friction},
            {"dynamic_friction", m.dynamic_friction},
            {"press_N", feel.press_N},
            {"grip_N_per_m", feel.grip.stiffness_N_per_m}};
}

}  // namespace burin::sculpt

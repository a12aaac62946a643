// SPDX-License-Identifier: MIT
#include "app/feel_options.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace burin {
namespace {

constexpr double kHardnessUnit_Ns_per_m3 = 1e6;  // 1 kPa per mm/s
constexpr double kStaticOverDynamic = 1.25;

// The figures are ours, chosen in simulation with a ball of 3 mm on an Omni held by a hand; no material's constants. Drawn along
// at 50 mm/s and pressed with 0.3 N the tool runs where the lift bears it (haptics/forces/cutting.hpp): 1.5, 0.7 and 0.3 mm deep.
// The softer, the less stiff and the more damped, as clay is against wood. Friction is that of wood on metal, 0.2 to 0.6, at its
// lower end and below: what holds a tool back while it cuts is the cutting. Stiffness stays within what the limiter allows an
// Omni (haptics/stability/stiffness_limit.hpp) together with the damping.
struct Preset {
    const char* name;
    double hardness_kPa_per_mm_s, stiffness_N_per_m, damping_Ns_per_m, friction, drag_Ns_per_m3;
};
constexpr std::array kPresets{Preset{"soft", 1.5, 400.0, 0.6, 0.10, 3e4},    // clay
                              Preset{"medium", 4.0, 600.0, 0.5, 0.20, 1e4},  // wax, or green wood
                              Preset{"hard", 12.0, 650.0, 0.3, 0.30, 0.0}};  // hard wood

const Preset* preset_named(const std::string& name) {
    for (const Preset& preset : kPresets)
        if (name == preset.name) return &preset;
    return nullptr;
}

std::optional<double> number_in(const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end || std::isnan(value)) return std::nullopt;
    return value;
}

Result<void> check(const char* option, double value, double most) {
    if (value >= 0.0 && value <= most) return {};
    std::array<char, 80> remedy{};
    std::snprintf(remedy.data(), remedy.size(), "give a number from 0 to %g", most);
    return fail(option, "is out of range", remedy.data());
}

}  // namespace

Result<Feel> parse_feel(const FeelOptions& options) {
    const Preset* preset = preset_named(options.hardness);
    const std::optional<double> number = preset != nullptr ? std::nullopt : number_in(options.hardness);
    if (preset == nullptr && (!number || *number < 0.0)) {
        return fail("--hardness " + options.hardness, "is neither a preset nor a number from 0 on",
                    "use soft, medium, hard, or the pressure in kPa under which a millimetre a second goes away");
    }
    const Preset& like = preset != nullptr ? *preset : kPresets[1];
    Feel feel;
    feel.name = preset != nullptr ? preset->name : "given";
    feel.material.hardness_Ns_per_m3 = number.value_or(like.hardness_kPa_per_mm_s) * kHardnessUnit_Ns_per_m3;
    feel.material.stiffness_N_per_m = options.stiffness_N_per_m.value_or(like.stiffness_N_per_m);
    feel.material.damping_Ns_per_m = like.damping_Ns_per_m;
    feel.material.cutting_drag_Ns_per_m3 = feel.material.hardness_Ns_per_m3 > 0.0 ? like.drag_Ns_per_m3 : 0.0;
    feel.material.dynamic_friction = options.friction.value_or(like.friction);
    feel.material.static_friction = kStaticOverDynamic * feel.material.dynamic_friction;
    feel.press_N = options.press_N;
    feel.grip.stiffness_N_per_m = options.grip_N_per_m;
    // As damped as the default grip: the damping goes with the root of the stiffness.
    const HandGrip usual;
    feel.grip.damping_Ns_per_m = usual.damping_Ns_per_m * std::sqrt(options.grip_N_per_m / usual.stiffness_N_per_m);
    if (const auto ok = check("--stiffness", feel.material.stiffness_N_per_m, 1e5); !ok)
        return std::unexpected(ok.error());
    if (const auto ok = check("--friction", feel.material.dynamic_friction, 2.0); !ok)
        return std::unexpected(ok.error());
    if (const auto ok = check("--press", feel.press_N, 10.0); !ok) return std::unexpected(ok.error());
    if (!(options.grip_N_per_m >= 10.0 && options.grip_N_per_m <= 5000.0))
        return fail("--grip", "is out of range",
                    "give a number from 10 to 5000 N/m; a loose hand has 100, a firm one 1000");
    return feel;
}

Json describe_feel_settings(const Feel& feel) {
    const TouchMaterial& m = feel.material;
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

}  // namespace burin

// SPDX-License-Identifier: MIT
#include "toolbox/feel_options.hpp"

#include "base/try.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace burin::toolbox {
namespace {

constexpr double kStaticOverDynamic = 1.25;

// The linear chip law of wood machining, force per width of edge = F_e + K_c h, as the pressure of a driven cutter
// (haptics/forces/cutting.hpp): with two edges on a diameter of 6 mm that run as fast as the published tests' (20 mm,
// two edges, 3000 rpm), and a thrust of 0.3 of the cutting force.
constexpr double kCutterSpeed_m_per_s = 3.14, kToothSpacing_m = 9.42e-3, kThrustRatio = 0.3;
constexpr double hardness_of(double K_c_N_per_mm2) { return kThrustRatio * K_c_N_per_mm2 / kCutterSpeed_m_per_s; }
constexpr double yield_of(double F_e_N_per_mm) { return kThrustRatio * F_e_N_per_mm / kToothSpacing_m; }

// Soft, medium and hard are figures of our own, chosen in simulation with a ball of 3 mm on an Omni held by a hand, and
// no material's constants: none were found in print for clay, wax, plaster or bone. Moved along at 50 mm/s and pressed
// with 0.3 N the tool runs where the lift bears it (haptics/forces/cutting.hpp). The softer, the less stiff and the
// more damped, as clay is against wood. Friction is at the lower end of wood on metal (0.2 to 0.6) and below, because a
// tool that cuts is held back by the cutting. Together with the damping, the stiffness stays within what an Omni
// renders stably (haptics/stability/rendered_wall.hpp).
// Lime, maple and oak: along the grain, straight edges, computed from the law of Curti et al. 2021, European Journal of
// Wood and Wood Products 79:667-678; MDF, beech LVL along the grain, PTFE: Goli et al. 2018, Materials 11:2575.
struct PresetNumbers {
    FeelPreset preset;
    const char *name, *title;
    double hardness_kPa_per_mm_s, yield_kPa, stiffness_N_per_m, damping_Ns_per_m, friction, drag_Ns_per_m3;
};
constexpr std::array kPresets{
    PresetNumbers{FeelPreset::soft, "soft", "Soft, as clay", 1.5, 9.0, 400.0, 0.6, 0.10, 3e4},        // as clay
    PresetNumbers{FeelPreset::medium, "medium", "Medium, as wax", 4.0, 24.0, 600.0, 0.5, 0.20, 1e4},  // as wax
    PresetNumbers{FeelPreset::hard, "hard", "Hard", 12.0, 72.0, 650.0, 0.3, 0.30, 0.0},
    PresetNumbers{FeelPreset::lime, "lime", "Lime", hardness_of(15.2), yield_of(3.22), 650.0, 0.3, 0.30, 0.0},
    PresetNumbers{FeelPreset::maple, "maple", "Maple", hardness_of(16.2), yield_of(3.43), 650.0, 0.3, 0.30, 0.0},
    PresetNumbers{FeelPreset::oak, "oak", "Oak", hardness_of(19.2), yield_of(4.06), 650.0, 0.3, 0.30, 0.0},
    PresetNumbers{FeelPreset::mdf, "mdf", "MDF", hardness_of(31.44), yield_of(3.36), 650.0, 0.3, 0.30, 0.0},
    PresetNumbers{FeelPreset::beech_lvl, "beech-lvl", "Beech LVL", hardness_of(11.73), yield_of(3.70), 650.0, 0.3, 0.30,
                  0.0},
    PresetNumbers{FeelPreset::ptfe, "ptfe", "PTFE", hardness_of(20.33), yield_of(2.71), 600.0, 0.5, 0.10, 0.0}};
// Of hardness and yield, around their means.
constexpr double kGrainShare = 0.3;

constexpr std::array<FeelPresetDescriptor, kPresets.size()> described_presets() {
    std::array<FeelPresetDescriptor, kPresets.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = {kPresets[i].preset, kPresets[i].name, kPresets[i].title};
    return all;
}
constexpr std::array kFeelPresets = described_presets();

const PresetNumbers& numbers_of(FeelPreset preset) { return kPresets.at(static_cast<std::size_t>(preset)); }

// Parses a number from 0 on, or "inf".
std::optional<double> parse_hardness(const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end || !(value >= 0.0)) return std::nullopt;
    return value;
}

// Finer rings no device resolves; far finer ones no number counts.
constexpr double kFinestGrain_mm = 0.01;

Result<void> check(const char* option, double value, double most) {
    if (value >= 0.0 && value <= most) return {};
    std::array<char, 80> remedy{};
    std::snprintf(remedy.data(), remedy.size(), "give a number from 0 to %g", most);
    return fail(option, "is out of range", remedy.data());
}

Result<FeelSettings> parse_preset_or_hardness(const std::string& text) {
    for (const PresetNumbers& known : kPresets) {
        if (text == known.name) return FeelSettings{.preset = known.preset};
    }
    if (const auto hardness = parse_hardness(text)) return with_hardness({}, *hardness);
    return fail("--hardness " + text, "is neither a preset nor a number from 0 on",
                "use soft, medium, hard, lime, maple, oak, mdf, beech-lvl, ptfe, or the pressure in kPa under which a "
                "millimetre a second goes away");
}

}  // namespace

std::span<const FeelPresetDescriptor> feel_presets() { return kFeelPresets; }

Result<FeelSettings> parse_feel_settings(const FeelOptions& options) {
    Result<FeelSettings> settings = parse_preset_or_hardness(options.hardness);
    if (!settings) return settings;
    settings->yield_kPa = options.yield_kPa;
    settings->grain_mm = options.grain_mm;
    settings->stiffness_N_per_m = options.stiffness_N_per_m;
    settings->friction = options.friction;
    BURIN_TRY_DO(check_feel(*settings));
    return settings;
}

Result<void> check_feel(const FeelSettings& settings) {
    const haptics::TouchMaterial material = touch_material(settings);
    BURIN_TRY_DO(check("--yield", 1e-3 * material.cutting_yield_Pa, 1e6));
    BURIN_TRY_DO(check("--grain", 1e3 * material.grain_spacing_m, 1e3));
    if (material.grain_spacing_m > 0.0 && 1e3 * material.grain_spacing_m < kFinestGrain_mm)
        return fail("--grain", "is out of range", "give 0 for none, or a spacing from 0.01 mm on");
    BURIN_TRY_DO(check("--stiffness", material.stiffness_N_per_m, 1e5));
    return check("--friction", material.dynamic_friction, 2.0);
}

FeelSettings with_preset(const FeelSettings& settings, FeelPreset preset) {
    return {.preset = preset, .grain_mm = settings.grain_mm};
}

FeelSettings with_hardness(FeelSettings settings, double hardness_kPa_per_mm_s) {
    settings.preset = FeelPreset::medium;
    settings.hardness_kPa_per_mm_s = hardness_kPa_per_mm_s;
    return settings;
}

haptics::TouchMaterial touch_material(const FeelSettings& settings) {
    const PresetNumbers& preset = numbers_of(settings.preset);
    haptics::TouchMaterial material;
    material.hardness_Ns_per_m3 =
        settings.hardness_kPa_per_mm_s.value_or(preset.hardness_kPa_per_mm_s) * kHardnessUnit_Ns_per_m3;
    if (std::isfinite(material.hardness_Ns_per_m3)) {
        // A hardness given as a number brings the preset's yield with it in proportion.
        const double ratio_mm_per_s = preset.yield_kPa / preset.hardness_kPa_per_mm_s;
        const double proportional_kPa = ratio_mm_per_s * material.hardness_Ns_per_m3 / kHardnessUnit_Ns_per_m3;
        material.cutting_yield_Pa = 1e3 * settings.yield_kPa.value_or(proportional_kPa);
    }
    material.grain_spacing_m = 1e-3 * settings.grain_mm.value_or(0.0);
    material.grain_share = material.grain_spacing_m != 0.0 ? kGrainShare : 0.0;
    material.stiffness_N_per_m = settings.stiffness_N_per_m.value_or(preset.stiffness_N_per_m);
    material.damping_Ns_per_m = preset.damping_Ns_per_m;
    material.cutting_drag_Ns_per_m3 = material.hardness_Ns_per_m3 > 0.0 ? preset.drag_Ns_per_m3 : 0.0;
    material.dynamic_friction = settings.friction.value_or(preset.friction);
    material.static_friction = kStaticOverDynamic * material.dynamic_friction;
    return material;
}

Result<Feel> parse_feel(const FeelOptions& options) {
    BURIN_TRY(settings, parse_feel_settings(options));
    Feel feel;
    feel.material = touch_material(settings);
    feel.name = settings.hardness_kPa_per_mm_s ? "given" : numbers_of(settings.preset).name;
    feel.press_N = options.press_N;
    feel.grip.stiffness_N_per_m = options.grip_N_per_m;
    // Keeps the damping ratio of the default grip: damping goes with the root of the stiffness.
    const devices::HandGrip usual;
    feel.grip.damping_Ns_per_m = usual.damping_Ns_per_m * std::sqrt(options.grip_N_per_m / usual.stiffness_N_per_m);
    BURIN_TRY_DO(check("--press", feel.press_N, 10.0));
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
            {"yield_kPa", 1e-3 * m.cutting_yield_Pa},
            {"grain_mm", 1e3 * m.grain_spacing_m},
            {"stiffness_N_per_m", m.stiffness_N_per_m},
            {"damping_Ns_per_m", m.damping_Ns_per_m},
            {"static_friction", m.static_friction},
            {"dynamic_friction", m.dynamic_friction},
            {"press_N", feel.press_N},
            {"grip_N_per_m", feel.grip.stiffness_N_per_m}};
}

}  // namespace burin::toolbox

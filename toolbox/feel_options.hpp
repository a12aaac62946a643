// SPDX-License-Identifier: MIT
// How the workpiece feels and how the simulated hand holds the tool: as text, as the options --hardness, --yield,
// --grain, --stiffness, --friction, --press and --grip write it (FeelOptions), as typed settings (FeelSettings), and as
// the haptic loop and the hand use it (Feel). Forces and stiffnesses as felt at the device. Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/json.hpp"
#include "devices/hand/hand_grip.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::toolbox {

// As the command line and the first line of an input log have it.
struct FeelOptions {
    // A preset (soft, medium, hard), a material (lime, maple, oak, mdf, beech-lvl, ptfe), or the pressure in kPa under
    // which a millimetre of material a second goes away: 0 gives way without resistance, inf cannot be cut.
    std::string hardness = "medium";
    std::optional<double> yield_kPa = {};          // the pressure below which nothing goes away; none: the preset's
    std::optional<double> grain_mm = {};           // spacing of the rings along x; none: no grain
    std::optional<double> stiffness_N_per_m = {};  // none: the preset's
    std::optional<double> friction = {};           // dynamic, Coulomb's coefficient; none: the preset's
    double press_N = 0.0;                          // force with which the moving hand presses beyond its stroke
    double grip_N_per_m = devices::HandGrip{}.stiffness_N_per_m;
};

enum class FeelPreset : std::uint8_t { soft, medium, hard, lime, maple, oak, mdf, beech_lvl, ptfe };

struct FeelPresetDescriptor {
    FeelPreset preset = FeelPreset::medium;
    std::string_view name;   // as --hardness and the command `material` have it: "beech-lvl"
    std::string_view title;  // as the panel shows it: "Beech LVL"
};
// Lists all presets in the order of FeelPreset.
[[nodiscard]] std::span<const FeelPresetDescriptor> feel_presets();

struct FeelSettings {
    FeelPreset preset = FeelPreset::medium;  // gives whatever is none below, and damping and drag
    std::optional<double> hardness_kPa_per_mm_s = {};
    std::optional<double> yield_kPa = {};  // none: the preset's, in proportion to the hardness
    std::optional<double> grain_mm = {};
    std::optional<double> stiffness_N_per_m = {};
    std::optional<double> friction = {};  // dynamic; the static one is a quarter more

    bool operator==(const FeelSettings&) const = default;
};

struct Feel {
    haptics::TouchMaterial material;
    std::string name;  // of the preset, or "given" for a hardness given as a number
    double press_N = 0.0;
    devices::HandGrip grip;
};

inline constexpr double kHardnessUnit_Ns_per_m3 = 1e6;  // 1 kPa per mm/s

// Parses and checks the material's options.
[[nodiscard]] Result<FeelSettings> parse_feel_settings(const FeelOptions& options);
// Fails when a number is out of range.
[[nodiscard]] Result<void> check_feel(const FeelSettings& settings);
// Returns the settings of a material by itself: all numbers are the preset's, but for the spacing of the grain.
[[nodiscard]] FeelSettings with_preset(const FeelSettings& settings, FeelPreset preset);
// Returns the settings with another hardness. The medium preset then gives what no number gives.
[[nodiscard]] FeelSettings with_hardness(FeelSettings settings, double hardness_kPa_per_mm_s);
[[nodiscard]] haptics::TouchMaterial touch_material(const FeelSettings& settings);

// Parses and checks all options.
[[nodiscard]] Result<Feel> parse_feel(const FeelOptions& options);
[[nodiscard]] Json describe_feel_settings(const Feel& feel);

}  // namespace burin::toolbox

// SPDX-License-Identifier: MIT
// How the workpiece feels and how the simulated hand holds the tool, as --hardness, --stiffness, --friction, --press and
// --grip name it.
#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/json.hpp"
#include "devices/simulated_hand.hpp"
#include "haptics/forces/touch_material.hpp"

namespace burin {

struct FeelOptions {
    // A preset, or a number in kPa per mm/s: the pressure under which the material goes away by a millimetre a second. 0 gives
    // way without resistance; inf cannot be cut.
    std::string hardness = "medium";          // soft | medium | hard | a number
    std::optional<double> stiffness_N_per_m;  // none: the preset's
    std::optional<double> friction;           // likewise; dynamic, and a quarter more before it slips
    double press_N = 0.0;                     // with which the hand presses beyond its stroke where it moves on
    double grip_N_per_m = HandGrip{}.stiffness_N_per_m;
};

struct Feel {
    TouchMaterial material;
    std::string name;  // of the preset, or "given"
    double press_N = 0.0;
    HandGrip grip;
};

[[nodiscard]] Result<Feel> parse_feel(const FeelOptions& options);
[[nodiscard]] Json describe_feel_settings(const Feel& feel);

}  // namespace burin

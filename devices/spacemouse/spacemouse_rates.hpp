// SPDX-License-Identifier: MIT
// How a SpaceMouse moves something, and how that is written: spacemouse, spacemouse:PLACE and settings after commas.
// Rate control: the cap's push is a velocity, its turn an angular velocity. Within the dead zone nothing moves; beyond
// it the rate grows with the square of what is left, fine near the middle. Push and turn are judged by their lengths,
// so that a direction stays the one that is meant. Pure.
#pragma once

#include <string>

#include "base/error.hpp"
#include "base/space.hpp"

namespace burin::devices {

struct SpaceMouseSettings {
    std::string place;               // as burin devices lists it: "hidraw3", "emulated"; empty: the first
    std::string file;                // FILE.toml, of a wand; empty: none
    double speed_m_per_s = 0.08;     // at full push
    double turning_rad_per_s = 1.2;  // at full turn
    double dead_zone = 0.1;          // of full
};

// Reads PLACE, FILE.toml and speed=M/S, turn=RAD/S, dead=SHARE, in any order with commas between them. An Error says
// what is not understood. `where` names the device in it; `usual` has what is not said.
[[nodiscard]] Result<SpaceMouseSettings> spacemouse_settings(const std::string& where, const std::string& text,
                                                             const SpaceMouseSettings& usual = {});

// Returns the rate that a deflection (-1 to 1 an axis) makes, at most `most`.
[[nodiscard]] Vec3 spacemouse_rate(const Vec3& deflection, double dead_zone, double most) noexcept;

// Returns the orientation after a turn with a constant angular velocity, for whatever frame both are in.
[[nodiscard]] Quat turned(const Quat& orientation, const Vec3& rad_per_s, double dt_s) noexcept;

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// Measures a hand's fingers while an exercise runs: their forces, and how far each joint went. Pure; any thread.
// Units: newtons, radians, seconds. Fingers: thumb, index, middle, ring, as the glove has them.
#pragma once

#include <array>
#include <cstddef>

#include "devices/gloves/glove_frame.hpp"

namespace burin::activities {

using FingerForces = std::array<double, devices::kGloveFingers>;  // magnitudes

// A turn of the haptic loop, as an exercise sees it.
struct FingersTurn {
    double dt_s = 0.0;  // since the turn before
    FingerForces forces_N{};
    devices::GloveJoints joints_rad{};
};

// A mean force is over the time in which the finger was pushed at all: more than kPushed_N.
struct FingerMeasures {
    static constexpr double kPushed_N = 0.05;

    double peak_N = 0.0, pushed_s = 0.0, impulse_Ns = 0.0;
    std::array<double, devices::kFingerJoints> least_rad{}, most_rad{};

    [[nodiscard]] double mean_N() const { return pushed_s > 0.0 ? impulse_Ns / pushed_s : 0.0; }
    [[nodiscard]] double range_rad(std::size_t joint) const { return most_rad[joint] - least_rad[joint]; }
    bool operator==(const FingerMeasures&) const = default;
};

struct HandMeasures {
    bool begun = false;
    std::array<FingerMeasures, devices::kGloveFingers> fingers{};
    bool operator==(const HandMeasures&) const = default;
};

[[nodiscard]] HandMeasures with_turn(HandMeasures measures, const FingersTurn& turn);

}  // namespace burin::activities

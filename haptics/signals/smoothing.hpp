// SPDX-License-Identifier: MIT
// Filters of the loop's signals: the exponentially weighted moving average (EWMA), on velocity or on force, and the choice
// between velocity estimates.
//
// EWMA: F_i = E_i (1 - a) + F_(i-1) a. Its mean lag is T a / (1 - a), 9 ms at a = 0.9 and 1 kHz, and it halves the power
// (-3 dB) where cos(w T) = (4 a - 1 - a^2) / (2 a), at 16.8 Hz there. A lag of the force inside the loop costs stability as a
// delay does (haptics/stability/stiffness_limit.hpp, burin bench stability); it is there for comparison and is not the
// default.
// Pure; no clock, heap, lock or throw. Frame: the one of what is put in.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "haptics/signals/velocity.hpp"

namespace burin {

enum class VelocityMethod : std::uint8_t {
    adaptive_window,  // first-order adaptive windowing, the default (haptics/signals/velocity.hpp)
    moving_average,   // EWMA over the plain difference
    difference,       // (x_i - x_(i-1)) / T
};

struct SignalSettings {
    VelocityMethod velocity = VelocityMethod::adaptive_window;
    double velocity_alpha = 0.9;  // of moving_average; 0 <= alpha < 1
    double force_alpha = 0.0;     // EWMA on the force before the gate; 0: none. The PowerWall paper has 0.9.
};

struct MovingAverage {
    Vec3 value{0.0};
    bool begun = false;  // false: the next input is taken as it is
};

// 0 <= alpha < 1.
[[nodiscard]] MovingAverage with_input(const MovingAverage& state, const Vec3& input, double alpha) noexcept;

// The mean lag of the average behind its input, T a / (1 - a).
[[nodiscard]] double mean_lag_s(double alpha, double dt_s) noexcept;

// The velocity by the method chosen, zero until two positions are known. `average` is the state of moving_average; it follows
// in every method, so that a change of method does not start from rest, and begins anew where the window does.
struct VelocityEstimate {
    Vec3 velocity_m_per_s{0.0};
    MovingAverage average;
};
[[nodiscard]] VelocityEstimate estimate_velocity(const SignalSettings& settings, const VelocityWindow& window,
                                                 const MovingAverage& average, double noise_m, double dt_s) noexcept;

}  // namespace burin

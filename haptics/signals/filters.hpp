// SPDX-License-Identifier: MIT
// Estimates the velocity from quantised positions, and smooths signals: first-order adaptive windowing with end fit
// (Janabi-Sharifi, Hayward, Chen 2000), the exponentially weighted moving average (EWMA), on velocity or on force, and
// the choice between them.
//
// For each axis the longest window of at most N ticks is taken whose straight line between its ends passes within the
// noise bound of every position between: long at rest (little noise), short when the motion changes (little lag). With
// one 0.055 mm step a tick worth 55 mm/s at 1 kHz, a plain difference is useless for damping.
// One pass of at most N steps an axis.
//
// EWMA: F_i = E_i (1 - a) + F_(i-1) a. Its mean lag is T a / (1 - a), 9 ms at a = 0.9 and 1 kHz, and it halves the
// power (-3 dB) where cos(w T) = (4 a - 1 - a^2) / (2 a), at 16.8 Hz for these values. A lag of the force inside the
// loop costs stability as a delay does (haptics/stability/rendered_wall.hpp, burin bench stability); it is there for
// comparison and is not the default.
// Pure; no clock, heap, lock or throw. Frame: that of the input.
#pragma once

#include <array>
#include <cstdint>

#include "base/space.hpp"

namespace burin::haptics {

struct VelocityWindow {
    static constexpr std::uint32_t kLongest = 16;  // ticks; 16 ms of lag at most when at rest
    std::array<Vec3, kLongest + 1> positions_m{};  // a ring buffer
    std::uint32_t newest = 0;                      // index of the newest
    std::uint32_t count = 0;                       // number of valid positions
};

// Adds a position to the window.
[[nodiscard]] VelocityWindow with_position(VelocityWindow window, const Vec3& position_m) noexcept;

// Velocity estimate, zero until two positions are known. noise_m >= 0: largest error of a position.
[[nodiscard]] Vec3 velocity_m_per_s(const VelocityWindow& window, double noise_m, double dt_s) noexcept;

enum class VelocityMethod : std::uint8_t {
    adaptive_window,  // first-order adaptive windowing, the default
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
    bool begun = false;  // false: the next input becomes the value
};

// Adds an input to the average; 0 <= alpha < 1.
[[nodiscard]] MovingAverage with_input(const MovingAverage& state, const Vec3& input, double alpha) noexcept;

// The mean lag of the average behind its input, T a / (1 - a).
[[nodiscard]] double mean_lag_s(double alpha, double dt_s) noexcept;

// Estimates the velocity by the chosen method; zero until two positions are known. `average` is the state of
// moving_average. It is updated in every method, so that a change of method does not start from rest, and restarts when
// the window does.
struct VelocityEstimate {
    Vec3 velocity_m_per_s{0.0};
    MovingAverage average;
};
[[nodiscard]] VelocityEstimate estimate_velocity(const SignalSettings& settings, const VelocityWindow& window,
                                                 const MovingAverage& average, double noise_m, double dt_s) noexcept;

}  // namespace burin::haptics

// SPDX-License-Identifier: MIT
#include "haptics/signals/filters.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

constexpr std::uint32_t kPlaces = VelocityWindow::kLongest + 1;

// Positions are multiples of the encoder's step; rounding in their last bits must not shorten a window.
constexpr double kRounding = 1.0 + 1e-6;

// Slope of the longest window whose line from end to end passes all positions between within the noise. One pass
// suffices: a line through the newest position passes the position i ticks ago within the noise when its slope is
// within a range, and the intersection of these ranges only narrows.
double velocity_of_axis(const VelocityWindow& window, int axis, double noise_m, double dt_s) {
    const double newest_m = window.positions_m[window.newest][axis], most_m = noise_m * kRounding;
    double best_a_tick = 0.0, least = -HUGE_VAL, greatest = HUGE_VAL;
    std::uint32_t place = window.newest;
    for (std::uint32_t n = 1; n < window.count; ++n) {
        place = place == 0 ? kPlaces - 1 : place - 1;
        const double moved_m = newest_m - window.positions_m[place][axis], a_tick = moved_m / n;
        if (!(a_tick >= least && a_tick <= greatest)) break;
        best_a_tick = a_tick;
        least = std::max(least, (moved_m - most_m) / n);
        greatest = std::min(greatest, (moved_m + most_m) / n);
    }
    return best_a_tick / dt_s;
}

Vec3 difference_m_per_s(const VelocityWindow& window, double dt_s) {
    const Vec3& now = window.positions_m[window.newest];
    const Vec3& before = window.positions_m[(window.newest + kPlaces - 1) % kPlaces];
    return (now - before) / dt_s;
}

}  // namespace

VelocityWindow with_position(VelocityWindow window, const Vec3& position_m) noexcept {
    window.newest = (window.newest + 1) % kPlaces;
    window.positions_m[window.newest] = position_m;
    if (window.count < kPlaces) ++window.count;
    return window;
}

Vec3 velocity_m_per_s(const VelocityWindow& window, double noise_m, double dt_s) noexcept {
    return {velocity_of_axis(window, 0, noise_m, dt_s), velocity_of_axis(window, 1, noise_m, dt_s),
            velocity_of_axis(window, 2, noise_m, dt_s)};
}

MovingAverage with_input(const MovingAverage& state, const Vec3& input, double alpha) noexcept {
    if (!state.begun) return {input, true};
    return {input * (1.0 - alpha) + state.value * alpha, true};
}

// Sums the weights (1 - a) a^i of inputs i periods old, times i T.
double mean_lag_s(double alpha, double dt_s) noexcept { return dt_s * alpha / (1.0 - alpha); }

VelocityEstimate estimate_velocity(const SignalSettings& settings, const VelocityWindow& window,
                                   const MovingAverage& average, double noise_m, double dt_s) noexcept {
    if (window.count < 2) return {};
    const Vec3 difference = difference_m_per_s(window, dt_s);
    const MovingAverage followed = with_input(average, difference, settings.velocity_alpha);
    switch (settings.velocity) {
        case VelocityMethod::moving_average: return {followed.value, followed};
        case VelocityMethod::difference: return {difference, followed};
        case VelocityMethod::adaptive_window: break;
    }
    return {velocity_m_per_s(window, noise_m, dt_s), followed};
}

}  // namespace burin::haptics

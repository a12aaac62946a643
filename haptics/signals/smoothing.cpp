// SPDX-License-Identifier: MIT
#include "haptics/signals/smoothing.hpp"

namespace burin {
namespace {

constexpr std::uint32_t kPlaces = VelocityWindow::kLongest + 1;

Vec3 difference_m_per_s(const VelocityWindow& window, double dt_s) {
    const Vec3& now = window.positions_m[window.newest];
    const Vec3& before = window.positions_m[(window.newest + kPlaces - 1) % kPlaces];
    return (now - before) / dt_s;
}

}  // namespace

MovingAverage with_input(const MovingAverage& state, const Vec3& input, double alpha) noexcept {
    if (!state.begun) return {input, true};
    return {input * (1.0 - alpha) + state.value * alpha, true};
}

// The weights (1 - a) a^i of what is i periods old, times i T, summed up.
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

}  // namespace burin

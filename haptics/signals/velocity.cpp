// SPDX-License-Identifier: MIT
#include "haptics/signals/velocity.hpp"

#include <cmath>

namespace burin {
namespace {

constexpr std::uint32_t kPlaces = VelocityWindow::kLongest + 1;

// Positions are multiples of the encoder's step; rounding in their last bits must not shorten a window.
constexpr double kRounding = 1.0 + 1e-6;

double velocity_of_axis(const VelocityWindow& window, int axis, double noise_m, double dt_s) {
    const auto ago = [&](std::uint32_t ticks) {
        return window.positions_m[(window.newest + kPlaces - ticks) % kPlaces][axis];
    };
    double best = 0.0;
    for (std::uint32_t n = 1; n < window.count; ++n) {
        const double a_tick = (ago(0) - ago(n)) / n;
        for (std::uint32_t i = 1; i < n; ++i)
            if (std::abs(ago(i) - (ago(0) - i * a_tick)) > noise_m * kRounding) return best;
        best = a_tick / dt_s;
    }
    return best;
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

}  // namespace burin

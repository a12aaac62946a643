// SPDX-License-Identifier: MIT
#include "haptics/signals/velocity.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

constexpr std::uint32_t kPlaces = VelocityWindow::kLongest + 1;

// Positions are multiples of the encoder's step; rounding in their last bits must not shorten a window.
constexpr double kRounding = 1.0 + 1e-6;

// The longest window whose line from end to end passes all between within the noise. In one pass: a line through the newest
// position passes the position i ticks ago within the noise when its slope is within a range, and these ranges only narrow.
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

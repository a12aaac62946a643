// SPDX-License-Identifier: MIT
#include "haptics/signals/smoothing.hpp"

namespace burin {

MovingAverage with_input(const MovingAverage& state, const Vec3& input, double alpha) noexcept {
    if (!state.begun) return {input, true};
    return {input * (1.0 - alpha) + state.value * alpha, true};
}

VelocityEstimate estimate_velocity(const SignalSettings&, const VelocityWindow& window, const MovingAverage& average,
                                   double noise_m, double dt_s) noexcept {
    return {velocity_m_per_s(window, noise_m, dt_s), average};
}

}  // namespace burin

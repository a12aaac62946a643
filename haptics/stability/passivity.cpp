// SPDX-License-Identifier: MIT
#include "haptics/stability/passivity.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

constexpr std::uint32_t kPlaces = PassivityState::kLongestDelay + 1;

// Forces below this move no device; a filtered force never decays to zero altogether.
constexpr double kNoForce_N = 0.001;

// Share of the desired force above which the gate counts as not fading: allows for rounding and for other forces within
// the limit.
constexpr double kGiven = 0.99;

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

std::uint32_t delay_ticks(const devices::DeviceDescription& device, double dt_s) {
    const double ticks = std::floor(device.delay_s / dt_s + 0.5);
    return ticks > 0.0 ? static_cast<std::uint32_t>(std::min<double>(ticks, PassivityState::kLongestDelay)) : 0;
}

// Energy stored in a spring whose force is clamped to a limit: F d - F^2 / (2 K) instead of K d^2 / 2.
double held_J(const PassivityInput& in, double wanted_N) {
    if (!(in.max_force_N > 0.0) || wanted_N <= in.max_force_N) return in.stored_J;
    const double share = in.max_force_N / wanted_N;
    return in.stored_J * share * (2.0 - share);
}

bool forces_are_gone(const PassivityState& state, std::uint32_t delay) {
    for (std::uint32_t ago = 0; ago <= delay; ++ago)
        if (length(state.forces_device_N[(state.newest + kPlaces - ago) % kPlaces]) > kNoForce_N) return false;
    return true;
}

// Updates E, U and R for the motion since the last tick.
void count_energy(PassivityState& next, const PassivityState& before, const PassivityInput& in, double wanted_N,
                  const PassivitySettings& settings, const devices::DeviceDescription& device, double dt_s) {
    const std::uint32_t delay = delay_ticks(device, dt_s);
    if (!before.known || (!in.in_contact && forces_are_gone(before, delay))) {
        next.energy_J = next.stored_J = next.reserve_J = 0.0;
        return;
    }
    const Vec3& acted = before.forces_device_N[(before.newest + kPlaces - delay) % kPlaces];
    const Vec3 moved = in.position_device_m - before.position_device_m;
    const double taken_J = -glm::dot(acted, moved), way_m = length(moved);
    const double by_device_J = device.friction_N * way_m + device.damping_Ns_per_m * way_m * way_m / dt_s;
    next.energy_J = before.energy_J + taken_J;
    next.stored_J = held_J(in, wanted_N);
    next.reserve_J =
        std::min(settings.reserve_J, before.reserve_J + taken_J - (next.stored_J - before.stored_J) + by_device_J);
    if (in.jumped || before.fading) next.reserve_J = std::max(0.0, next.reserve_J);
}

// Adds the damping that dissipates -R.
void take_back(PassivityStep& step, const PassivityState& before, const PassivityInput& in, double wanted_N,
               const PassivitySettings& settings, const devices::DeviceDescription& device, double dt_s) {
    const Vec3 along = in.wanted_force_device_N / wanted_N;
    const double moved_m = glm::dot(in.position_device_m - before.position_device_m, along);
    // Positions are multiples of the encoder step; rounding in their last bits must not make two steps count as less.
    if (moved_m == 0.0 || std::abs(moved_m) < 2.0 * device.resolution_m * (1.0 - 1e-6)) return;
    // Number of ticks in which the damping is commanded before the first command acts.
    const double v = moved_m / dt_s, orders = 1.0 + delay_ticks(device, dt_s);
    double a = std::min(-step.next.reserve_J / (v * v * dt_s * orders), settings.max_damping_Ns_per_m);
    if (a * v > wanted_N) a = wanted_N / v;  // no pull
    step.record.damping_Ns_per_m = a;
    step.force_device_N = std::max(0.0, wanted_N - a * v) * along;
}

}  // namespace

PassivityStep keep_passive(const PassivityState& state, const PassivityInput& in, const PassivitySettings& settings,
                           const devices::DeviceDescription& device, double dt_s) noexcept {
    PassivityStep step;
    step.next = state;
    step.force_device_N = in.wanted_force_device_N;
    const double wanted_N = length(in.wanted_force_device_N);
    count_energy(step.next, state, in, wanted_N, settings, device, dt_s);
    step.record.energy_J = step.next.energy_J;
    step.next.position_device_m = in.position_device_m;
    step.next.known = false;  // until with_commanded_force() stores the commanded force
    if (settings.control && step.next.reserve_J < 0.0 && wanted_N > 0.0)
        take_back(step, state, in, wanted_N, settings, device, dt_s);
    const double asked_N = length(step.force_device_N);
    step.next.asked_N = in.max_force_N > 0.0 ? std::min(asked_N, in.max_force_N) : asked_N;
    return step;
}

PassivityState with_commanded_force(PassivityState state, const Vec3& force_device_N) noexcept {
    state.newest = (state.newest + 1) % kPlaces;
    state.forces_device_N[state.newest] = force_device_N;
    state.fading = length(force_device_N) < kGiven * state.asked_N;
    state.known = true;
    return state;
}

}  // namespace burin::haptics

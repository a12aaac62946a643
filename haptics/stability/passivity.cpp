// SPDX-License-Identifier: MIT
#include "haptics/stability/passivity.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

// Share of the desired force above which the gate counts as not fading: allows for rounding and for other forces within
// the limit.
constexpr double kGiven = 0.99;

PromiseLimits promise_of(const PassivitySettings& settings, double dt_s) {
    return {settings.contact_speed_m_per_s, settings.turn_speed_rad_per_s, settings.lost_ticks, dt_s};
}

std::uint32_t delay_ticks(const devices::DeviceDescription& device, double dt_s) {
    const double ticks = std::floor(device.delay_s / dt_s + 0.5);
    return ticks > 0.0 ? static_cast<std::uint32_t>(std::min<double>(ticks, EnergyAccount::kLongestDelay)) : 0;
}

// Energy stored in a spring whose force is clamped to a limit: F d - F^2 / (2 K) instead of K d^2 / 2.
double held_J(const PassivityInput& in, double wanted_N) {
    if (!(in.max_force_N > 0.0) || wanted_N <= in.max_force_N) return in.stored_J;
    const double share = in.max_force_N / wanted_N;
    return in.stored_J * share * (2.0 - share);
}

Vec3 honest_velocity(const PassivityInput& in, const PassivitySettings& settings) {
    const Vec3& v = in.surface_velocity_device_m_per_s;
    const double speed = glm::length(v);
    return speed > settings.surface_speed_m_per_s ? v * (settings.surface_speed_m_per_s / speed) : v;
}

// Updates E, U, R and A for the motion since the last tick.
void count(PassivityObserver& next, const PassivityObserver& before, const PassivityInput& in, double wanted_N,
           const PassivitySettings& settings, const devices::DeviceDescription& device, double dt_s) {
    // No sample is of a time to come, whatever its stamp says.
    const Nanoseconds taken_ns = in.now_ns > 0 ? std::min(in.time_ns, in.now_ns) : in.time_ns;
    const AccountStep step = count_energy(before.account,
                                          {in.position_device_m, in.orientation_device, taken_ns, in.turns,
                                           in.in_contact, before.known, honest_velocity(in, settings)},
                                          promise_of(settings, dt_s), device);
    next.account = step.next;
    if (!before.known || !(step.counted || step.next.counting)) {
        next.energy_J = next.stored_J = next.reserve_J = 0.0;
        return;
    }
    next.energy_J = before.energy_J + step.taken_J;
    next.stored_J = held_J(in, wanted_N);
    next.reserve_J = std::min(settings.reserve_J, before.reserve_J + step.taken_J - (next.stored_J - before.stored_J) +
                                                      step.dissipated_J + step.given_by_surface_J);
    if (in.one_way) next.reserve_J = 0.0;
    if (in.jumped || before.faded_ticks > 0) next.reserve_J = std::max(0.0, next.reserve_J);
    next.account.budget_J = std::min(next.account.budget_J, next.stored_J + settings.reserve_J);
}

// Velocity along a direction, over the shortest window in which the tool has moved by two encoder steps; 0 where there
// is none, or where the tool has turned since.
double clear_speed(const PassivityObserver& before, const PassivityInput& in, const Vec3& along, double step_m,
                   double dt_s) {
    // Positions are multiples of the encoder step; rounding in their last bits must not make two steps count as less.
    const double least_m = 2.0 * step_m * (1.0 - 1e-6);
    const double last_m = glm::dot(in.position_device_m - before.position_device_m, along);
    if (last_m != 0.0 && std::abs(last_m) >= least_m) return last_m / dt_s;
    if (in.window == nullptr) return 0.0;
    const VelocityWindow& w = *in.window;
    constexpr std::uint32_t kPlaces = VelocityWindow::kLongest + 1;
    for (std::uint32_t ago = 2; ago < w.count; ++ago) {
        const double moved_m =
            glm::dot(in.position_device_m - w.positions_m[(w.newest + kPlaces - ago) % kPlaces], along);
        if (moved_m != 0.0 && std::abs(moved_m) >= least_m)
            return last_m * moved_m >= 0.0 ? moved_m / (ago * dt_s) : 0.0;
    }
    return 0.0;
}

// Adds the damping that dissipates -R.
void take_back(PassivityStep& step, const PassivityObserver& before, const PassivityInput& in, double wanted_N,
               const PassivitySettings& settings, const devices::DeviceDescription& device, double dt_s) {
    const Vec3 along = in.wanted.force_device_N / wanted_N;
    const double v = clear_speed(before, in, along, device.resolution_m, dt_s);
    if (v == 0.0) return;
    // Number of ticks in which the damping is commanded before the first command acts.
    const double orders = 1.0 + step.next.delay_ticks;
    double a = std::min(-step.next.reserve_J / (v * v * dt_s * orders), settings.max_damping_Ns_per_m);
    if (a * v > wanted_N) a = wanted_N / v;  // no pull
    step.record.damping_Ns_per_m = a;
    step.wrench.force_device_N = std::max(0.0, wanted_N - a * v) * along;
}

}  // namespace

PassivityStep keep_passive(const PassivityObserver& state, const PassivityInput& in, const PassivitySettings& settings,
                           const devices::DeviceDescription& device, double dt_s) noexcept {
    PassivityStep step;
    step.next = state;
    step.wrench = in.wanted;
    const double wanted_N = glm::length(in.wanted.force_device_N);
    count(step.next, state, in, wanted_N, settings, device, dt_s);
    step.record.energy_J = step.next.energy_J;
    step.record.budget_J = step.next.account.budget_J;
    step.next.position_device_m = in.position_device_m;
    step.next.delay_ticks = delay_ticks(device, dt_s);
    step.next.known = false;  // until set_commanded_wrench() stores the commanded one
    if (settings.control && step.next.reserve_J < 0.0 && wanted_N > 0.0)
        take_back(step, state, in, wanted_N, settings, device, dt_s);
    // What the account does not afford counts as faded out.
    const double asked_N = glm::length(step.wrench.force_device_N);
    step.next.asked_N = in.max_force_N > 0.0 ? std::min(asked_N, in.max_force_N) : asked_N;
    if (settings.control && can_promise(device)) {
        if (!step.next.account.counting) step.wrench = {};  // a filter's tail, too small to be counted
        const Affordable most =
            affordable(step.next.account, step.wrench, promise_of(settings, dt_s), device, in.now_ns);
        step.record.share = most.share;
        step.record.most_N = most.force_N;
        step.record.most_Nm = most.torque_Nm;
        if (most.share < 1.0) {
            step.wrench.force_device_N *= most.share;
            step.wrench.torque_device_Nm *= most.share;
        }
    }
    return step;
}

double promised_gap_s(const PassivitySettings& settings, const devices::DeviceDescription& device,
                      double dt_s) noexcept {
    const bool turns = device.max_torque_Nm != Vec3(0.0);
    const bool promises = settings.control && can_promise(device) && (!turns || rotation_is_known(device));
    return promises ? longest_gap_s(promise_of(settings, dt_s)) : 0.0;
}

void set_commanded_wrench(PassivityObserver& state, const devices::DeviceWrench& wrench, Nanoseconds now_ns) noexcept {
    remember(state.account, wrench, now_ns);
    if (glm::length(wrench.force_device_N) < kGiven * state.asked_N)
        state.faded_ticks = 1 + state.delay_ticks;
    else if (state.faded_ticks > 0)
        --state.faded_ticks;
    state.known = true;
}

}  // namespace burin::haptics

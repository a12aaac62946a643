// SPDX-License-Identifier: MIT
#include "devices/haptic/simulated_omni.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin::devices {
namespace {

constexpr double kModelStep_s = 50e-6;
static_assert(SimulatedOmni::kStep_ns == 50'000);

double quantised(double x_m, double quantum_m) {
    return quantum_m > 0.0 ? quantum_m * std::floor(x_m / quantum_m + 0.5) : x_m;
}

Vec3 quantised(const Vec3& p_m, double quantum_m) {
    return {quantised(p_m.x, quantum_m), quantised(p_m.y, quantum_m), quantised(p_m.z, quantum_m)};
}

double omni_length(const Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

// The device's own protection: a force that is not finite becomes zero, one that is too strong is scaled down.
Vec3 clamped(const Vec3& force_N, double max_N) {
    const double l = omni_length(force_N);
    if (!std::isfinite(l)) return Vec3(0.0);
    return l > max_N ? force_N * (max_N / l) : force_N;
}

}  // namespace

DeviceDescription description_of(const OmniModel& model) noexcept {
    DeviceDescription device;
    device.name = model.name;
    device.workspace_m = model.workspace_m;
    device.resolution_m = model.resolution_m;
    device.max_force_N = model.max_force_N;
    device.max_stiffness_N_per_m = model.max_stiffness_N_per_m;
    device.felt_by_person = false;
    device.rate_Hz = 1000.0;
    device.apparent_mass_kg = model.apparent_mass_kg;
    device.damping_Ns_per_m = model.damping_Ns_per_m;
    device.friction_N = model.friction_N;
    device.delay_s = seconds(SimulatedOmni::kDelay_ns);
    device.watchdog_s = model.watchdog_s;
    return device;
}

SimulatedOmni::SimulatedOmni(AnyHand hand, const OmniModel& model, Clock* clock)
    : hand_(std::move(hand)), model_(model), clock_(clock), description_(description_of(model)) {
    if (clock_ != nullptr) clock_start_ns_ = clock_->now_ns();
    const Vec3 half = 0.5 * model_.workspace_m;
    position_m_ = glm::clamp(target_of(hand_, 0.0).position_device_m, -half, half);
    last_sample_ = honest_sample();
}

void SimulatedOmni::advance(Nanoseconds dt_ns) noexcept {
    owed_ns_ += dt_ns;
    while (owed_ns_ >= kStep_ns) {
        step();
        owed_ns_ -= kStep_ns;
        time_ns_ += kStep_ns;
        update_acting_force();
    }
}

void SimulatedOmni::update_acting_force() noexcept {
    for (std::uint32_t ago = 0; ago < kCommands; ++ago) {
        const Command& command = commands_[(newest_ + kCommands - ago) % kCommands];
        if (command.time_ns + kDelay_ns > time_ns_) continue;
        acting_force_N_ = command.force_N;
        // A command that arrived too late revives the motors only when it acts itself.
        const Nanoseconds written_ns =
            ago > 0 ? commands_[(newest_ + kCommands - ago + 1) % kCommands].time_ns : time_ns_ + 1;
        const Nanoseconds silent_ns = command.time_ns + nanoseconds(model_.watchdog_s);
        if (model_.watchdog_s > 0.0 && time_ns_ >= silent_ns && written_ns > silent_ns) acting_force_N_ = Vec3(0.0);
        return;
    }
}

void SimulatedOmni::step() noexcept {
    const HandGrip& grip = grip_of(hand_);
    const HandTarget target = target_of(hand_, seconds(time_ns_ + kStep_ns));
    const double mass = model_.apparent_mass_kg + grip.mass_kg;
    const Vec3 pull = acting_force_N_ + grip.stiffness_N_per_m * (target.position_device_m - position_m_) +
                      grip.damping_Ns_per_m * target.velocity_device_m_per_s;
    const double damping = model_.damping_Ns_per_m + grip.damping_Ns_per_m;
    Vec3 v = (velocity_m_per_s_ + (kModelStep_s / mass) * pull) / (1.0 + (kModelStep_s / mass) * damping);
    // Applies Coulomb friction as an impulse that stops the motion if it can, and otherwise opposes it in full.
    const double brake = kModelStep_s * model_.friction_N / mass;
    const double speed = omni_length(v);
    v = speed <= brake ? Vec3(0.0) : v * (1.0 - brake / speed);
    position_m_ += kModelStep_s * v;
    const Vec3 half = 0.5 * model_.workspace_m;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(position_m_[axis]) <= half[axis]) continue;
        position_m_[axis] = position_m_[axis] < 0.0 ? -half[axis] : half[axis];
        v[axis] = 0.0;
    }
    velocity_m_per_s_ = v;
}

DeviceSample SimulatedOmni::honest_sample() noexcept {
    const HandTarget target = target_of(hand_, seconds(time_ns_));
    DeviceSample sample;
    sample.time_ns = clock_start_ns_ + time_ns_;
    sample.position_device_m = quantised(position_m_, model_.resolution_m);
    sample.orientation_device = target.orientation_device;  // the wrist is not driven and follows the hand
    sample.buttons = target.buttons;
    return sample;
}

DeviceSample SimulatedOmni::read() noexcept {
    if (clock_ != nullptr) {
        const Nanoseconds behind_ns = clock_->now_ns() - clock_start_ns_ - time_ns_ - owed_ns_;
        const Nanoseconds lost_ns = std::max<Nanoseconds>(behind_ns - kMostCatchUp_ns, 0);
        clock_start_ns_ += lost_ns;
        advance(behind_ns - lost_ns);
    }
    update_acting_force();
    switch (injected_) {
        case InjectedFault::none: last_sample_ = honest_sample(); break;
        case InjectedFault::frozen: break;
        case InjectedFault::disconnected:
            last_sample_.fault = DeviceFault::disconnected;
            acting_force_N_ = Vec3(0.0);
            commands_ = {};
            break;
        case InjectedFault::nan_position:
            last_sample_ = honest_sample();
            last_sample_.position_device_m.x = std::numeric_limits<double>::quiet_NaN();
            break;
        case InjectedFault::overspeed:
            last_sample_ = honest_sample();
            runaway_m_.x += 0.01;
            last_sample_.position_device_m += runaway_m_;
            break;
    }
    if (injected_ != InjectedFault::overspeed) runaway_m_ = Vec3(0.0);
    return last_sample_;
}

void SimulatedOmni::write(const DeviceWrench& wrench) noexcept {
    if (injected_ == InjectedFault::disconnected) return;
    newest_ = (newest_ + 1) % kCommands;
    commands_[newest_] = {clamped(wrench.force_device_N, model_.max_force_N), time_ns_};
}

}  // namespace burin::devices

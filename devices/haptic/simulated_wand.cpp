// SPDX-License-Identifier: MIT
#include "devices/haptic/simulated_wand.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/hand/quaternion_path.hpp"

namespace burin::devices {
namespace {

constexpr double kWandStep_s = 50e-6;
static_assert(SimulatedWand::kStep_ns == 50'000);

double on_grid(double x, double quantum) { return quantum > 0.0 ? quantum * std::floor(x / quantum + 0.5) : x; }

double length_of(const Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

// Returns twice the sine of half the angle from one orientation to the other, along its axis, the shorter way round.
Vec3 turn_from(const Quat& from, const Quat& to) {
    const Quat q = to * glm::conjugate(from);
    return (q.w < 0.0 ? -2.0 : 2.0) * Vec3(q.x, q.y, q.z);
}

Quat turned_by(const Quat& q, const Vec3& small_turn_rad) {
    const Vec3 half = 0.5 * small_turn_rad;
    const Quat change = Quat(0.0, half.x, half.y, half.z) * q;
    return normalised(Quat(q.w + change.w, q.x + change.x, q.y + change.y, q.z + change.z));
}

// The orientation as encoders give it: its vector part in steps, along the sphere's nearest point.
Quat on_grid(const Quat& q, double step_rad) {
    if (!(step_rad > 0.0)) return q;
    const double half = 0.5 * step_rad;
    const Vec3 v(on_grid(q.x, half), on_grid(q.y, half), on_grid(q.z, half));
    return normalised(Quat(q.w, v.x, v.y, v.z));
}

// Coulomb friction as an impulse that stops the motion if it can, and otherwise opposes it in full.
Vec3 braked(const Vec3& v, double brake) {
    const double speed = length_of(v);
    return speed <= brake ? Vec3(0.0) : v * (1.0 - brake / speed);
}

// Counts the axes on which a wrench is at its limit.
void count_saturation(const Vec3& given, const Vec3& most, std::array<std::uint64_t, 3>& saturated) {
    for (int axis = 0; axis < 3; ++axis)
        if (most[axis] != 0.0 && std::abs(given[axis]) >= most[axis] * SimulatedWand::kAtLimit)
            ++saturated[static_cast<std::size_t>(axis)];
}

// Returns whether a wrench is beyond its limit on an axis, or is not a number.
bool exceeds(const Vec3& given, const Vec3& most) {
    for (int axis = 0; axis < 3; ++axis)
        if (most[axis] != 0.0 && !(std::abs(given[axis]) <= most[axis])) return true;
    return false;
}

}  // namespace

SimulatedWand::SimulatedWand(AnyHand hand, WandDescription wand, Clock* clock)
    : hand_(std::move(hand)), wand_(std::move(wand)), clock_(clock), description_(device_of(wand_)) {
    description_.felt_by_person = false;
    delay_ns_ = nanoseconds(wand_.arm.delay_s);
    if (clock_ != nullptr) clock_start_ns_ = clock_->now_ns();
    const Vec3 &lowest = description_.lowest_turn_rad, &highest = description_.highest_turn_rad;
    stops_.pitch_stops = lowest.x < highest.x;
    stops_.roll_stops = lowest.z < highest.z;
    stops_.lowest_pitch = std::tan(lowest.x);
    stops_.highest_pitch = std::tan(highest.x);
    stops_.lowest_roll = std::sin(lowest.z);
    stops_.highest_roll = std::sin(highest.z);
    const HandTarget start = target_of(hand_, 0.0);
    const Vec3 half = 0.5 * description_.workspace_m;
    pose_.position_m = glm::clamp(start.position_device_m, -half, half);
    target_ = start.orientation_device;
    if (within_stops(target_)) pose_.orientation = target_;
    last_sample_.time_ns = clock_start_ns_;
    last_sample_.position_device_m = pose_.position_m;
    last_sample_.orientation_device = pose_.orientation;
}

// A variant of types whose moves do not throw always holds one; visit could throw.
void SimulatedWand::advance(Nanoseconds dt_ns) noexcept {
    owed_ns_ += dt_ns;
    while (owed_ns_ >= kStep_ns) {
        step();
        owed_ns_ -= kStep_ns;
        time_ns_ += kStep_ns;
        update_acting_wrench();
    }
}

void SimulatedWand::update_acting_wrench() noexcept {
    if (tripped() || is_lost_) return let_motors_rest();
    for (std::uint32_t ago = 0; ago < kCommands; ++ago) {
        const Command& command = commands_[(newest_ + kCommands - ago) % kCommands];
        if (command.time_ns + delay_ns_ > time_ns_) continue;
        acting_ = command.wrench;
        return;
    }
}

void SimulatedWand::let_motors_rest() noexcept {
    acting_ = {};
    commands_ = {};
}

void SimulatedWand::step() noexcept {
    const HandTarget target = target_of(hand_, seconds(time_ns_ + kStep_ns));
    move(grip_of(hand_), target);
    turn(grip_of(hand_), target);
}

void SimulatedWand::move(const HandGrip& grip, const HandTarget& target) noexcept {
    const double mass = wand_.arm.mass_kg + grip.mass_kg;
    const Vec3 pull = acting_.force_device_N + grip.stiffness_N_per_m * (target.position_device_m - pose_.position_m) +
                      grip.damping_Ns_per_m * target.velocity_device_m_per_s;
    const double damping = wand_.arm.damping_Ns_per_m + grip.damping_Ns_per_m;
    Vec3 v = (velocity_m_per_s_ + (kWandStep_s / mass) * pull) / (1.0 + (kWandStep_s / mass) * damping);
    v = braked(v, kWandStep_s * wand_.arm.friction_N / mass);
    pose_.position_m += kWandStep_s * v;
    const Vec3 half = 0.5 * description_.workspace_m;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(pose_.position_m[axis]) <= half[axis]) continue;
        pose_.position_m[axis] = pose_.position_m[axis] < 0.0 ? -half[axis] : half[axis];
        v[axis] = 0.0;
    }
    velocity_m_per_s_ = v;
}

void SimulatedWand::turn(const HandGrip& grip, const HandTarget& target) noexcept {
    const double inertia = wand_.arm.inertia_kgm2 + grip.inertia_kgm2;
    const Vec3 hand_rad_per_s = turn_from(target_, target.orientation_device) / kWandStep_s;
    target_ = target.orientation_device;
    const Vec3 pull = acting_.torque_device_Nm +
                      grip.torsion_Nm_per_rad * turn_from(pose_.orientation, target.orientation_device) +
                      grip.angular_damping_Nms_per_rad * hand_rad_per_s;
    const double damping = wand_.arm.angular_damping_Nms_per_rad + grip.angular_damping_Nms_per_rad;
    Vec3 w = (turning_rad_per_s_ + (kWandStep_s / inertia) * pull) / (1.0 + (kWandStep_s / inertia) * damping);
    w = braked(w, kWandStep_s * wand_.arm.angular_friction_Nm / inertia);
    if (w != Vec3(0.0)) {
        const Quat turned = turned_by(pose_.orientation, kWandStep_s * w);
        if (within_stops(turned))
            pose_.orientation = turned;
        else
            w = Vec3(0.0);
    }
    turning_rad_per_s_ = w;
}

bool SimulatedWand::within_stops(const Quat& orientation) const noexcept {
    const Vec3 along = orientation * Vec3(0.0, 1.0, 0.0);
    if (stops_.pitch_stops &&
        !(along.y > 0.0 && along.z >= stops_.lowest_pitch * along.y && along.z <= stops_.highest_pitch * along.y))
        return false;
    return !stops_.roll_stops || (-along.x >= stops_.lowest_roll && -along.x <= stops_.highest_roll);
}

DeviceSample SimulatedWand::read() noexcept {
    if (clock_ != nullptr) {
        const Nanoseconds behind_ns = clock_->now_ns() - clock_start_ns_ - time_ns_ - owed_ns_;
        const Nanoseconds lost_ns = std::max<Nanoseconds>(behind_ns - kMostCatchUp_ns, 0);
        clock_start_ns_ += lost_ns;
        advance(behind_ns - lost_ns);
    }
    const bool off = untold_.exchange(false, std::memory_order_relaxed) || tripped();
    if (off) let_motors_rest();
    update_acting_wrench();
    if (is_lost_) {
        last_sample_.fault = DeviceFault::disconnected;
        return last_sample_;
    }
    DeviceSample sample;
    sample.time_ns = clock_start_ns_ + time_ns_;
    for (int axis = 0; axis < 3; ++axis)
        sample.position_device_m[axis] = on_grid(pose_.position_m[axis], wand_.arm.resolution_m);
    sample.orientation_device = on_grid(pose_.orientation, wand_.arm.orientation_step_rad);
    sample.buttons = target_of(hand_, seconds(time_ns_)).buttons;
    if (off) sample.fault = DeviceFault::other;
    last_sample_ = sample;
    return sample;
}

void SimulatedWand::write(const DeviceWrench& wrench) noexcept {
    if (is_lost_) return;
    DeviceWrench driven = wrench;
    for (int axis = 0; axis < 3; ++axis)
        if (description_.max_torque_Nm[axis] == 0.0) driven.torque_device_Nm[axis] = 0.0;
    const bool exceeded = exceeds(driven.force_device_N, description_.axis_max_force_N) ||
                          exceeds(driven.torque_device_Nm, description_.max_torque_Nm);
    exceeding_.store(exceeded, std::memory_order_relaxed);
    if (tripped()) return;
    count_saturation(driven.force_device_N, description_.axis_max_force_N, saturation_.force);
    count_saturation(driven.torque_device_Nm, description_.max_torque_Nm, saturation_.torque);
    if (exceeded) {
        tripped_.store(true, std::memory_order_relaxed);
        untold_.store(true, std::memory_order_relaxed);
        ++trips_;
        return let_motors_rest();
    }
    newest_ = (newest_ + 1) % kCommands;
    commands_[newest_] = {driven, time_ns_};
}

AmplifierAnswer SimulatedWand::switch_amplifiers(bool on) noexcept {
    if (on && (exceeding_.load(std::memory_order_relaxed) || is_lost_.load(std::memory_order_relaxed)))
        return AmplifierAnswer::cause_remains;
    tripped_.store(!on, std::memory_order_relaxed);
    if (!on) untold_.store(true, std::memory_order_relaxed);
    return AmplifierAnswer::done;
}

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
#include "activities/train/held_wand.hpp"

#include <algorithm>
#include <cmath>

namespace burin::activities {
namespace {

constexpr double kWandStep_s = 125e-6;
static_assert(HeldWand::kStep_ns == 125'000);
constexpr double kLimpDamping = 0.5;  // of the grip's

double stepped(double value, double step) { return step > 0.0 ? step * std::floor(value / step + 0.5) : value; }

Vec3 stepped(const Vec3& v, double step) { return {stepped(v.x, step), stepped(v.y, step), stepped(v.z, step)}; }

Vec3 braked(const Vec3& v, double brake) {
    const double speed = std::sqrt(glm::dot(v, v));
    return speed <= brake ? Vec3(0.0) : v * (1.0 - brake / speed);
}

// The rotation vector of a turn, for turns well below half a circle.
Vec3 turn_of(Quat q) {
    if (q.w < 0.0) q = -q;
    return {2.0 * q.x, 2.0 * q.y, 2.0 * q.z};
}

Quat unit(const Quat& q) {
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / length, q.x / length, q.y / length, q.z / length};
}

}  // namespace

HeldWand::HeldWand(const devices::DeviceDescription& description, const devices::HandTarget& start,
                   const devices::HandGrip& grip, const TurningGrip& turning)
    : description_(description),
      target_(start),
      grip_(grip),
      turning_(turning),
      position_m_(start.position_device_m),
      orientation_(start.orientation_device) {}

void HeldWand::hold(const devices::HandTarget& target, bool gives_way) noexcept {
    target_ = target;
    gives_way_ = gives_way;
}

void HeldWand::write(const devices::DeviceWrench& wrench) noexcept {
    const Vec3& f = wrench.force_device_N;
    const Vec3& t = wrench.torque_device_Nm;
    acting_ = finite(f) && finite(t) ? wrench : devices::DeviceWrench{};
    const double length = glm::length(acting_.force_device_N);
    if (length > description_.max_force_N) acting_.force_device_N *= description_.max_force_N / length;
    acting_.torque_device_Nm =
        glm::clamp(acting_.torque_device_Nm, -description_.max_torque_Nm, description_.max_torque_Nm);
}

void HeldWand::advance(Nanoseconds dt_ns) noexcept {
    for (Nanoseconds left_ns = dt_ns; left_ns >= kStep_ns; left_ns -= kStep_ns) {
        target_.position_device_m += kWandStep_s * target_.velocity_device_m_per_s;
        step();
        step_turn();
        time_ns_ += kStep_ns;
    }
}

void HeldWand::step() noexcept {
    const double stiffness = gives_way_ ? 0.0 : grip_.stiffness_N_per_m;
    const double grip_damping = gives_way_ ? kLimpDamping * grip_.damping_Ns_per_m : grip_.damping_Ns_per_m;
    const double mass = description_.apparent_mass_kg + grip_.mass_kg;
    Vec3 pull = acting_.force_device_N + stiffness * (target_.position_device_m - position_m_);
    if (!gives_way_) pull += grip_damping * target_.velocity_device_m_per_s;
    const double damping = description_.damping_Ns_per_m + grip_damping;
    const double share = kWandStep_s / mass;
    Vec3 v = (velocity_m_per_s_ + share * pull) / (1.0 + share * damping);
    v = braked(v, share * description_.friction_N);
    position_m_ += kWandStep_s * v;
    const Vec3 half = 0.5 * description_.workspace_m;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(position_m_[axis]) <= half[axis]) continue;
        position_m_[axis] = std::clamp(position_m_[axis], -half[axis], half[axis]);
        v[axis] = 0.0;
    }
    velocity_m_per_s_ = v;
}

void HeldWand::step_turn() noexcept {
    const double stiffness = gives_way_ ? 0.0 : turning_.stiffness_Nm_per_rad;
    const double grip_damping = gives_way_ ? kLimpDamping * turning_.damping_Nms_per_rad : turning_.damping_Nms_per_rad;
    const double inertia = description_.apparent_inertia_kgm2 + turning_.inertia_kgm2;
    const Vec3 pull =
        acting_.torque_device_Nm + stiffness * turn_of(target_.orientation_device * glm::conjugate(orientation_));
    const double damping = description_.angular_damping_Nms_per_rad + grip_damping;
    const double share = kWandStep_s / inertia;
    const Vec3 w =
        braked((turn_rad_per_s_ + share * pull) / (1.0 + share * damping), share * description_.angular_friction_Nm);
    const Vec3 half = 0.5 * kWandStep_s * w;
    orientation_ = unit(Quat(1.0, half.x, half.y, half.z) * orientation_);
    turn_rad_per_s_ = w;
}

devices::DeviceSample HeldWand::read() noexcept {
    devices::DeviceSample sample;
    sample.time_ns = time_ns_;
    sample.position_device_m = stepped(position_m_, description_.resolution_m);
    const Vec3 turn = stepped(turn_of(orientation_), description_.orientation_step_rad);
    const double rest = 1.0 - 0.25 * glm::dot(turn, turn);
    sample.orientation_device = unit(Quat(std::sqrt(std::max(rest, 0.0)), 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z));
    return sample;
}

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
#include "bench/workspace/workspace_hand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::bench {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::array kTremor_Hz{8.3, 9.7, 11.4};

}  // namespace

double Chance::uniform(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(bits_() >> 11) * 0x1p-53; }

// Box-Muller transform.
double Chance::normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return radius * std::cos(kTurn * uniform(0.0, 1.0));
}

ReachingHand::ReachingHand(const HandModel& model, const Vec3& workspace_device_m, std::uint64_t seed)
    : model_(model), half_m_(0.5 * workspace_device_m), chance_(seed) {
    for (double& phase : tremor_rad_) phase = chance_.uniform(0.0, kTurn);
}

Vec3 ReachingHand::missed(const Vec3& goal_device_m, double duration_s) {
    const Vec3 way = goal_device_m - planned_m_;
    const double distance = glm::length(way);
    const Vec3 ahead = distance > 0.0 ? way / distance : Vec3(1, 0, 0);
    const double spread = std::hypot(model_.least_spread_m, model_.spread_s * distance / duration_s);
    Vec3 miss(0.0);
    for (int axis = 0; axis < 3; ++axis) miss[axis] = 0.5 * spread * chance_.normal();
    return goal_device_m + miss +
           ahead * (std::sqrt(0.75) * spread * chance_.normal());  // variances 1/4 + 3/4: the full spread ahead
}

void ReachingHand::aim(const Vec3& goal_device_m) {
    const Vec3 goal = within(goal_device_m);
    const double distance = glm::length(goal - planned_m_);
    move_s_ = model_.shortest_s + model_.per_bit_s * std::log2(1.0 + distance / model_.unit_m);
    goal_m_ = goal;
    in_move_s_ = 0.0;
    const Vec3 end = within(missed(goal, move_s_));
    // x(u) = sum c_i u^i, u = t / T: position, velocity and acceleration
    // are given at u = 0; at u = 1 they are the end, 0 and 0.
    const Vec3 p = planned_m_, v = velocity_m_per_s_ * move_s_, a = acceleration_m_per_s2_ * (move_s_ * move_s_);
    const Vec3 d = end - p;
    path_ = {p, v, 0.5 * a, 10.0 * d - 6.0 * v - 1.5 * a, -15.0 * d + 8.0 * v + 1.5 * a, 6.0 * d - 3.0 * v - 0.5 * a};
}

Vec3 ReachingHand::tremor(double time_s) const {
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < tremor_rad_.size(); ++i)
        sum[static_cast<int>(i % 3)] += std::sin(kTurn * kTremor_Hz[i / 3] * time_s + tremor_rad_[i]);
    return sum * (model_.tremor_m / std::sqrt(1.5));  // three sines of amplitude 1 have an rms of sqrt(3/2)
}

Vec3 ReachingHand::step(const Vec3& force_device_N, double dt_s) {
    time_s_ += dt_s;
    in_move_s_ += dt_s;
    if (moving()) {
        const double u = in_move_s_ / move_s_;
        planned_m_ = velocity_m_per_s_ = acceleration_m_per_s2_ = Vec3(0.0);
        for (int i = 5; i >= 0; --i) planned_m_ = planned_m_ * u + path_[static_cast<std::size_t>(i)];
        for (int i = 5; i >= 1; --i)
            velocity_m_per_s_ = velocity_m_per_s_ * u + i * 1.0 * path_[static_cast<std::size_t>(i)];
        for (int i = 5; i >= 2; --i)
            acceleration_m_per_s2_ = acceleration_m_per_s2_ * u + i * (i - 1.0) * path_[static_cast<std::size_t>(i)];
        velocity_m_per_s_ /= move_s_;
        acceleration_m_per_s2_ /= move_s_ * move_s_;
    } else {
        velocity_m_per_s_ = acceleration_m_per_s2_ = Vec3(0.0);
    }
    yielded_m_ += (force_device_N / model_.grip_N_per_m - yielded_m_) * std::min(1.0, dt_s / model_.yield_s);
    position_m_ = within(planned_m_ + yielded_m_ + tremor(time_s_));
    return position_m_;
}

}  // namespace burin::bench

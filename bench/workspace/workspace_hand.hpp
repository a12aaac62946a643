// SPDX-License-Identifier: MIT
// Simulates a hand that reaches: aimed movements with the errors that aimed movements have, tremor, and a grip that
// yields. Device frame, SI units, one step a millisecond. A model, not people: it has no fatigue, no learning and no
// strategy of its own (for that see bench/workspace/workspace_strategy.hpp).
//
// A submovement runs from the hand's position, velocity and acceleration to rest at its goal along the polynomial of
// fifth degree, which is the minimum-jerk path (Flash and Hogan 1985). It lasts 0.12 s + 0.06 s log2(1 + D / 2 mm):
// 0.46 s for 100 mm, 0.18 s for 2 mm (a form after Fitts; the constants are assumed). Its end point has a normal error
// whose spread is proportional to its mean speed (Schmidt et al. 1979, Meyer et al. 1988): 20 ms times D/T along the
// path, half of it across, and never below 0.2 mm (the constants are assumed). Corrections are further submovements, as
// in Meyer's model. Tremor: three sines of 8 to 12 Hz, 0.08 mm rms an axis. The grip yields to the device's force by 5
// mm a newton (200 N/m, as of the simulated hand in devices/) with a time constant of 30 ms. The hand stops at the
// limits of the device's box.
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "base/space.hpp"

namespace burin::bench {

struct HandModel {
    double shortest_s = 0.12, per_bit_s = 0.06, unit_m = 0.002;  // of a submovement
    double spread_s = 0.02, least_spread_m = 0.0002;
    double tremor_m = 0.00008;  // rms, an axis
    double grip_N_per_m = 200.0, yield_s = 0.03;
};

// A random generator that gives the same numbers from the same seed
// on every machine (the standard's own distributions may differ).
class Chance {
public:
    explicit Chance(std::uint64_t seed) : bits_(seed) {}
    [[nodiscard]] double uniform(double lo, double hi);
    [[nodiscard]] double normal();  // mean 0, deviation 1

private:
    std::mt19937_64 bits_;
};

class ReachingHand {
public:
    ReachingHand(const HandModel& model, const Vec3& workspace_device_m, std::uint64_t seed);

    void aim(const Vec3& goal_device_m);
    // Advances by dt_s under the device's force and returns the hand's position.
    Vec3 step(const Vec3& force_device_N, double dt_s);

    [[nodiscard]] bool moving() const { return in_move_s_ < move_s_; }
    [[nodiscard]] const Vec3& position_device_m() const { return position_m_; }  // with tremor
    [[nodiscard]] const Vec3& goal_device_m() const { return goal_m_; }  // the intended goal, without the aiming error

private:
    [[nodiscard]] Vec3 missed(const Vec3& goal_device_m, double duration_s);
    [[nodiscard]] Vec3 tremor(double time_s) const;
    [[nodiscard]] Vec3 within(const Vec3& p) const { return glm::clamp(p, -half_m_, half_m_); }

    HandModel model_;
    Vec3 half_m_;
    Chance chance_;
    std::array<double, 9> tremor_rad_{};  // phases: three sines for each axis
    std::array<Vec3, 6> path_{};          // polynomial of the submovement in time over its duration, by powers
    Vec3 goal_m_{0.0};
    double move_s_ = 0.0, in_move_s_ = 0.0, time_s_ = 0.0;
    Vec3 planned_m_{0.0}, velocity_m_per_s_{0.0}, acceleration_m_per_s2_{0.0};
    Vec3 yielded_m_{0.0}, position_m_{0.0};
};

}  // namespace burin::bench

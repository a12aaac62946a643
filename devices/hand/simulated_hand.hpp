// SPDX-License-Identifier: MIT
// A scripted hand: its desired pose at each time, and how firmly it holds the stylus.
//
// The script is a list of time-stamped poses in the device frame (metres, seconds since the start). Between poses
// positions follow straight lines or a monotone cubic (Fritsch and Carlson 1980: passes through the poses without
// overshoot), and orientations a normalised linear interpolation of quaternions. Before the first pose and after the
// last one the hand rests. Buttons hold from one pose to the next. Only +, -, *, / and sqrt are used, so that every
// machine computes the same bits.
//
// The grip: F = K (target - p) + B (d target/dt - p') plus the hand's mass on the stylus. Mass and damping are of the
// size of a hand tapping a wall (0.1 kg, 3 Ns/m, 100 N/m). A hand that follows a path holds more firmly: the Omni's
// 0.26 N of friction alone would leave it 2.6 mm behind at 100 N/m. With 200 N/m that is 1.3 mm, and 6 Ns/m makes the
// 145 g of hand and stylus settle (damping ratio 0.56). So a slow path is followed within 2 mm in free air, and a
// target 5 mm behind a wall's surface presses the wall with about 1 N.
#pragma once

#include <cstdint>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "devices/hand/hand_target.hpp"

namespace burin::devices {

struct HandPose {
    double time_s = 0.0;
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    std::uint32_t buttons = 0;
};

enum class HandPath : std::uint8_t { straight, monotone_cubic };

// In rotation likewise, for devices whose handle turns under torque (a wand, not a stylus): T = K_r turn + B_r (w
// target - w), with a fist's inertia. 2 Nm/rad is about a wrist's own stiffness: the 0.23 Nm that a wand gives turn it
// by 0.1 rad. 0.05 Nms/rad makes fist and handle settle (damping ratio 0.46).
struct HandGrip {
    double mass_kg = 0.1;
    double stiffness_N_per_m = 200.0;
    double damping_Ns_per_m = 6.0;
    double inertia_kgm2 = 0.001;
    double torsion_Nm_per_rad = 2.0;
    double angular_damping_Nms_per_rad = 0.05;
};

// Whether every number of a grip is finite and not negative.
[[nodiscard]] inline bool is_sensible(const HandGrip& grip) noexcept {
    return not_negative(grip.mass_kg) && not_negative(grip.stiffness_N_per_m) && not_negative(grip.damping_Ns_per_m) &&
           not_negative(grip.inertia_kgm2) && not_negative(grip.torsion_Nm_per_rad) &&
           not_negative(grip.angular_damping_Nms_per_rad);
}

// Immutable after create(); any thread may call target().
class SimulatedHand {
public:
    // Fails on an empty script, times that do not rise, numbers that are not finite, a quaternion of zero length
    // (others are normalised), and a grip with negative numbers.
    [[nodiscard]] static Result<SimulatedHand> create(std::vector<HandPose> script, HandPath path = HandPath::straight,
                                                      HandGrip grip = {});

    // The hand's desired state at a time.
    // Wait-free, no heap: a binary search and a few products.
    [[nodiscard]] HandTarget target(double time_s) const noexcept;
    [[nodiscard]] const HandGrip& grip() const noexcept { return grip_; }
    [[nodiscard]] double end_s() const noexcept { return script_.back().time_s; }

private:
    SimulatedHand() = default;
    std::vector<HandPose> script_;
    std::vector<Vec3> slopes_m_per_s_;  // of the monotone cubic, at each pose
    HandPath path_ = HandPath::straight;
    HandGrip grip_;
};

}  // namespace burin::devices

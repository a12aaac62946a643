// SPDX-License-Identifier: MIT
// The mechanism behind a wand's handle: its linkages, encoders, motors and amplifiers, and what their numbers mean for
// the joints. The defaults are those of the Quanser 5-DOF wand as the maker's example program has them
// (github.com/quanser/quanser_sdk_examples, C/hardware/haptic_wand_example); none has been compared with a device.
// Joints and channels count as twin_pantograph.hpp does. Pure; any thread; no heap.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "devices/haptic/joints.hpp"
#include "devices/haptic/twin_pantograph.hpp"

namespace burin::devices {

struct WandMechanism {
    TwinPantograph arm;
    std::string card = "q8";  // the type of the card, as the maker's library calls it
    double counts_a_turn = 20'000.0;
    WandJoints encoder_sign{1.0, 1.0, -1.0, -1.0, 1.0, 1.0};
    // Where the joints are in the jig, in which all encoders are set to 0.
    WandJoints jig_rad{0.12760527954869, 3.0139873740411, 0.12760527954869, 3.0139873740411, 0.0, 0.0};
    WandJoints torque_Nm_per_A{0.0525, 0.0525, 0.0525, 0.0525, 0.191, 0.191};  // at the joint
    WandJoints most_A{2.15, 2.15, 2.15, 2.15, 1.69, 1.69};                     // for as long as one likes
    double volts_per_A = 0.5;                                                  // into an amplifier
    WandJoints motor_sign{1.0, 1.0, -1.0, -1.0, 1.0, 1.0};
    std::array<std::uint32_t, kWandJoints> enable_lines{0, 1, 2, 3, 16, 17};  // digital outputs of the amplifiers
    // How far the tips may seem further apart or nearer than the handle is long: beyond it an encoder has lost counts.
    double handle_tolerance_m = 0.01;
    bool operator==(const WandMechanism&) const = default;
};

[[nodiscard]] WandJoints joints_of_counts(const WandMechanism& wand,
                                          const std::array<std::int32_t, kWandJoints>& counts);
// Returns the nearest counts, which need not be whole of an encoder that is not read.
[[nodiscard]] WandJoints counts_of_joints(const WandMechanism& wand, const WandJoints& joints_rad);

// What the amplifiers are told for torques at the joints. Where a motor would get more than it bears, all get less, so
// that the direction of the force stays; `limited` has such a motor's bit. Where a torque or a current is no number,
// all get zero, and it is not sound: a fault.
struct WandVolts {
    WandJoints volts{};
    std::uint32_t limited = 0;
    bool is_sound = true;
};
[[nodiscard]] WandVolts volts_of_torques(const WandMechanism& wand, const WandJoints& torques_Nm);
[[nodiscard]] WandJoints torques_of_volts(const WandMechanism& wand, const WandJoints& volts);

// Returns what the joints are to those who record and draw them.
[[nodiscard]] Joints joints_of(const WandMechanism& wand);

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
#include "devices/haptic/wand_mechanism.hpp"

#include <algorithm>
#include <cmath>

namespace burin::devices {
namespace {

constexpr double kTurn_rad = 2.0 * 3.14159265358979323846;

}  // namespace

WandJoints joints_of_counts(const WandMechanism& wand, const std::array<std::int32_t, kWandJoints>& counts) {
    WandJoints joints;
    for (std::size_t i = 0; i < kWandJoints; ++i)
        joints[i] = wand.jig_rad[i] + wand.encoder_sign[i] * kTurn_rad / wand.counts_a_turn * counts[i];
    return joints;
}

WandJoints counts_of_joints(const WandMechanism& wand, const WandJoints& joints_rad) {
    WandJoints counts;
    for (std::size_t i = 0; i < kWandJoints; ++i)
        counts[i] =
            std::floor(wand.encoder_sign[i] * (joints_rad[i] - wand.jig_rad[i]) * wand.counts_a_turn / kTurn_rad + 0.5);
    return counts;
}

WandVolts volts_of_torques(const WandMechanism& wand, const WandJoints& torques_Nm) {
    WandVolts given;
    WandJoints current_A;
    double share = 1.0;
    for (std::size_t i = 0; i < kWandJoints; ++i) {
        current_A[i] = torques_Nm[i] / wand.torque_Nm_per_A[i];
        if (!std::isfinite(current_A[i])) return {.volts = {}, .limited = 0, .is_sound = false};
        if (!(std::abs(current_A[i]) > wand.most_A[i])) continue;
        share = std::min(share, wand.most_A[i] / std::abs(current_A[i]));
        given.limited |= 1u << i;
    }
    for (std::size_t i = 0; i < kWandJoints; ++i)
        given.volts[i] = wand.motor_sign[i] * wand.volts_per_A * share * current_A[i];
    return given;
}

WandJoints torques_of_volts(const WandMechanism& wand, const WandJoints& volts) {
    WandJoints torques_Nm;
    for (std::size_t i = 0; i < kWandJoints; ++i)
        torques_Nm[i] = wand.motor_sign[i] * volts[i] / wand.volts_per_A * wand.torque_Nm_per_A[i];
    return torques_Nm;
}

Joints joints_of(const WandMechanism& wand) {
    Joints joints;
    joints.count = kWandJoints;
    for (std::size_t i = 0; i < kWandJoints; ++i)
        joints.all[i] = {JointKind::hinge, kTurn_rad / wand.counts_a_turn, 0.0, 0.0,
                         wand.torque_Nm_per_A[i] * wand.most_A[i]};
    return joints;
}

}  // namespace burin::devices

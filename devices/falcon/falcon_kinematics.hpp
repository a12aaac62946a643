// SPDX-License-Identifier: MIT
// Where the grip of a Novint Falcon is, and what its motors have to give: a delta of three legs.
//
// Model (R. E. Stamper, A Three Degree of Freedom Parallel Manipulator with Only Translational Degrees of Freedom,
// 1997): each leg is a driven arm that turns in a plane through the axis of the base, and a parallelogram that joins
// its end to the grip. In the leg's frame, u outwards from the axis, v across and w along it, the grip at p has
//   p_u + c = a cos(angle) + L cos(phi),  p_w = a sin(angle) + L sin(phi),  L = d + e + sqrt(b^2 - (p_v + f)^2)
// with the origin of u and v moved by r and s; phi is the parallelogram's. Lengths, the legs' directions and the
// encoders' gearing are those of libnifalcon (f7c727a, FalconGeometry.h), where they are measured values.
// Frame: the Falcon's own, metres: +x to the right, +y up, +z out of the base to the user; its origin is in the base,
// and the middle of the workspace kFalconMiddle_m before it. Angles in radians, torques of the arms in newton metres.
// Pure; any thread; no heap, lock or throw; loops of at most kFalconSteps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/space.hpp"

namespace burin::devices {

inline constexpr std::size_t kFalconLegs = 3;
using FalconAngles = std::array<double, kFalconLegs>;
using FalconCounts = std::array<std::int16_t, kFalconLegs>;  // of the encoders or, as commands, of the motors

inline constexpr Vec3 kFalconMiddle_m{0.0, 0.0, 0.1245};
inline constexpr int kFalconSteps = 30;
// The box of four inches needs angles from -1.02 to 2.08 of the arms; beyond these no Falcon is.
inline constexpr double kFalconLeast_rad = -1.3, kFalconMost_rad = 2.3;

// Returns the angles of the arms by the encoders, and what encoders would read.
[[nodiscard]] FalconAngles falcon_angles(const FalconCounts& encoders) noexcept;
[[nodiscard]] FalconCounts falcon_encoders(const FalconAngles& angles) noexcept;

// Returns the angles at which the grip is there; nothing where it cannot be.
[[nodiscard]] std::optional<FalconAngles> falcon_inverse(const Vec3& grip_m) noexcept;

struct FalconPose {
    Vec3 grip_m{0.0};
    // How the grip moves with each arm's angle: metres a radian.
    std::array<Vec3, kFalconLegs> moves_m_per_rad{};
};
// Returns where the grip is, exact to rounding, by Newton's method from `near_m`, such as where it was; nothing where
// the angles belong to no place of the grip before the base.
[[nodiscard]] std::optional<FalconPose> falcon_forward(const FalconAngles& angles,
                                                       const Vec3& near_m = kFalconMiddle_m) noexcept;

// Returns the torques by which the arms give a force at the grip: they do the same work, whichever way it moves.
[[nodiscard]] FalconAngles falcon_torques(const FalconPose& pose, const Vec3& force_N) noexcept;

// Commands of the motors. kFalconCommands_per_Nm is libnifalcon's figure, by which its forces are newtons; the firmware
// takes no more than kFalconMostCommand either way. Where a motor would have to give more, all give less by the same
// share, so that the force keeps its direction.
inline constexpr double kFalconCommands_per_Nm = 10000.0;
inline constexpr int kFalconMostCommand = 4096;
[[nodiscard]] FalconCounts falcon_commands(const FalconAngles& torques_Nm) noexcept;
// Returns the torques that commands stand for, for emulators.
[[nodiscard]] FalconAngles falcon_torques_of(const FalconCounts& commands) noexcept;
// Returns the force at the grip that torques give.
[[nodiscard]] Vec3 falcon_force(const FalconPose& pose, const FalconAngles& torques_Nm) noexcept;

}  // namespace burin::devices

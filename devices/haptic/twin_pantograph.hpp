// SPDX-License-Identifier: MIT
// Kinematics of a twin pantograph: a handle between the tips of two planar five-bar linkages, one above the other, each
// of which swings about a waist axis of its own. It moves in three directions and nods in two; about its own axis it
// turns freely, and nothing measures or drives that (yaw). Six joints for five degrees: the distance between both tips
// is the handle's length, which the joints measure once too often.
//
// Frame (the mechanism's): x along the waist axes, through the middle between a linkage's two shoulders; y outwards
// from the waists to the handle; z from the lower linkage to the upper; the origin in the middle of all four shoulders.
// Joints, in the order of the maker's channels: the upper linkage's shoulder at +x and at -x, the lower's at +x and at
// -x, the upper waist, the lower waist. A shoulder's angle is its link's from +x towards y, a waist's from y towards z.
// Metres, radians, newtons.
//
//   in a linkage's plane, s the shoulders' distance, u and f the links:
//     elbows  E = (+-s/2, 0) + u (cos q, sin q);  tip P: |P - E| = f for both, on the outer side
//   of the upper linkage, w its waist and o how far above its plane the tip is:
//     tip = (P.x, P.y cos w - o sin w, P.y sin w + o cos w + waists/2); the lower one mirrored in z
//   handle: its middle between both tips, its axis from the lower to the upper
//   tips' forces of a force F and a torque T on the handle of length L and axis a:  F/2 +- (T x a) / L
//   motors: each linkage's Jacobian, transposed, times its tip's force; so power is the same at handle and motors
//
// Source of the shape: the thesis (two pantographs, six motors, waists) and Stocco, Salcudean and Sassani, "Optimal
// Kinematic Design of a Haptic Pen" (2001); of the Quanser wand's lengths: the maker's example program,
// github.com/quanser/quanser_sdk_examples, C/hardware/haptic_wand_example (haptic_wand.h). The solution is our own.
// Pure; any thread; no heap.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/space.hpp"

namespace burin::devices {

inline constexpr std::size_t kWandJoints = 6;
using WandJoints = std::array<double, kWandJoints>;

struct TwinPantograph {
    // Of the Quanser wand. The maker gives inches.
    double shoulders_m = 1.750 * 0.0254;                     // between the two of a linkage
    double upper_m = 5.670 * 0.0254;                         // from shoulder to elbow
    double fore_m = 7.717 * 0.0254;                          // from elbow to tip
    double waists_m = 7.000 * 0.0254;                        // from axis to axis
    double offset_m = (2.078363285 - 1.417202685) * 0.0254;  // of a tip from its linkage's plane, away from the other
    bool operator==(const TwinPantograph&) const = default;
};

// Returns how long the handle is, from tip to tip: as far as both tips are apart where both planes are level.
[[nodiscard]] constexpr double handle_length_m(const TwinPantograph& arm) noexcept {
    return arm.waists_m + 2.0 * arm.offset_m;
}

// Both tips, in the mechanism's frame.
struct WandTips {
    Vec3 upper_m{0.0}, lower_m{0.0};
};
// A handle's pose without its turn about itself.
struct WandAxis {
    Vec3 middle_m{0.0};
    Vec3 along{0.0, 0.0, 1.0};  // unit, from the lower to the upper tip
};

// Returns where the tips are; nothing where the elbows of a linkage are further apart than both fore links reach, or
// where these are in one line within kStretched of that, so that the tip could be on either side.
inline constexpr double kStretched = 1e-3;
[[nodiscard]] std::optional<WandTips> wand_tips(const TwinPantograph& arm, const WandJoints& joints) noexcept;
[[nodiscard]] WandAxis wand_axis(const WandTips& tips) noexcept;
// Returns how much further apart the tips are than the handle is long: 0 but for the encoders' steps where all joints
// are read well.
[[nodiscard]] double handle_error_m(const TwinPantograph& arm, const WandTips& tips) noexcept;
// Returns the pose that turns the handle's z onto its axis the shortest way.
[[nodiscard]] Pose pose_of(const WandAxis& axis) noexcept;
[[nodiscard]] WandAxis axis_of(const Pose& mechanism_from_handle) noexcept;

// Returns the joints that hold the handle so, elbows outwards; nothing where the linkages do not reach that far.
[[nodiscard]] std::optional<WandJoints> wand_joints(const TwinPantograph& arm, const WandAxis& axis) noexcept;

// How both tips move with their own three joints (two shoulders and the waist), by columns; m/rad.
struct WandJacobian {
    glm::dmat3 upper{0.0}, lower{0.0};
};
// Where wand_tips() gives something.
[[nodiscard]] std::optional<WandJacobian> wand_jacobian(const TwinPantograph& arm, const WandJoints& joints) noexcept;

struct WandForce {
    Vec3 force_N{0.0}, torque_Nm{0.0};  // about the handle's middle
};
// Returns the motors' torques that push the handle so; what the torque has along the handle's axis is left out, as
// nothing drives that.
[[nodiscard]] WandJoints motor_torques_Nm(const TwinPantograph& arm, const WandAxis& axis, const WandJacobian& jacobian,
                                          const WandForce& force) noexcept;
// Returns what the motors' torques do at the handle; nothing where a linkage gives way in some direction, whatever its
// motors do.
[[nodiscard]] std::optional<WandForce> force_of(const TwinPantograph& arm, const WandAxis& axis,
                                                const WandJacobian& jacobian, const WandJoints& torques_Nm) noexcept;

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// Magnetic guidance: a force that draws the tool to a curve, as training asks for.
//
// The nearest point q of a polyline attracts the middle c of the probe's n points, d = |q - c| / g (g the gain). Where
// an orientation R is set, each point h_i is drawn to its own place q_i = q + g R (T_i - mean T), T_i its offset at the
// device; else q_i - h_i = q - c for all. So a stylus is drawn by its tip, and a wand's two ends are led side by side:
//     F_i = (min(k/n |q_i - h_i| / g, max/n) n_i - b/n v_across,i) * fade      n_i to the point, |F_i| at most max/n
//     F = sum F_i                                      and where an orientation is set
//     torque = sum r_i x F_i                           r_i = R_device T_i, about the device's position
//     fade = 1 up to three quarters of the reach, from there falling linearly to 0 at its end
// The damping acts across the curve; along it the tool is free, unless a lead speed is set: then q runs along the curve
// with it and takes the hand along. It waits for a hand that lags: full speed up to a quarter of the reach, none beyond
// half of it. It stops at the curve's end.
// `repels` turns the springs around: the tool is pushed off the curve, as training that augments errors asks for. It
// then leads nowhere and turns nothing.
// The force is continuous in the tool's position except where two stretches of the curve are equally near; there the
// stretch held last is kept until the other is nearer by a tenth of the reach.
// Frame: object in, device out. Ownership: the curve is the publisher's and stays in memory while it is published
// (TickParameters are borrowed whole). Work: twice kMostCurvePoints segments a tick at most. Pure; no heap, lock or
// throw.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/space.hpp"
#include "haptics/contact/probe.hpp"

namespace burin::haptics {

inline constexpr std::uint32_t kMostCurvePoints = 256;

struct GuidanceCurve {
    std::uint32_t count = 0;  // 0: no guidance; else 2 to kMostCurvePoints
    std::array<Vec3f, kMostCurvePoints> points_object_m{};
};

struct GuidanceSettings {
    double stiffness_N_per_m = 0.0;  // at the device; 0: off
    double damping_Ns_per_m = 0.0;   // at the device, across the curve
    double max_force_N = 1.5;
    double reach_m = 0.02;  // object frame
    // Object frame; below 0 backwards; 0: the tool is free along the curve.
    double lead_speed_m_per_s = 0.0;
    bool repels = false;
    // Draws each point to its place in this orientation, so that the tool is turned as well.
    bool holds_orientation = false;
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};  // unit; object_from_tool
};

struct GuidanceState {
    double along_m = 0.0;  // arc length of the attracting point, object frame
    bool held = false;
};

// One point of the probe.
struct GuidedPoint {
    Vec3 hip_object_m{0.0};
    Vec3 offset_device_m{0.0};  // T_i, in the tool's axes
    Vec3 arm_device_m{0.0};     // r_i
};

struct GuidanceInput {
    std::span<const GuidedPoint> points;  // 1 to kMostProbePoints
    Vec3 velocity_device_m_per_s{0.0};
    Vec3 angular_velocity_device_rad_per_s{0.0};
    Quat object_from_device_orientation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;  // object metres per device metre
    double dt_s = 0.0;
};

struct GuidanceStep {
    GuidanceState next;
    Vec3 force_device_N{0.0};
    Vec3 torque_device_Nm{0.0};
    double distance_m = 0.0;  // to the attracting point, object frame; 0 when not held
};

[[nodiscard]] GuidanceStep guide(const GuidanceState& state, const GuidanceInput& input, const GuidanceCurve& curve,
                                 const GuidanceSettings& settings) noexcept;

}  // namespace burin::haptics

// SPDX-License-Identifier: MIT
// Cutting forces: the tool advances into the material at a rate set by force and hardness.
//
// The surface that the tick knows is some milliseconds old, and the proxy p rests on it. Between p and the HIP h lies
// material that the hand presses into. The cutting point c is where the tool has cut to; it bears the tool with F = k
// (h - c). Each element of the ball's engaged surface that moves into material is resisted along its normal m by the
// pressure H (v . m), H the hardness and v = dc/dt. Summed over the engaged surface:
//     F_n = H (A_nn v_n + A_nt v_t)      F_t = H (A_nt v_n + A_tt v_t)      A_ij = integral of m_i m_j
// n the direction into the material, t across it. Pressed straight in, the tool sinks at F / (H A_nn). Moved along the
// surface it is resisted by H A_tt v_t and lifted by H A_nt v_t, so it runs at the depth where the lift balances the
// press: deeper with more force, softer material and less speed. The hand feels k (c - h) at 1 kHz, however seldom the
// carved surface is published; the carving side sweeps the tool along c. When the surface with the cut arrives the
// proxy comes down to c, and c stays.
//
// For a ball of radius R at depth d, x = d / R <= 1 (deeper it is as at x = 1, half the ball):
//     A_nn = 2 pi R^2 (x - x^2 + x^3 / 3)             the whole cap
//     A_tt = pi / 2 R^2 (x^2 - x^3 / 3)               its front half
//     A_nt = 2/3 R^2 (x (2 - x))^(3/2)                likewise
// d is the depth that the known surface shows at the proxy (haptics/forces/engagement.hpp) plus the distance of c ahead
// of the proxy.
//
// Bounds: the force is never more than the uncut surface would give, |h - c| <= |h - p| + slack: where the proxy moves
// freely, c is drawn after it. The slack is the difference in radius between the ball that cuts and the ball that
// touches: without it each new surface would move c on by this difference, and the tool would sink without a force. c
// is never deeper than the hand.
// The step is implicit, so that any hardness and any period are stable: hardness 0 cuts without resistance (c = h),
// infinite hardness does not cut (c = p). The material only absorbs energy: F . dc >= 0. Lengths at the device are
// shorter by the gain g, areas by g^2.
// Frame: object, metres. Pure; no clock, heap, lock or throw; + - * / and sqrt only, so that every machine gives the
// same bits.
#pragma once

#include "base/space.hpp"
#include "haptics/forces/engagement.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::haptics {

struct CuttingState {
    Vec3 point_object_m{0.0};  // c, the cutting point
    bool engaged = false;      // false: c is the proxy
    // Engagement at the proxy and the position at which it was computed.
    Engagement known;
    Vec3 looked_at_object_m{0.0};
    std::uint64_t surface_sequence = 0;
};

struct CuttingInput {
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};  // on the known surface; the HIP itself in free space
    Vec3 normal_object{0.0};   // contact normal, unit; the outward direction where the engagement shows none
    Vec3 velocity_device_m_per_s{0.0};
    double scale = 1.0;              // object metres per device metre
    double tool_radius_m = 0.0;      // object frame; a point has no area and cuts without resistance
    double slack_m = 0.0;            // object frame; how far the proxy may be ahead of c
    bool cutting = false;            // in contact, the button is pressed and the tool cuts
    double stiffness_N_per_m = 0.0;  // at the device, after the limiter
    double dt_s = 0.0;
};

struct CuttingStep {
    CuttingState next;
    Vec3 bearing_object_m{0.0};      // where the spring pulls the hand: c while cutting, else the proxy
    Vec3 drag_device_N{0.0};         // viscous, against the motion
    double engaged_depth_m = 0.0;    // object frame: d
    double engaged_area_m2 = 0.0;    // at the device: A_nn
    double cut_speed_m_per_s = 0.0;  // of c, at the device
};

// Engaged areas of a ball, in any unit of length; depth >= 0.
struct EngagedAreas {
    double into_m2 = 0.0, across_m2 = 0.0, lift_m2 = 0.0;  // A_nn, A_tt, A_nt
};
[[nodiscard]] EngagedAreas engaged_areas(double radius_m, double depth_m) noexcept;

// Moves the cutting point for one tick. Uses state.known as it is; look_at() refreshes it.
[[nodiscard]] CuttingStep cut(const CuttingState& state, const CuttingInput& input,
                              const TouchMaterial& material) noexcept;

// Recomputes the engagement when the surface is new or the proxy has moved by a tenth of the tool's radius.
struct LookedAt {
    CuttingState next;
    std::uint32_t triangles_seen = 0;
};
[[nodiscard]] LookedAt look_at(const CuttingState& state, const CuttingInput& input,
                               const geometry::LocalSurface& surface) noexcept;

}  // namespace burin::haptics

// SPDX-License-Identifier: MIT
// Cutting forces: any tool advances into the material where the hand presses harder than the material bears.
//
// The surface that the tick knows is some milliseconds old, and the tool's balls rest on it (haptics/contact/). Beyond
// it lies material that the hand, at the HIP h, presses into. The cutting point c is where the tool has cut to; it
// bears the tool with F = k (h - c). Each element of the tool's surface that is engaged (haptics/forces/engagement.hpp)
// and moves into material, v_n = v . m > 0 with m its outward normal, is resisted along m by the pressure
//     p = p0 + H v_n
// the linear chip law: force on a cutting edge is K_c times the chip's section plus an edge force F_e that no chip is
// too thin for. For a driven cutter of tooth spacing s, cutting speed v_c and thrust ratio r it gives H = r K_c / v_c
// and p0 = r F_e / s (docs/decisions/024-cutting-with-any-tool.md). So a tool that is pressed lightly, F < p0 A, holds
// still; beyond that it sinks at (F / A - p0) / H; and drawn along it runs at the depth where the lift of what lies
// ahead bears the press, deeper with more force, softer material and less speed.
//
// Below the yield the material holds the tool along its surface too, by friction: an element that is pressed with less
// than p0 resists motion along itself by up to mu times its pressure, mu the material's static friction and at least a
// quarter. Else a tilted tool would slip along its own face, which moves into nothing. The pressure is that of the last
// step. An element that cuts is held back by the chip law alone, which is for the whole force of a cutter.
//
// A step is the least of a convex function of the way u that c goes in the period, and so unique, stable for any
// hardness and any period, and never adds energy: F . u >= 0 while the tool does not turn.
//     K / 2 |x - u|^2 + sum A (p0' w + H w^2 / 2 + q |u - (m . u) m|)
//     w = max(0, m . u + turn - gap),  K = k g^2 dt,  p0' = p0 g dt,  q = mu times the last pressure, or 0
// x from c to h, `turn` the element's own motion along m because the hand turns the tool, `gap` how far it is from the
// material. Found by Newton's method. The stresses below the yield and of friction rise over kCreep of the tool's size
// a tick: three nanometres a second for a tool of 3 mm. The torque is that of the elements' stresses about the tool's
// origin.
//
// Bounds: the force is never more than the uncut surface would give, |h - c| <= |h - p| + slack, p the tool's proxy:
// where the proxy moves freely, c is drawn after it. The slack is the difference between the tool that cuts and the
// balls that touch, and a little more: without it each new surface would move c on by this difference, and the tool
// would sink without a force. For the same reason the tool cuts whether its balls touch or not: in free space nothing
// bears it, and c is at the hand. Hardness 0 without p0 cuts without resistance (c = h), infinite hardness does not cut
// (c = p). And c goes no farther from the proxy than the proxy's surroundings are looked at: beyond, nothing would bear
// it. Lengths at the device are shorter by the gain g, areas by g^2.
// Grain: both figures may swell and fall with the place along an axis, as the rings of a tree do.
// Frame: object, metres. Pure; no clock, heap, lock or throw; + - * / and sqrt only, so that every machine gives the
// same bits.
#pragma once

#include <optional>

#include "base/space.hpp"
#include "haptics/forces/engagement.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::haptics {

inline constexpr double kCreep = 1e-9;  // of the tool's size a tick

struct CuttingState {
    Vec3 point_object_m{0.0};                     // c, the cutting point
    bool engaged = false;                         // false: c is the proxy
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};  // of the last tick
    Vec3 step_object_m{0.0};                      // of the last tick, where the search begins
    std::uint32_t terms = 0;                      // of the last tick
    Engagement known;
};

struct CuttingInput {
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};  // of the tool, on the known surface; the HIP itself in free space
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Vec3 velocity_device_m_per_s{0.0};
    double scale = 1.0;              // object metres per device metre
    double slack_m = 0.0;            // object frame; how far the proxy may be ahead of c
    bool cutting = false;            // the button is pressed and the tool cuts
    bool in_contact = false;         // the balls touch
    double stiffness_N_per_m = 0.0;  // at the device, after the limiter
    double dt_s = 0.0;
    std::uint32_t most_terms = 0xffffffffu;  // of the work; with less the tool goes less far in this tick
};

struct CuttingStep {
    CuttingState next;
    Vec3 bearing_object_m{0.0};      // where the spring pulls the hand: c while cutting, else the proxy
    Vec3 drag_device_N{0.0};         // viscous, against the motion, also against one out of the material
    Vec3 torque_device_Nm{0.0};      // of the material on the tool, about its origin, in the object's axes
    double engaged_area_m2 = 0.0;    // at the device: of all engaged elements that do not move out of the material
    double cut_speed_m_per_s = 0.0;  // of c, at the device
    std::uint32_t terms = 0;         // elements times iterations: the work done
};

// Moves the cutting point for one tick. Uses state.known as it is; look_at() refreshes it.
[[nodiscard]] CuttingStep cut(const CuttingState& state, const CuttingInput& input, const ToolSurface& tool,
                              const TouchMaterial& material) noexcept;

// Looks at the surface anew when it is another or the tool has moved by a tenth of its size or turned by as much, with
// at most the work given. A look that needed more leaves what was known, and the next one is coarser.
struct LookedAt {
    Engagement known;
    EngagementWork work;
};
// What contact leaves to a tool that cuts: for its look, where there was no work for one in the last tick or the
// surface is another, and for its step. For a ball as much as they took last. Contact of a tool with a shape may use
// all that it is given where a surface is new: it has it all in that tick, and the look as much as it may need in the
// next.
struct CuttingReserve {
    double look_ns = 0.0, step_ns = 0.0;
};
[[nodiscard]] CuttingReserve reserve_for(const CuttingState& state, const geometry::LocalSurface& surface,
                                         double budget_ns, bool has_shape) noexcept;
[[nodiscard]] LookedAt look_at(const CuttingState& state, const CuttingInput& input, const ToolSurface& tool,
                               const geometry::LocalSurface& surface, const EngagementWork& most) noexcept;

// Returns the middle of the pressure with which a tool that touches bears on the surface known, in the object frame:
// each engaged element bears by how deep it would lie where the hand is. Nothing where none would.
[[nodiscard]] std::optional<Vec3> middle_of_bearing(const Engagement& known, const CuttingInput& input,
                                                    const ToolSurface& tool) noexcept;

}  // namespace burin::haptics

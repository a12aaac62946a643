// SPDX-License-Identifier: MIT
// One tick of the haptic loop as a pure function: a sample, a surface and settings in, a force out.
//
// Data flow: device sample -> object frame (Similarity) -> proxy by god_object.hpp -> F = k dx + b v -> device frame.
// The safety gate comes after (haptics/safety_gate.hpp): the force here is what is wanted, not what is given.
// Position gain g: points are scaled by g, forces divided by g, so that stiffness and damping are felt at the device as
// set, whatever the scale of the scene. Damping acts along the contact normal, in contact only, and never pulls
// the tool into the surface.
// Rules: no clock, heap, lock, throw, file; loops are bounded and their work is counted. The same inputs give the same
// bits.
#pragma once

#include "haptics/channels.hpp"
#include "haptics/god_object.hpp"
#include "haptics/velocity.hpp"

namespace burin {

struct TickState {
    ProxyState proxy;
    VelocityWindow window;
    Similarity object_from_device;  // of the tick before; a change puts the proxy back to the HIP
    bool mapping_known = false;
    Nanoseconds sample_ns = 0;  // of the last sample that went into the window
};

struct TickOutput {
    TickState next;
    Vec3 hip_object_m{0.0};
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Vec3 velocity_device_m_per_s{0.0};
    Vec3 contact_normal_object{0.0};
    double penetration_m = 0.0;
    std::uint32_t active_triangle = kNoTriangle;
    std::uint32_t constraints = 0;
    Vec3 force_device_N{0.0};
    std::uint32_t flags = 0;
    bool sample_finite = true;
    bool parameters_sensible = true;
    TickWork work;
};

// now_ns is compared with LocalSurface::made_ns only; pass the loop's time, or the recorded one on replay. dt_s is the
// nominal period, above 0.
[[nodiscard]] TickOutput tick(const TickState& state, const DeviceSample& sample, const LocalSurface& surface,
                              const TickParameters& parameters, Nanoseconds now_ns, double dt_s) noexcept;

// Finite, positive scale, a unit rotation (to 1e-6), nothing negative, a clearance below 1, limits above 0.
[[nodiscard]] bool parameters_are_sensible(const TickParameters& parameters) noexcept;

// What the gate needs to know of a tick.
[[nodiscard]] GateInput gate_input(const TickOutput& out, const DeviceSample& sample, const DeviceDescription& device,
                                   Nanoseconds now_ns) noexcept;

// The whole of a tick, gate included: what HapticLoop runs, and what replay runs again.
struct FullTickState {
    TickState tick;
    GateState gate;
};

struct FullTick {
    FullTickState next;
    TickRecord record;  // all but tick number, lateness and the loop's own flags
    StrokeSample stroke;
};

[[nodiscard]] FullTick full_tick(const FullTickState& state, const DeviceSample& sample, const LocalSurface& surface,
                                 const TickParameters& parameters, const DeviceDescription& device, Nanoseconds now_ns,
                                 double dt_s) noexcept;

}  // namespace burin

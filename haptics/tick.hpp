// SPDX-License-Identifier: MIT
// One tick of the haptic loop as a pure function: a sample, a surface and settings in, a force out.
//
// Data flow, one line each, all in haptics/:
//   device sample -> velocity (signals/) -> mapping into the scene (workspace/)
//   for each point of the probe: proxy on the surface (contact/) -> spring, damper, friction (forces/touch_force.hpp)
//   -> the point that cuts eats its way in (forces/cutting.hpp) -> one force and torque (forces/wrench.hpp)
//   -> filter (signals/smoothing.hpp) -> passivity (stability/passivity.hpp) -> weight, guidance, the workspace's own force
//   -> the gate (stability/safety_gate.hpp): up to there it is what is wanted, from there what is given.
// Position gain g: points are scaled by g, forces divided by g, so that stiffness and damping are felt at the device as
// set, whatever the scale of the scene. Damping acts along the contact normal, in contact only, and never pulls
// the tool into the surface.
// Rules: no clock, heap, lock, throw, file; loops are bounded and their work is counted. The same inputs give the same
// bits.
#pragma once

#include "haptics/channels.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/forces/cutting.hpp"
#include "haptics/signals/velocity.hpp"

namespace burin {

struct TickState {
    WorkspaceState workspace;
    std::array<ProxyState, kMostProbePoints> proxies{};
    std::array<std::uint8_t, kMostProbePoints> materials{};  // what each point touched in the tick before
    CuttingState cutting;
    GuidanceState guidance;
    VelocityWindow window;
    VelocityWindow turning;  // of the rotation vector summed up; only where the probe has several points
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};  // of the tick before
    MovingAverage velocity_average, force_average;
    PassivityState passivity;
    Nanoseconds sample_ns = 0;  // of the last sample that went into the windows
    bool in_contact = false;
    bool paused = false;
};

struct TickOutput {
    TickState next;
    Similarity object_from_device;
    WorkspacePicture workspace;
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Vec3 velocity_device_m_per_s{0.0};
    Vec3 angular_velocity_device_rad_per_s{0.0};
    std::uint32_t point_count = 0;
    std::array<PointRecord, kMostProbePoints> points{};
    std::uint32_t deepest = 0;  // the point deepest in contact; 0 in free space
    Vec3 cut_object_m{0.0};
    DeviceWrench contact;  // of contact, after filter and passivity
    DeviceWrench wanted;   // all of it
    StiffnessBound stiffness_bound = StiffnessBound::none;
    double spring_energy_J = 0.0;  // what the walls touched hold
    double passivity_energy_J = 0.0;
    double passivity_damping_Ns_per_m = 0.0;
    std::uint32_t flags = 0;
    bool contact_jumped = false;
    bool sample_finite = true;
    bool parameters_sensible = true;
    TickWork work;
};

// now_ns is compared with LocalSurface::made_ns only; pass the loop's time, or the recorded one on replay. dt_s is the
// nominal period, above 0.
[[nodiscard]] TickOutput tick(const TickState& state, const DeviceSample& sample, const LocalSurface& surface,
                              const TickParameters& parameters, const DeviceDescription& device, Nanoseconds now_ns,
                              double dt_s) noexcept;

// Finite, positive scale, a unit rotation (to 1e-6), nothing negative, a clearance below 1, limits above 0.
[[nodiscard]] bool parameters_are_sensible(const TickParameters& parameters) noexcept;

// What the gate needs to know of a tick.
[[nodiscard]] GateInput gate_input(const TickOutput& out, const DeviceSample& sample, const DeviceDescription& device,
                                   Nanoseconds now_ns) noexcept;

// The whole of a tick, gate included: what HapticLoop runs, and what replay runs again.
struct FullTickState {
    TickState tick;
    GateState gate;
    Nanoseconds now_ns = 0;  // of the tick before; 0: there was none
};

struct FullTick {
    FullTickState next;
    TickRecord record;  // all but tick number, lateness and the loop's own flags
    StrokeSample stroke;
    WorkspacePicture workspace;
};

[[nodiscard]] FullTick full_tick(const FullTickState& state, const DeviceSample& sample, const LocalSurface& surface,
                                 const TickParameters& parameters, const DeviceDescription& device, Nanoseconds now_ns,
                                 double dt_s) noexcept;

}  // namespace burin

// SPDX-License-Identifier: MIT
// One tick of the haptic loop as a pure function: a sample, a surface and settings in, a force out.
//
// Data flow, one line each, all in haptics/:
//   device sample -> velocity (signals/) -> mapping into the scene (workspace/)
//   for each point of the probe: the watch over its last contact (haptics/contact/contact_watch.hpp) -> proxy on the
// surface
//   (haptics/contact/god_object.hpp) -> spring, damper, friction (haptics/forces/touch_force.hpp)
//   -> the cutting point advances (haptics/forces/cutting.hpp) -> one force and torque (haptics/forces/touch_force.hpp)
//   -> filter (haptics/signals/filters.hpp) -> easing of edits (haptics/forces/easing.hpp) -> passivity
//   (haptics/stability/passivity.hpp) -> weight, guidance, workspace force
//   -> the gate (stability/safety_gate.hpp): turns the desired wrench into the commanded wrench.
// Position gain g: points are scaled by g, forces divided by g, so that stiffness and damping are felt at the device as
// set, whatever the scale of the scene. Damping acts along the contact normal, in contact only, and never pulls
// the tool into the surface.
// Rules: no clock, heap, lock, throw, file; loops are bounded and their work is counted. The same inputs give the same
// bits.
#pragma once

#include "geometry/contact/local_surface.hpp"
#include "haptics/probe_contact.hpp"
#include "haptics/signals/filters.hpp"
#include "haptics/stability/passivity.hpp"
#include "haptics/stability/safety_gate.hpp"
#include "haptics/tick_parameters.hpp"
#include "haptics/tick_record.hpp"
#include "haptics/workspace/technique.hpp"

namespace burin::haptics {

// What is known of the hand's motion.
struct MotionState {
    VelocityWindow window;
    // Window of the accumulated rotation vector; filled only where the probe has several points.
    VelocityWindow turning;
    MovingAverage velocity_average;
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};  // of the last sample
    Vec3 foot_device_m{0.0};                      // of the drive of a part that drives one way, in the last sample
    Vec3 foot_velocity_device_m_per_s{0.0};
    Nanoseconds sample_ns = 0;  // of the last sample that went into the windows
};

// A stroke that adds material in free flight (FillPlace).
struct FreeFill {
    bool pressed = false;              // the button, in the last tick
    bool lasts = false;                // until the button is up and the tool is clear of material
    std::uint64_t ended_sequence = 0;  // of the surface when the button came up
};

struct TickState {
    MotionState motion;
    WorkspaceState workspace;
    ProbeState probe;
    GuidanceState guidance;
    MovingAverage force_average;
    EasedForce force;
    PassivityObserver passivity;
    FreeFill free_fill;
    bool in_contact = false;
    std::uint32_t refused = 0;  // ticks in a row whose input made no sense
};

struct Tick {
    TickState next;
    TickRecord record;  // but for the gate's output, the tick number and the lateness
};

// Computes a tick up to the desired wrench. now_ns is compared with LocalSurface::made_ns only; pass the loop's time,
// or the recorded one on replay. dt_s is the nominal period, above 0.
[[nodiscard]] Tick tick(const TickState& state, const devices::DeviceSample& sample,
                        const geometry::LocalSurface& surface, const TickParameters& parameters,
                        const devices::DeviceDescription& device, Nanoseconds now_ns, double dt_s) noexcept;

// Checks all parameters: finite, positive scale, a unit rotation (to 1e-6), nothing negative, a clearance below 1,
// limits above 0.
[[nodiscard]] bool parameters_are_sensible(const TickParameters& parameters) noexcept;
// Returns whether each mesh of a surface has one of the materials in TickParameters::materials. A surface for which it
// is false gives zero force and GateCause::bad_parameters; the publisher of a scene refuses to publish it, with the
// number of the object (scene/touch_publisher.hpp).
[[nodiscard]] bool materials_are_known(const geometry::LocalSurface& surface) noexcept;

// Whether a scene can be felt at this scale of motions. Beyond, the lengths of device and scene differ by more than the
// positions of a mesh, which are float, resolve.
[[nodiscard]] constexpr bool is_felt_at(double scale) noexcept { return scale >= 1e-6 && scale <= 1e6; }

// Collects the gate's inputs from a tick; all but loop_gap_s.
[[nodiscard]] GateInput gate_input(const TickRecord& record, const devices::DeviceDescription& device) noexcept;

// The whole of a tick, gate included: what HapticLoop runs for each part, and what replay runs again.
struct FullTickState {
    TickState tick;
    GateState gate;
    Nanoseconds now_ns = 0;  // of the last tick; 0: there was none
};

struct FullTick {
    FullTickState next;
    TickRecord record;  // all but the tick number, the lateness and the loop's own flags
};

[[nodiscard]] FullTick full_tick(const FullTickState& state, const devices::DeviceSample& sample,
                                 const geometry::LocalSurface& surface, const TickParameters& parameters,
                                 const devices::DeviceDescription& device, Nanoseconds now_ns, double dt_s,
                                 const TurnShare& turn = {}) noexcept;

}  // namespace burin::haptics

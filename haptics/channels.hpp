// SPDX-License-Identifier: MIT
// What travels between the haptic thread and the rest: the payloads of the five channels, all plain data of fixed size but
// for the surface, which refers to what the carving side owns (geometry/local_surface.hpp).
//
// Data flow: parameters and surface come in (newest value wins, borrowed); the tool's state goes out to the frame
// (newest value wins), stroke samples go to the carving side and tick records to the recorder (rings: in order, none
// lost silently). Units are SI; a name carries its frame. "Object" is the workpiece's frame, in which carving and
// contact happen.
#pragma once

#include <array>
#include <cstdint>

#include "base/newest_slot.hpp"
#include "base/ring.hpp"
#include "devices/haptic_device.hpp"
#include "geometry/local_surface.hpp"
#include "haptics/contact/probe.hpp"
#include "haptics/forces/guidance.hpp"
#include "haptics/forces/touch_material.hpp"
#include "haptics/forces/wrench.hpp"
#include "haptics/signals/smoothing.hpp"
#include "haptics/stability/passivity.hpp"
#include "haptics/stability/safety_gate.hpp"
#include "haptics/stability/stiffness_limit.hpp"
#include "haptics/stability/virtual_coupling.hpp"
#include "haptics/workspace/technique.hpp"

namespace burin {

// What the tool does while its button (bit 0) is pressed.
enum class ToolAction : std::uint8_t {
    touch,  // nothing: it only feels
    cut,    // resistance by hardness and engagement
    fill,   // deposits where the proxy is; felt as touch
    paint,  // felt without friction: painting has no resistance
};

// Settings of a tick. Written by the frame or the study, never by the haptic thread. A set that is not sensible (see
// parameters_are_sensible in haptics/tick.hpp) gives zero force and GateCause::bad_parameters.
struct TickParameters {
    std::uint64_t sequence = 0;  // 0: the defaults, never published
    WorkspaceSettings
        workspace;  // where the device is in the scene; the scale is the position gain g: motions grow by g,
                    // forces shrink by g
    Probe probe;
    // The ball that touches is smaller than the ball that carves by this fraction of its radius. A ball lying in the
    // groove it has cut would otherwise be pinched by the facets, which cut the circle's corner: a facet of length s
    // stands s^2 / (8 R) proud. 0.02 leaves room for facets of 0.4 R.
    double clearance_ratio = 0.02;
    bool shading = true;  // force shading, see haptics/contact/god_object.hpp
    std::array<TouchMaterial, kMostMaterials> materials{};
    ToolAction action = ToolAction::touch;
    // The stiffness of materials is limited to what the device renders passively; false: taken as it is set.
    bool limit_stiffness = true;
    CouplingSettings coupling;
    PassivitySettings passivity;
    SignalSettings signals;
    WeightSettings weight;
    GuidanceSettings guidance;
    GuidanceCurve curve;
    // The noise bound of the velocity estimate, in the device frame: the encoder's step.
    double position_noise_m = 0.000055;
    bool enabled = true;  // false: no contact, zero force, the proxy stays with the HIP
    // In contact, a surface older than this is not trusted: zero force. 0: any age is trusted.
    double max_surface_age_s = 0.5;
    GateLimits limits;
};

// One sample of the tool's motion for the carving side: it sweeps the tool from the sample before to this one.
struct StrokeSample {
    std::uint64_t tick = 0;
    Nanoseconds time_ns = 0;
    Vec3 position_object_m{0.0};  // HIP: where the hand is
    Vec3 cut_object_m{0.0};       // where the tool has eaten to (haptics/forces/cutting.hpp): what a cut sweeps along
    Vec3 proxy_object_m{0.0};     // IHIP: where the tool rests on the surface; the HIP itself in free space
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Vec3 force_object_N{0.0};  // what the device was told, in the object frame, in newtons at the device
    std::uint32_t buttons = 0;
    std::uint32_t flags = 0;  // TickFlag bits
    std::uint64_t surface_sequence = 0;
    std::uint64_t parameter_sequence = 0;
    WorkspacePhase phase = WorkspacePhase::editing;  // in any other nothing is carved
};

// A degraded or noteworthy tick says so; bits of TickRecord::flags.
enum TickFlag : std::uint32_t {
    kTickLate = 1u << 0,            // began more than half a period after its deadline
    kTickInContact = 1u << 1,       // the proxy is held by a surface
    kTickNoSurface = 1u << 2,       // no surface has been published
    kTickOutsideKnown = 1u << 3,    // the tool leaves the ball within which the surface is known
    kTickStaleSurface = 1u << 4,    // in contact, and the surface is older than max_surface_age_s
    kTickPushedOut = 1u << 5,       // the proxy was inside material and was put outside, the nearest way
    kTickProxyReset = 1u << 6,      // the proxy was put back to the HIP: first tick, new mapping, or re-enabled
    kTickWorkLimited = 1u << 7,     // the proxy stopped because the tick's work was used up; it goes on in the next
    kTickForceSaturated = 1u << 8,  // the force limit cut
    kTickSlewLimited = 1u << 9,     // the slew limit cut
    kTickRamping = 1u << 10,        // force is being faded in
    kTickFault = 1u << 11,          // the gate gave zero; TickRecord::cause says why
    kTickSampleDropped = 1u << 12,  // the carving side's ring was full: this stroke sample was lost
    kTickStiffnessLimited =
        1u << 13,                   // a material is stiffer than the device renders passively; StiffnessBound says why
    kTickPassivityActs = 1u << 14,  // the passivity controller adds damping
    kTickPaused = 1u << 15,         // the workspace is being moved: nothing is touched
    kTickSticking = 1u << 16,       // friction holds the proxy
    kTickCutting = 1u << 17,        // the tool eats its way into material
    kTickGuided = 1u << 18,         // drawn to the guidance curve
    kTickLoopGap = 1u << 19,        // ticks were lost before this one
};

// What the tick did in numbers that do not depend on the machine's speed.
struct TickWork {
    std::uint32_t triangles_tested = 0;  // exact distance or sweep computations
    std::uint32_t triangles_seen = 0;    // looked at by their bounding box or ball; a quad is one
    std::uint32_t proxy_steps = 0;
    std::uint32_t plane_solves = 0;
};

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

// One point of the probe.
struct PointRecord {
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};
    Vec3 normal_object{0.0};                      // unit, of the contact; zero in free space
    Vec3 force_device_N{0.0};                     // wanted, of this point alone
    double penetration_m = 0.0;                   // |proxy - HIP| in the object frame
    std::uint32_t active_triangle = kNoTriangle;  // in the surface used: the one that bears most of the contact
    std::uint32_t constraints = 0;                // 0 to 3 planes bear the proxy
};

// Everything a tick used and did. With the surfaces and parameters of the sequences named it replays to the same bits.
struct TickRecord {
    std::uint64_t tick = 0;
    Nanoseconds time_ns = 0;      // the loop's clock at the tick's beginning
    Nanoseconds lateness_ns = 0;  // after the deadline; 0 in simulated time
    DeviceSample sample;
    std::uint64_t surface_sequence = 0;
    std::uint64_t parameter_sequence = 0;
    Similarity object_from_device;  // as the workspace technique had it
    WorkspacePhase phase = WorkspacePhase::editing;
    // Of the point that is deepest in contact; in free space of the first.
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};
    Vec3 contact_normal_object{0.0};
    double penetration_m = 0.0;
    std::uint32_t active_triangle = kNoTriangle;
    std::uint32_t constraints = 0;
    std::uint32_t point_count = 0;
    std::array<PointRecord, kMostProbePoints> points{};
    Vec3 cut_object_m{0.0};
    Vec3 velocity_device_m_per_s{0.0};
    DeviceWrench wanted;  // before the gate
    DeviceWrench given;   // what the device was told
    StiffnessBound stiffness_bound = StiffnessBound::none;
    double passivity_energy_J = 0.0;  // into the rendered world since contact began
    double passivity_damping_Ns_per_m = 0.0;
    std::uint32_t flags = 0;
    GateCause cause = GateCause::none;
    TickWork work;
};

// For the frame: where to draw the tool, and what to say about it.
struct ToolState {
    std::uint64_t tick = 0;  // 0: never published
    Nanoseconds time_ns = 0;
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};
    Vec3 contact_normal_object{0.0};  // unit; zero in free space
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Vec3 position_device_m{0.0};
    DeviceWrench given;
    std::uint32_t point_count = 0;
    std::array<Vec3, kMostProbePoints> proxies_object_m{};
    WorkspacePicture workspace;
    StiffnessBound stiffness_bound = StiffnessBound::none;
    std::uint32_t buttons = 0;
    std::uint32_t flags = 0;
    GateCause cause = GateCause::none;
    std::uint64_t late_ticks = 0;       // since the start
    std::uint64_t dropped_samples = 0;  // stroke samples lost to a full ring since the start
};

// The five channels in one place. The session owns it and outlives the threads; allocates in the constructor only.
// Capacities: four seconds of ticks for a carving side that stalls, one second for a recorder that writes.
struct HapticChannels {
    static constexpr std::size_t kStrokes = 4096, kRecords = 1024;
    explicit HapticChannels(std::size_t stroke_capacity = kStrokes, std::size_t record_capacity = kRecords)
        : stroke(stroke_capacity), records(record_capacity) {}

    NewestSlot<LocalSurface> surface;       // carving side -> haptic thread
    NewestSlot<TickParameters> parameters;  // frame or study -> haptic thread
    Ring<StrokeSample> stroke;              // haptic thread -> carving side
    Ring<TickRecord> records;               // haptic thread -> recorder
    NewestSlot<ToolState> tool;             // haptic thread -> frame
};

}  // namespace burin

// SPDX-License-Identifier: MIT
// What a tick used and did (TickRecord), and what a frame sees of it (ToolState). Plain data of fixed size. Units are
// SI; a name carries its frame. "Object" is the workpiece's frame, in which carving and contact happen.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "devices/haptic/haptic_device.hpp"
#include "haptics/contact/contact_work.hpp"
#include "haptics/contact/probe.hpp"
#include "haptics/stability/passivity.hpp"
#include "haptics/stability/rendered_wall.hpp"
#include "haptics/stability/safety_gate.hpp"
#include "haptics/workspace/technique.hpp"

namespace burin::haptics {

// Flags of a degraded or noteworthy tick: bits of TickRecord::flags.
enum TickFlag : std::uint32_t {
    kTickLate = 1u << 0,          // began more than half a period after its deadline
    kTickInContact = 1u << 1,     // the proxy is held by a surface, or the cutting point by material
    kTickNoSurface = 1u << 2,     // no surface has been published
    kTickOutsideKnown = 1u << 3,  // the tool leaves the ball within which the surface is known
    kTickStaleSurface = 1u << 4,  // in contact, and the surface is older than max_surface_age_s
    kTickPushedOut = 1u << 5,     // the proxy was inside material and was moved outside by the shortest path
    kTickProxyReset = 1u << 6,    // the proxy was set to the HIP: first tick, new mapping, or re-enabled
    // the proxy stopped because the tick's work budget was used up; it continues in the next tick
    kTickWorkLimited = 1u << 7,
    kTickForceSaturated = 1u << 8,  // the force was reduced to the force limit
    kTickSlewLimited = 1u << 9,     // the change of force was reduced to the slew limit
    kTickRamping = 1u << 10,        // force is being faded in
    kTickFault = 1u << 11,          // the gate gave zero force; TickRecord::cause says why
    kTickSampleDropped = 1u << 12,  // the scene's ring was full: it has lost this tick
    // a material is stiffer than what the device renders passively; StiffnessBound says why
    kTickStiffnessLimited = 1u << 13,
    kTickPassivityActs = 1u << 14,  // the passivity controller adds damping, or scales the wrench
    kTickPaused = 1u << 15,         // the workspace is being moved: nothing is touched or carved
    kTickSticking = 1u << 16,       // friction holds the proxy
    kTickCutting = 1u << 17,        // the tool is cutting into material
    kTickGuided = 1u << 18,         // the guidance force pulls the tool to its curve
    kTickLoopGap = 1u << 19,        // ticks were lost before this one
    kTickDoubted = 1u << 20,        // the watch finds no sound contact: its force fades out (ContactWatch)
    kTickLetGo = 1u << 21,          // ... and the tool was set to the hand in this tick
    // a part, or some points of one, for which no work was left in this turn: contacts are held on their last planes
    kTickHeldOver = 1u << 22,
};

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

// Contact of one point of the probe.
struct PointRecord {
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};
    Vec3 normal_object{0.0};     // unit, of the contact; zero in free space
    Vec3 force_device_N{0.0};    // desired, of this point alone
    double penetration_m = 0.0;  // |proxy - HIP| in the object frame
    // index in the surface used, of the triangle that bears most of the contact
    std::uint32_t active_triangle = kNoTriangle;
    std::uint32_t constraints = 0;  // number of planes that bear the proxy, 0 to 3
    std::uint32_t object = 0;       // that active_triangle is part of (LocalSurface::object); 0: none, or not numbered
    // The wall of the material touched, as it says and as the device renders it now; zero in free space. What the
    // energy account takes of the force is not in it: PassivityRecord::share.
    CoupledWall asked, rendered;
};

// The motion of the tool: the device's, mapped into the scene.
struct MotionRecord {
    Similarity object_from_device;  // the mapping of the workspace technique in this tick
    WorkspacePicture workspace;
    PieceMotion piece;  // of the piece under the device, where the mapping follows it
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Vec3 velocity_device_m_per_s{0.0};
    Vec3 angular_velocity_device_rad_per_s{0.0};
};

// The probe against the surface.
struct ContactRecord {
    std::uint32_t point_count = 0;
    std::uint32_t deepest = 0;  // index of the point deepest in contact; 0 in free space
    std::array<PointRecord, kMostProbePoints> points{};
    Vec3 cut_object_m{0.0};
    Quat tool_orientation_object{1.0, 0.0, 0.0, 0.0};  // of the tool at its proxy; in free space the hand's
    Vec3 touched_object_m{0.0};                        // where a tool with a shape is borne; zero for balls
    bool jumped = false;                               // not continuous with the contact of the last tick
    bool edited = false;  // what was touched has been edited or taken away since the last tick, or the probe has
    bool eases = false;   // the force still changes from that of before an edit or a jump (haptics/forces/easing.hpp)
    StiffnessBound stiffness_bound = StiffnessBound::none;
    Vec3 surface_velocity_device_m_per_s{0.0};  // of what is touched; zero where it rests
    double spring_energy_J = 0.0;               // energy stored in the springs of the walls touched
    devices::DeviceWrench wrench;               // of the contact, after filter and passivity
    ContactWork work;
};

// A tick's share of its turn. The parts of a device that are ticked in one turn of the loop have one period's budget
// among them, by need: each may use what those before it have left over. A part for which too little is left is held
// over: its contacts stay on their last planes, and the next turn begins with it. Points of one part share in the same
// way (haptics/contact/point_turns.hpp).
struct TurnShare {
    // A part with less than this share of the budget, or less time, is held over. A tick on a scan takes a tenth of the
    // budget on average.
    static constexpr double kLeast = 0.15, kLeast_ns = 4000.0;

    double spent_ns = 0.0;  // by the parts before, as cost_ns() counts
    bool held_over = false;
    double kept_ns = 0.0;  // for the parts after, each of which costs something although it does nothing

    [[nodiscard]] double of(double budget_ns) const noexcept { return std::max(budget_ns - spent_ns - kept_ns, 0.0); }
};

// Everything a tick used and did, and what everybody gets of it; ToolState is a view of it. With the surface and the
// parameters of the sequence numbers recorded here it replays to the same bits. tick() (haptics/tick.hpp) fills it but
// for the gate, full_tick() adds the gate, and HapticLoop the tick number, the lateness and its own flags.
struct TickRecord {
    std::uint64_t tick = 0;
    Nanoseconds time_ns = 0;      // the loop's clock when the tick began
    Nanoseconds lateness_ns = 0;  // time after the deadline; 0 in simulated time; see skipped_deadlines()
    devices::DeviceSample sample;
    std::uint64_t surface_sequence = 0;
    std::uint64_t parameter_sequence = 0;
    TurnShare turn;
    // One false: nothing else was computed, the force is zero. So it is for a sample stamped ahead of time.
    bool sample_finite = true, within_reach = true, parameters_sensible = true, scale_felt = true;
    MotionRecord motion;
    ContactRecord contact;
    PassivityRecord passivity;
    devices::DeviceWrench wanted;  // desired wrench: the contact's and all others, before the gate
    GateOutput gate;               // its `given` is the commanded wrench, as written to the device
    std::uint32_t flags = 0;       // TickFlag bits

    [[nodiscard]] const PointRecord& deepest() const { return contact.points[contact.deepest]; }
    [[nodiscard]] bool in_contact() const { return (flags & kTickInContact) != 0; }
};

// Returns how many deadlines passed while a tick was late by so much: ticks that were due and never ran. The loop goes
// on at the next deadline that is still ahead.
[[nodiscard]] constexpr std::uint64_t skipped_deadlines(Nanoseconds lateness_ns, Nanoseconds period_ns) noexcept {
    return lateness_ns > 0 && period_ns > 0 ? static_cast<std::uint64_t>(lateness_ns / period_ns) : 0;
}

// The view of a tick for the frame (tool_of): where to draw the tool and what to report about it.
struct ToolState {
    std::uint64_t tick = 0;  // 0: never published
    Nanoseconds time_ns = 0;
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};
    Vec3 contact_normal_object{0.0};  // unit; zero in free space
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    Quat tool_orientation_object{1.0, 0.0, 0.0, 0.0};  // of the tool at its proxy
    Vec3 touched_object_m{0.0};                        // where a tool with a shape is borne; zero for balls
    Vec3 position_device_m{0.0};
    devices::DeviceWrench given;
    std::uint32_t point_count = 0;
    std::array<Vec3, kMostProbePoints> proxies_object_m{};
    WorkspacePicture workspace;
    StiffnessBound stiffness_bound = StiffnessBound::none;
    std::uint32_t object = 0;     // touched by the deepest point, its wall as asked and as rendered (PointRecord), and
    CoupledWall asked, rendered;  // the share of the force that the energy account affords
    double energy_share = 1.0;
    std::uint32_t buttons = 0;
    std::uint32_t flags = 0;
    GateCause cause = GateCause::none;
    Nanoseconds let_go_ns = 0;          // time of the last tick in which the watch let the hand go; 0: there was none
    std::uint64_t late_ticks = 0;       // since the start
    std::uint64_t dropped_samples = 0;  // ticks that the scene has lost to a full ring since the start
};

[[nodiscard]] ToolState tool_of(const TickRecord& record, std::uint64_t late_ticks,
                                std::uint64_t dropped_samples) noexcept;

}  // namespace burin::haptics

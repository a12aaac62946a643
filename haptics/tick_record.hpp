// SPDX-License-Identifier: MIT
// What a tick used and did (TickRecord); what a frame sees of it is its ToolState (haptics/tool_state.hpp). Plain data
// of fixed size. Units are SI; a name carries its frame. "Object" is the workpiece's frame, in which carving and
// contact happen.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "devices/haptic/device_sample.hpp"
#include "haptics/contact/probe.hpp"
#include "haptics/contact/work_counts.hpp"
#include "haptics/stability/coupled_wall.hpp"
#include "haptics/stability/gate_output.hpp"
#include "haptics/stability/passivity_record.hpp"
#include "haptics/tick_flag.hpp"
#include "haptics/workspace/piece_motion.hpp"
#include "haptics/workspace/workspace_picture.hpp"

namespace burin::haptics {

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

}  // namespace burin::haptics

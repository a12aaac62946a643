// SPDX-License-Identifier: MIT
// The contact part of a tick: every point of the probe against the surface, and the wrench that the hand feels.
// Frame: object; wrenches are in the device frame. Pure; no clock, heap, lock or throw.
#pragma once

#include "geometry/contact/local_surface.hpp"
#include "haptics/contact/contact_watch.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/contact/moving_bodies.hpp"
#include "haptics/contact/point_turns.hpp"
#include "haptics/forces/cutting.hpp"
#include "haptics/forces/easing.hpp"
#include "haptics/tick_parameters.hpp"
#include "haptics/tick_record.hpp"

namespace burin::haptics {

// The contact of one probe point in the last tick.
struct LastContact {
    Vec3 normal_object{0.0};
    std::uint32_t constraints = 0;  // 0: it did not touch
};

// What the probe touched in a tick, and in which state: an edit shows by another number, or by the object's absence.
struct TouchedObject {
    std::uint32_t object = 0, edits = 0;
};
struct TouchedBefore {
    std::array<TouchedObject, kMostProbePoints> objects{};
    std::uint32_t count = 0;  // of the points that touched
    std::uint64_t surface_sequence = 0;
    std::uint32_t materials_felt = 0;  // a bit for each
    Probe probe;
};

// What contact keeps from tick to tick.
struct ProbeState {
    std::array<ProxyState, kMostProbePoints> proxies{};
    std::array<std::uint8_t, kMostProbePoints> materials{};  // that each point touched last, below kMostMaterials
    std::array<WatchState, kMostProbePoints> watches{};
    // The contact of each point in the last tick, for a tick in which it is held over, and what its force still leaves
    // out of the spring after an unexplained motion, in the object frame.
    std::array<LastContact, kMostProbePoints> contacts{};
    std::array<double, kMostProbePoints> left_out_m{};
    EasedWalls walls{};
    std::array<EasedFriction, kMostProbePoints> friction{};
    TouchedBefore touched;
    Quat tool_orientation_object{1.0, 0.0, 0.0, 0.0};  // of a tool's shape at its proxy
    PointTurns turns;
    CuttingState cutting;
    BodiesState bodies;
    std::uint64_t placement = 0;  // number of the last ProxyPlacement that acted
};

// References hold for the call.
struct ProbeInput {
    const devices::DeviceSample& sample;
    const MotionRecord& motion;
    const geometry::LocalSurface& surface;
    const TickParameters& parameters;
    const devices::DeviceDescription& device;
    double dt_s;
    Nanoseconds now_ns;
    TurnShare turn{};
};

// Where a step of the probe puts its results: in the tick's own, which are too large to be copied a thousand times a
// second.
struct ProbeStep {
    ProbeState& next;        // holds the state before
    ContactRecord& contact;  // default; its wrench becomes what the walls give, not yet filtered
    std::uint32_t& flags;    // TickFlag bits that contact sets are added
};

// Computes, for each point, its proxy on the surface, the wall as the device may render it, and the force; the first
// point also cuts. materials_are_known() (haptics/tick.hpp) must hold for the surface.
void touch_surface(const ProbeStep& step, const ProbeInput& input) noexcept;

// Sets the proxies of all points in one place, as if they had come there without touching anything.
void place_proxies(ProbeState& state, const Vec3& position_object_m, std::uint64_t surface_sequence) noexcept;

// Returns whether all points are clear of material where the hand is; false where the work does not suffice to tell.
[[nodiscard]] bool fits_at_hand(const ProbeStep& step, const ProbeInput& input) noexcept;

// Lets the proxies follow the hand while nothing is touched.
void follow_hand(const ProbeStep& step, const ProbeInput& input) noexcept;

}  // namespace burin::haptics

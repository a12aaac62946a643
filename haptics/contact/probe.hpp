// SPDX-License-Identifier: MIT
// The shape that touches: a tool as a set of balls, each with its own proxy. One ball for a stylus, two for the wand's
// ends, a patch of small ones for a fingertip.
//
// Frame: offsets are in the tool's own axes, in metres at the device; the tool's position and orientation come from the
// device's sample. Ball i is at P_i = R T_i + P in the device frame (R the orientation, T_i the offset, P the
// position), and then in the object frame by the workspace's mapping, gain included. Radii are in the object frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/space.hpp"

namespace burin::haptics {

inline constexpr std::uint32_t kMostProbePoints = 20;  // four fingers of five points

struct ProbePoint {
    Vec3 offset_device_m{0.0};  // T_i
    double radius_m = 0.0;      // 0 is a point
    // Of the stiffness and damping of the surface, what this point renders: its share of a patch's area.
    double share = 1.0;
};

struct Probe {
    std::uint32_t count = 1;  // 1 to kMostProbePoints
    std::array<ProbePoint, kMostProbePoints> points{};
};

[[nodiscard]] inline bool same(const Probe& a, const Probe& b) noexcept {
    if (a.count != b.count) return false;
    for (std::uint32_t i = 0; i < std::min(a.count, kMostProbePoints); ++i)
        if (a.points[i].offset_device_m != b.points[i].offset_device_m ||
            a.points[i].radius_m != b.points[i].radius_m || a.points[i].share != b.points[i].share)
            return false;
    return true;
}

// Where the proxies of all points begin anew, wherever the hand is: both ends of a wand at the start of a path. Each
// number acts once, in the first tick that touches; 0: never. Where the hand is beyond a surface then, the proxies stay
// on their side of it, and the gate fades the force in as that of a new contact.
struct ProxyPlacement {
    std::uint64_t number = 0;
    Vec3 position_object_m{0.0};
};

[[nodiscard]] inline Probe ball_probe(double radius_m) {
    Probe probe;
    probe.points[0].radius_m = radius_m;
    return probe;
}

}  // namespace burin::haptics

// SPDX-License-Identifier: MIT
// The shape that touches: a tool as a set of balls, each with its own proxy. One ball for a stylus, two for the wand's
// ends, a patch of small ones for a fingertip.
//
// Frame: offsets are in the tool's own axes, in metres at the device; the tool's position and orientation come from the
// device's sample. Ball i is at P_i = R T_i + P in the device frame (R the orientation, T_i the offset, P the
// position), and then in the object frame by the workspace's mapping, gain included. Radii are in the object frame.
// The points of a wand or a finger bear by themselves: the hand feels the sum of their forces. Those of a carving tool
// are one rigid body (`rigid_tool`): the hand feels one spring from where it holds the tool to where the tool would lie
// outside of everything its points touch, so that the force does not change when one more point comes to bear. Its
// offsets are lengths of the object frame, as its radii are.
#pragma once

#include <array>
#include <cstdint>

#include "base/space.hpp"

namespace burin::haptics {

inline constexpr std::uint32_t kMostProbePoints = 20;  // four fingers of five points

struct ProbePoint {
    Vec3 offset_device_m{0.0};  // T_i; of a rigid tool in metres of the object frame
    double radius_m = 0.0;      // 0 is a point
};

struct Probe {
    std::uint32_t count = 1;  // 1 to kMostProbePoints
    bool rigid_tool = false;
    std::array<ProbePoint, kMostProbePoints> points{};
};

[[nodiscard]] inline Probe ball_probe(double radius_m) {
    Probe probe;
    probe.points[0].radius_m = radius_m;
    return probe;
}

}  // namespace burin::haptics

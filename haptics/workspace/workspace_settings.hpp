// SPDX-License-Identifier: MIT
// What a workspace technique (haptics/workspace/technique.hpp) is told. Frames: device and object. Plain data.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "haptics/workspace/workspace_picture.hpp"

namespace burin::haptics {

struct WorkspaceSettings {
    WorkspaceTechnique technique = WorkspaceTechnique::fixed;
    Similarity object_from_device;  // at rest, and at the start of each technique; its scale is the gain
    Vec3 workspace_device_m{0.1626, 0.1219, 0.0711};  // the box centred on the device's origin
    // Region that the tool should be able to reach; empty: unbounded. The workspace never leaves it (except with
    // `fixed`); along an axis where the workspace is longer than the region it is centred.
    Box reach_object;
    std::uint32_t button_mask = 2;  // which button moves the workspace: bit 1, the stylus' second one
    // Moving: a press released sooner is a jump; held longer it drags.
    double tap_s = 0.3;
    double series_s = 0.4;  // moving: a press within this time of the last belongs to its series
    // Moving: speed of a drag divided by the tool's distance from the middle.
    double drag_rate_per_s = 5.0;
    double scaling_gain = 1.0;  // scaling: multiplies object_from_device.scale
    // Bubble, in the device frame. The ball must leave room for rate control along the workspace's shortest side.
    double bubble_radius_m = 0.025;
    double bubble_stiffness_N_per_m = 100.0;
    double bubble_rate_per_m2s = 1e5;  // k: 10 mm beyond the ball are 0.1 m/s
    // Drift: drift speed over hand speed at the edge of the workspace; less inside.
    double drift_ratio = 0.15;
    // Greatest speeds of a mapping without a jump, in device metres; times the gain in object metres.
    double max_speed_m_per_s = 1.0;
    double max_speed_in_contact_m_per_s = 0.0;
    double max_acceleration_m_per_s2 = 4.0;  // only when speeding up; slowing down is immediate
    // How often the mapping has been set otherwise than by a motion of the piece. While it stays the same the tick
    // follows the mapping as that of a body; 0: never, each change starts the technique and the contact afresh.
    std::uint64_t placed = 0;
};

}  // namespace burin::haptics

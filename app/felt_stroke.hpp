// SPDX-License-Identifier: MIT
// --hand simulated: a simulated hand leads a simulated Omni along the stroke, feels the surface through the haptic loop, and
// is pushed back by it. The tool carves where the device really is, not where the hand wanted it.
//
// Data flow: hand -> device -> haptic loop (1 kHz) -> ring of stroke samples -> carving update (100 Hz) -> local surface ->
// haptic loop. In simulated time both sides run in turn on one thread, as fast as they can, and every run gives the same
// bits; in real time the haptic loop has a thread of its own.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "app/carving.hpp"
#include "app/rigid_stroke.hpp"
#include "haptics/channels.hpp"

namespace burin {

struct FeltFigures {
    Similarity object_from_device;  // how the stroke was fitted into the device's workspace
    Vec3 workspace_device_m{0.0};
    double duration_s = 0.0;
    std::uint64_t ticks = 0;
    std::uint64_t ticks_in_contact = 0;
    std::uint64_t ticks_late = 0;
    std::uint64_t samples_dropped = 0;
    std::uint64_t surfaces_published = 0;
    double force_max_N = 0.0;
    double force_mean_in_contact_N = 0.0;
    double penetration_max_m = 0.0;                         // object frame
    std::map<std::string, std::uint64_t> zero_force_ticks;  // by the gate's cause
    std::vector<std::uint32_t> tick_ns;                     // cost of each tick in simulated time; empty in real time
    std::vector<std::string> notices;                       // e.g. no real-time priority
    ToolState last_tool;
};

struct FeltOptions {
    bool real_time = false;
};

// The tool must be a ball: that is what is felt. The stroke must fit: its bounds are centred in the workspace and, where they are larger, the motion is scaled up.
[[nodiscard]] Result<FeltFigures> carve_by_feel(Carving& carving, const Stroke& stroke, const Tool& tool,
                                                const FeltOptions& options);

}  // namespace burin

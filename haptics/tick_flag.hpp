// SPDX-License-Identifier: MIT
// What is noteworthy of a tick: the bits of TickRecord::flags (haptics/tick_record.hpp) and of ToolState::flags
// (haptics/tool_state.hpp).
#pragma once

#include <cstdint>

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

}  // namespace burin::haptics

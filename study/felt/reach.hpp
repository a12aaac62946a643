// SPDX-License-Identifier: MIT
// Whether the wand can do what a world asks: both of its points in a cap at once, both through the funnels' mouths, and
// the tube where the wand reaches. Somebody who cannot touch a cap waits for it without an end, and no file would say
// why.
//
// The wand is held upright, as the device that leads holds it, and its middle is anywhere in its workspace. Points lie
// point_offset_m above and below the middle. For what an upright wand cannot do, the least lean with which it could is
// looked for over the wand's turn, in steps of a degree about both of its axes: it is told beside the fault, since a
// person may lean and a task must not depend on it.
// Frame: the world's. SI units; angles in degrees where the name says so. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "devices/haptic/wand_description.hpp"
#include "study/protocol/protocol.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {

// Whether a cap holds both points of a wand.
struct CapReach {
    double slope_degrees = 0.0;  // of the path's end, against the horizontal
    // By how much the cap could be narrower, along the axis with the least room, for an upright wand; below 0: it holds
    // the points nowhere, or where the wand does not reach.
    double room_m = 0.0;
    bool in_workspace = true;  // of the places that hold both points one is within the wand's workspace
    std::optional<double> least_lean_degrees = {};  // with which the wand fits; none: no turn of it does

    [[nodiscard]] bool fits() const { return room_m >= 0.0 && in_workspace; }
};
[[nodiscard]] CapReach cap_reach(const CapBox& cap, const devices::WandDescription& wand, const Box& workspace_m);

struct ReachFault {
    std::string what, remedy;  // a whole line with the world's name before it
};
// Finds what the wand of the protocol cannot do in a world. The bounds are those of FeltWorld, by which the wand is
// placed. Empty: all can be done.
[[nodiscard]] std::vector<ReachFault> reach_faults(const Protocol& protocol, const StudyWorld& world,
                                                   const Box& bounds_m);

// Less room than this is told before anybody has to find the one place that counts.
inline constexpr double kLittleRoom_m = 0.002;
[[nodiscard]] std::vector<std::string> reach_warnings(const Protocol& protocol, const StudyWorld& world,
                                                      const Box& bounds_m);

// The findings of a world of a protocol.
struct WorldReach {
    std::vector<ReachFault> faults;
    std::vector<std::string> warnings;
};
// Returns those of each of the protocol's worlds, in its order. Fails where a world's tube cannot be made.
[[nodiscard]] Result<std::vector<WorldReach>> reach_of(const Protocol& protocol);

}  // namespace burin::study

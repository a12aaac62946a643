// SPDX-License-Identifier: MIT
// The patch by which a fingertip feels (G3): points on the drawn skin of its pad, each with its share of the area.
//
// The middle of the patch is where the line from the fingertip's centre of gravity towards the palm leaves the skin.
// The points around it lie on a cylinder along the last bone, and are projected from its axis on the skin; so a patch
// wraps around the finger as its pad does. It does not depend on how finely the hand is drawn.
// Frame: the fingertip's (hand_from_tip in hand_model.hpp), metres. Pure; any thread; made once, when a hand is read.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/hand/hand_model.hpp"

namespace burin::geometry {

struct PatchPoint {
    Vec3 place_tip_m{0.0};
    Vec3 normal_tip{0.0};  // unit, out of the skin
    double area_m2 = 0.0;  // of the skin, for which it stands
    double share = 0.0;    // of the patch's area; those of all points add up to 1
};

struct PatchLayout {
    std::size_t points = 5;   // at least 1; five are the middle and four neighbours, other numbers a spiral
    double extent_m = 0.004;  // from the middle to the neighbours, along the skin
};

inline constexpr std::size_t kMostPatchPoints = 4096;

// Returns the patch of a fingertip. Fails on a layout out of range, and where the finger has no skin to put it on.
[[nodiscard]] Result<std::vector<PatchPoint>> fingertip_patch(const HandModel& hand, Finger finger,
                                                              const PatchLayout& layout);

// Returns the share of a surface's stiffness that each point renders: its share of the area, times one gain for all
// with which the patch that is pressed flat so deep is as stiff as a single point in its middle. A fingertip is round,
// so that few points of a wide patch are deep. Requires a patch of fingertip_patch().
[[nodiscard]] std::vector<double> stiffness_shares(const std::vector<PatchPoint>& patch, double depth_m);

}  // namespace burin::geometry

// SPDX-License-Identifier: MIT
// Where an activity has placed a hand that it brings (session/activity/brought_hand.hpp). Plain data.
#pragma once

#include "base/space.hpp"

namespace burin::session {

struct PlacedHand {
    Similarity scene_from_device;
    Pose rest_device;          // of the hand before the first tick
    Vec3 begins_scene_m{0.0};  // where the first point that touches is then
    double reach_m = 0.0;      // how far it may move until the next update of the scene
};

}  // namespace burin::session

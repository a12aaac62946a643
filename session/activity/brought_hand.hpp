// SPDX-License-Identifier: MIT
// The hand that an activity brings into a session, in place of the one that mouse and commands would lead: a script
// that leads a simulated device, and where that stands in the scene. Plain data.
// Frames: the device's and the scene's. The scene sees the mapping as it is here, however it stands before a viewer.
#pragma once

#include <optional>
#include <vector>

#include "devices/hand/simulated_hand.hpp"
#include "devices/haptic/wand_description.hpp"
#include "session/held/placed_hand.hpp"

namespace burin::session {

struct BroughtHand {
    PlacedHand placed;
    // Leads the device; none: nobody does, since its samples are a recording's.
    std::optional<devices::SimulatedHand> leads = std::nullopt;
    // The device's handle, whatever file its name means, and which of its points touch; none: the device is a stylus.
    std::optional<devices::WandDescription> handle = std::nullopt;
    std::vector<devices::WandPoint> points = {};
};

}  // namespace burin::session

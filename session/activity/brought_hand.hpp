// SPDX-License-Identifier: MIT
// The hand that an activity brings into a session, in place of the one that mouse and commands would lead: what leads
// a device or has been read of it, and where that stands in the scene. A stroke file, a study's learner, its script and
// a recording are such hands. Plain data.
// Frames: the device's and the scene's. The scene sees the mapping as it is here, however it stands before a viewer.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "devices/hand/any_hand.hpp"
#include "devices/haptic/wand_description.hpp"
#include "session/held/placed_hand.hpp"

namespace burin::devices {
struct RecordedHand;  // devices/haptic/recorded_device.hpp
}

namespace burin::session {

struct BroughtHand {
    std::optional<PlacedHand> placed = std::nullopt;  // none: the session places it as it does a person's
    // Leads the device; none: the session does, unless samples are a recording's.
    std::optional<devices::AnyHand> leads = std::nullopt;
    // The device's handle, whatever file its name means, and which of its points touch; none: the device is a stylus.
    std::optional<devices::WandDescription> handle = std::nullopt;
    std::vector<devices::WandPoint> points = {};
    // What the device has read before, of as many parts as it has: it is opened for its description alone. Null: the
    // device is read.
    std::shared_ptr<const devices::RecordedHand> samples = nullptr;
};

}  // namespace burin::session

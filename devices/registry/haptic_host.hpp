// SPDX-License-Identifier: MIT
// Opens a force-feedback device by its name, whatever it is.
// Thread: the one that opens the session.
#pragma once

#include <string_view>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"

namespace burin::devices {

class Recordings;  // devices/haptic/recorded_device.hpp

// What a device needs of the program. The clock must outlive the device.
struct HapticHost {
    Clock& clock;  // of a device that is there it must be the machine's
    AnyHand hand;  // what holds the stylus of a simulated device, and leads the palm of a glove
    // A recording is done again, and no device is looked for: whatever there is stands in for one, with the same
    // description. Its samples are the recording's.
    bool stands_in = false;
    const Recordings* recordings = nullptr;  // reads those that are played as a device; null: none can be
};

// Opens the device of that name, or of NAME:FILE. An Error names the kinds that there are, or says why the device
// cannot be used.
[[nodiscard]] Result<OpenedDevice> open_haptic_device(std::string_view name, HapticHost host);

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// The registry of all force-feedback devices that there are. To add one, write its source beside
// devices/haptic/simulated_omni.cpp and enter it in the table of device_registry.cpp: the help of --device and its
// parsing read that table.
// Thread: the one that opens the session.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/simulated_omni.hpp"

namespace burin::devices {

// What a device needs of the program. The clock must outlive the device.
struct HapticHost {
    Clock& clock;   // of a device that is there it must be the machine's
    OmniHand hand;  // what holds the stylus of a simulated device, and leads the palm of a glove
    // A recording is done again, and no device is looked for: whatever there is stands in for one, with the same
    // description. Its samples are the recording's.
    bool stands_in = false;
};

struct HapticKind {
    std::string_view name;   // as --device spells it
    std::string_view usage;  // what it is, for the help
    std::size_t parts;       // that move by themselves
    // `file` is what follows the name and a colon: a description of the device; empty: none was named.
    Result<OpenedDevice> (*open)(HapticHost host, const std::string& file);
};
[[nodiscard]] std::span<const HapticKind> haptic_kinds();

// Returns how many parts the device of that name has; 0 where there is no such device.
[[nodiscard]] std::size_t parts_of_device(std::string_view name);

inline constexpr const char* kDefaultHapticDevice = "simulated";

// Opens the device of that name, or of NAME:FILE. An Error names the kinds that there are, or says why the device
// cannot be used.
[[nodiscard]] Result<OpenedDevice> open_haptic_device(std::string_view name, HapticHost host);

// Returns all names with what they are, for the help of --device.
[[nodiscard]] std::string haptic_usage();

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// A device that has been opened, whatever it is: the parts of it that move by themselves, and what it offers besides.
// A stylus is one part, and so is a wand; a glove has a part for each fingertip.
//
// Ownership: the parts are the opened device's; what they share is kept alive by them. Threads: opened by one thread;
// then each part's read() and write() are the haptic thread's (haptic_device.hpp).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "devices/haptic/amplifiers.hpp"
#include "devices/haptic/haptic_device.hpp"

namespace burin::devices {

struct DevicePart {
    std::string name;  // within the device: "index"; empty for the only part
    std::unique_ptr<HapticDevice> device;
};

struct OpenedDevice {
    std::vector<DevicePart> parts;     // at least one; all of one rate
    Amplifiers* amplifiers = nullptr;  // of all parts; null: none that can be switched from here
};

// Returns the opened device of the only part that a device has.
[[nodiscard]] inline OpenedDevice of_one_part(std::unique_ptr<HapticDevice> device, Amplifiers* amplifiers = nullptr) {
    OpenedDevice opened;
    opened.amplifiers = amplifiers;
    opened.parts.push_back({{}, std::move(device)});
    return opened;
}

}  // namespace burin::devices

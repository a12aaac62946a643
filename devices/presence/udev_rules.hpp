// SPDX-License-Identifier: MIT
// Rules by which Linux lets the person at the machine open devices that it would keep to itself: a file of the project.
#pragma once

#include <string>

namespace burin::devices {

inline constexpr const char* kUdevRules = "assets/devices/70-burin-devices.rules";

// Returns what to do where a device may not be opened.
[[nodiscard]] inline std::string udev_remedy() {
    return "install the project's rules: sudo cp " + std::string(kUdevRules) +
           " /etc/udev/rules.d/ && sudo udevadm control --reload-rules && sudo udevadm trigger, and plug it in again";
}

}  // namespace burin::devices

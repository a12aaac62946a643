// SPDX-License-Identifier: MIT
// Rules by which Linux lets the person at the machine open devices that it would keep to itself: a file of the project.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "base/assets.hpp"

namespace burin::devices {

inline constexpr const char* kUdevRules = "70-burin-devices.rules";

// Returns what to do where a device may not be opened: where the rules are installed, as the package does it, they let
// the person at the machine and the group plugdev open it; else they have to be installed.
[[nodiscard]] inline std::string udev_remedy() {
    for (const char* folder : {"/etc/udev/rules.d/", "/usr/lib/udev/rules.d/", "/lib/udev/rules.d/"}) {
        std::error_code ignored;
        if (std::filesystem::exists(std::string(folder) + kUdevRules, ignored))
            return std::string(folder) + kUdevRules +
                   " lets the person at the machine open it, and the group plugdev: plug it in again, or from afar: "
                   "sudo "
                   "adduser $USER plugdev, and log in anew";
    }
    return "install the project's rules: sudo cp " + asset_path("devices/" + std::string(kUdevRules)) +
           " /etc/udev/rules.d/ && sudo udevadm control --reload-rules && sudo udevadm trigger, and plug it in again";
}

}  // namespace burin::devices

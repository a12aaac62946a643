// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "base/places.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/presence/udev_rules.hpp"

namespace burin::devices {

std::vector<DevicePresence> look_for_gloves() {
    std::vector<DevicePresence> found;
    for (const auto& entry : entries_of("/dev").value_or(std::vector<std::filesystem::path>())) {
        const std::string path = entry.string();
        if (!path.starts_with("/dev/ttyUSB") && !path.starts_with("/dev/ttyACM")) continue;
        const std::string name = "glove:" + path;
        if (::access(path.c_str(), R_OK | W_OK) == 0)
            found.push_back({Presence::perhaps,
                             name,
                             "a serial line is there; whether a glove is on it shows when it is opened",
                             {}});
        else
            found.push_back(
                {Presence::forbidden, name, "the serial line may not be opened by this user",
                 "join the group that owns serial ports: sudo usermod -aG dialout $USER, and log in again; or " +
                     udev_remedy()});
    }
    std::ranges::sort(found, {}, &DevicePresence::name);
    if (found.empty())
        found.push_back({Presence::absent, "glove:PORT", "there is no serial line (/dev/ttyUSB0, /dev/ttyACM0 ...)",
                         "plug its line in, or burin devices emulate glove"});
    return found;
}

}  // namespace burin::devices

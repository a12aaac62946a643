// SPDX-License-Identifier: MIT
// Looks for all devices and trackers that Burin knows, without moving or reserving any: for `burin devices`.
// Thread: the one that calls. Takes up to some seconds where something does not answer.
#pragma once

#include <string_view>
#include <vector>

#include "devices/presence/device_presence.hpp"

namespace burin::devices {

struct LookedForKind {
    std::string_view option;  // which option takes it: --device, --tracker or --lsl
    std::string_view usage;
    std::vector<DevicePresence> found;  // at least one: what is there, or why nothing is
};
[[nodiscard]] std::vector<LookedForKind> look_for_devices();

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
#include "devices/registry/present_devices.hpp"

#include <string>

#include "devices/lsl/lsl_api.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_kinds.hpp"
#include "devices/trackers/tracker.hpp"

namespace burin::devices {

std::vector<LookedForKind> look_for_devices() {
    std::vector<LookedForKind> all;
    for (const HapticKind& kind : haptic_kinds()) {
        LookedForKind looked{"--device", kind.usage, {}};
        if (kind.open.is_driver())
            looked.found = kind.open.look();
        else if (kind.might_be_there != nullptr)
            looked.found = kind.might_be_there();
        else
            looked.found = {{Presence::there, std::string(kind.name), "simulated: it needs nothing", {}}};
        all.push_back(std::move(looked));
    }
    for (const TrackerKind& kind : tracker_kinds()) {
        LookedForKind looked{"--tracker", kind.usage, {}};
        if (kind.look != nullptr)
            looked.found = kind.look();
        else
            looked.found = {{Presence::perhaps,
                             std::string(kind.scheme) + ":PORT",
                             "it is sent to: whoever sends shows in the session",
                             {}}};
        all.push_back(std::move(looked));
    }
    all.push_back({"--lsl", "streams by Lab Streaming Layer", {look_for_lsl()}});
    return all;
}

}  // namespace burin::devices

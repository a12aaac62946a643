// SPDX-License-Identifier: MIT
// The rows of the registry of force-feedback devices (devices/registry/device_registry.hpp). A row that lacks something
// does not compile (opening.hpp).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "devices/haptic/wand_description.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/registry/opening.hpp"

namespace burin::devices {

struct HapticKind {
    std::string_view name;   // as --device spells it
    std::string_view usage;  // what it is, for the help
    // Mean what they mean in DeviceNature:
    Needed<std::size_t> parts;
    Needed<bool> is_upright, is_worn, felt_by_person, has_amplifiers;
    // Returns the handle's description: of the file, or the program's where none is named; null: it has no handle.
    Result<WandDescription> (*handle)(const std::string& file);
    Opening open;
    // Says what of a kind without a driver might be there; null: it is simulated and always there.
    std::vector<DevicePresence> (*might_be_there)() = nullptr;
    // Returns the file in what follows the name, where more than a file can; null: all of it is the file.
    std::string (*file_of)(const std::string& text) = nullptr;
    // Mean what they mean in DeviceNature.
    bool leads_itself = false, has_force = true;
    bool takes_text = true;  // behind its name and a colon; false: the name is all of it
};
[[nodiscard]] std::span<const HapticKind> haptic_kinds();

}  // namespace burin::devices

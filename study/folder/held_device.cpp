// SPDX-License-Identifier: MIT
#include "study/folder/held_device.hpp"

#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"

#include <algorithm>
#include <array>

namespace burin::study {
namespace {

constexpr std::array kHandNames{"learner",         "script",   "recording", "simulated device",
                                "emulated device", "not told", "device"};

// The one name that an earlier Burin gave any wand, simulated or not.
constexpr const char* kAnyWandOnce = "simulated wand";

}  // namespace

const char* name_of(Hand hand) { return kHandNames[static_cast<std::size_t>(hand)]; }

std::optional<Hand> hand_named(std::string_view name) {
    const auto found = std::ranges::find(kHandNames, name);
    if (found == kHandNames.end()) return std::nullopt;
    return static_cast<Hand>(found - kHandNames.begin());
}

Hand hand_of(const devices::DeviceNature& nature) {
    if (nature.is_played) return Hand::recording;
    if (nature.felt_by_person) return Hand::device;
    return nature.is_emulated && nature.has_force ? Hand::emulated_device : Hand::simulated_device;
}

std::string text_of(const HeldDevice& held) {
    const char* felt = held.felt_by_person()       ? "; felt by a person"
                       : held.hand == Hand::untold ? "; whether a person felt it is not told"
                                                   : "; felt by no person";
    return held.device + " (" + name_of(held.hand) + felt + ")";
}

HeldDevice held_by_name(const std::string& device) {
    if (device == kScriptedDevice) return {device, Hand::script};
    if (device == kAnyWandOnce) return {device, Hand::untold};
    const auto nature = devices::nature_of_name(device);
    return {device, nature ? hand_of(*nature) : Hand::untold};
}

}  // namespace burin::study

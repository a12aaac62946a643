// SPDX-License-Identifier: MIT
#include "devices/haptic/device_registry.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.hpp"

namespace burin::devices {
namespace {

Result<std::unique_ptr<HapticDevice>> open_simulated_omni(HapticHost host) {
    return std::make_unique<SimulatedOmni>(std::move(host.hand), OmniModel{}, &host.clock);
}

constexpr std::array kKinds{
    HapticKind{kDefaultHapticDevice, "a PHANTOM Omni in a simulated hand", open_simulated_omni},
};

}  // namespace

std::span<const HapticKind> haptic_kinds() { return kKinds; }

Result<std::unique_ptr<HapticDevice>> open_haptic_device(std::string_view name, HapticHost host) {
    const auto kind = std::ranges::find(kKinds, name, &HapticKind::name);
    if (kind != kKinds.end()) return kind->open(std::move(host));
    std::array<std::string_view, kKinds.size()> names;
    std::ranges::transform(kKinds, names.begin(), &HapticKind::name);
    return fail("haptic device " + std::string(name), "is no device that Burin knows",
                "did you mean " + std::string(nearest_name(name, names)) + "? There are: " + joined(names));
}

std::string haptic_usage() {
    std::string text;
    for (const HapticKind& kind : kKinds) {
        if (!text.empty()) text += "; ";
        text += std::string(kind.name) + ": " + std::string(kind.usage);
    }
    return text;
}

}  // namespace burin::devices

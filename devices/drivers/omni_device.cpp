// SPDX-License-Identifier: MIT
#include "devices/drivers/omni_device.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "devices/drivers/hd_servo.hpp"
#include "devices/drivers/library_beside.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/hd_shared.hpp"
#include "devices/presence/udev_rules.hpp"

namespace burin::devices {
namespace {

DeviceDescription omni_description() {
    return describe_served_arm("PHANTOM Omni", OmniModel{}, seconds(SimulatedOmni::kDelay_ns));
}

}  // namespace

Result<OpenedDevice> open_omni(const std::string& name_at_library, AnyHand hand, Clock& clock) {
    const std::size_t at = name_at_library.find('@');
    const std::string name = name_at_library.substr(0, at);
    const auto library = library_chosen("haptic device omni " + name, at != std::string::npos,
                                        at != std::string::npos ? name_at_library.substr(at + 1) : std::string(), name,
                                        kEmulatedHdLibrary, kHdLibrary);
    if (!library) return std::unexpected(library.error());
    auto servo = HdServo::of_library(*library);
    if (!servo) return std::unexpected(servo.error());
    auto device = (*servo)->open(name);
    if (!device) {
        const bool runs = !name.starts_with("emulated") || std::ranges::count(emulated_omnis(), name) > 0;
        if (runs) return std::unexpected(device.error());
        return fail(device.error().where, device.error().what,
                    "no emulator runs by this name: start it in another terminal, burin devices emulate omni" +
                        (name == "emulated" ? std::string() : " --at " + name));
    }
    return served_arm(std::move(*device), omni_description(), std::move(hand), clock);
}

OpenedDevice omni_that_rests(Clock& clock) { return arm_that_rests(omni_description(), clock); }

std::vector<DevicePresence> look_for_omnis() { return look_for_omnis(KernelPlaces{}); }

std::vector<DevicePresence> look_for_omnis(const KernelPlaces& places) {
    std::vector<DevicePresence> found;
    constexpr std::uint16_t k3dSystems = 0x2988;
    if (const std::string files = forbidden_among(shown_devices_of(k3dSystems, places)); !files.empty())
        found.push_back(
            {Presence::forbidden, kOmni, "a Touch at " + files + " may not be opened by this user", udev_remedy()});
    if (auto api = load_hd_api(kHdLibrary); api)
        found.push_back({Presence::perhaps,
                         kOmni,
                         "OpenHaptics is installed; whether a device is plugged in shows when it is opened",
                         {}});
    else
        found.push_back({api.error().what.contains("has no function") ? Presence::unusable : Presence::absent, kOmni,
                         api.error().what, api.error().remedy});
    for (const std::string& name : emulated_omnis())
        found.push_back({Presence::there, std::string(kOmni) + ":" + name, "an emulated one", {}});
    return found;
}

}  // namespace burin::devices

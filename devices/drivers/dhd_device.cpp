// SPDX-License-Identifier: MIT
#include "devices/drivers/dhd_device.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>
#include <utility>

#include "devices/drivers/dhd_line.hpp"
#include "devices/drivers/library_beside.hpp"
#include "devices/presence/dhd_shared.hpp"
#include "devices/presence/udev_rules.hpp"

namespace burin::devices {
namespace {

DeviceDescription dhd_description() {
    return describe_served_arm("Force Dimension", omega_model(), seconds(SimulatedOmni::kDelay_ns));
}

std::optional<DhdChoice> dhd_chosen(const std::string& text) {
    if (text.empty()) return DhdChoice{};
    if (text.starts_with("emulated")) return DhdChoice{.serial = emulated_serial(text)};
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < 0) return std::nullopt;
    return number < 10 ? DhdChoice{.serial = {}, .index = number} : DhdChoice{.serial = number};
}

}  // namespace

OmniModel omega_model() {
    return {.workspace_m = Vec3(0.15, 0.15, 0.11),
            .resolution_m = 0.00001,
            .apparent_mass_kg = 0.2,
            .friction_N = 0.2,
            .damping_Ns_per_m = 0.2,
            .max_force_N = 12.0,
            .max_stiffness_N_per_m = 5000.0,
            .watchdog_s = 0.0};
}

Result<OpenedDevice> open_dhd(const std::string& choice_at_library, AnyHand hand, Clock& clock) {
    const std::size_t at = choice_at_library.find('@');
    const std::string first = choice_at_library.substr(0, at);
    const std::string name = kDhd + (first.empty() ? std::string() : ":" + first);
    const auto choice = dhd_chosen(first);
    if (!choice)
        return fail(
            "haptic device " + name, "names no device",
            "write a place in the library's list, from dhd:0, or a serial number, and @FILE for a library elsewhere");
    const bool is_emulated = first.starts_with("emulated");
    if (is_emulated && std::ranges::count(emulated_dhds(), first) == 0)
        return fail("haptic device " + name, "no emulator runs by this name",
                    "start it in another terminal: burin devices emulate dhd" +
                        (first == "emulated" ? std::string() : " --at " + first));
    const auto library = library_chosen("haptic device " + name, at != std::string::npos,
                                        at != std::string::npos ? choice_at_library.substr(at + 1) : std::string(),
                                        first, kEmulatedDhdLibrary, {});
    if (!library) return std::unexpected(library.error());
    auto api = library->empty() ? load_usual_dhd_api() : load_dhd_api(*library);
    if (!api) return std::unexpected(api.error());
    auto servo = LineServo::open(std::make_unique<DhdLine>(name, *api, *choice));
    if (!servo) return std::unexpected(servo.error());
    return served_arm(std::move(*servo), dhd_description(), std::move(hand), clock);
}

OpenedDevice dhd_that_rests(Clock& clock) { return arm_that_rests(dhd_description(), clock); }

std::vector<DevicePresence> look_for_dhds() { return look_for_dhds(KernelPlaces{}); }

std::vector<DevicePresence> look_for_dhds(const KernelPlaces& places) {
    std::vector<DevicePresence> found;
    constexpr std::uint16_t kForceDimension = 0x1451;
    if (const std::string files = forbidden_among(shown_devices_of(kForceDimension, places)); !files.empty())
        found.push_back({Presence::forbidden, kDhd,
                         "a Force Dimension device at " + files + " may not be opened by this user", udev_remedy()});
    if (auto api = load_usual_dhd_api(); !api)
        found.push_back({api.error().what.contains("cannot be loaded") ? Presence::absent : Presence::unusable, kDhd,
                         api.error().what, api.error().remedy});
    else if (const int count = api->device_count(); count > 0)
        for (int i = 0; i < count; ++i)
            found.push_back({Presence::there,
                             std::string(kDhd) + ":" + std::to_string(i),
                             "a Force Dimension device, as the library counts them",
                             {}});
    else
        found.push_back({Presence::absent, kDhd, "the Force Dimension SDK is installed and sees no device",
                         "plug one in and switch it on"});
    for (const std::string& name : emulated_dhds())
        found.push_back({Presence::there, std::string(kDhd) + ":" + name, "an emulated one", {}});
    return found;
}

}  // namespace burin::devices

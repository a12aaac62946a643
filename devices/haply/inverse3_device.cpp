// SPDX-License-Identifier: MIT
#include "devices/haply/inverse3_device.hpp"

#include <charconv>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/try.hpp"
#include "devices/haply/inverse3_line.hpp"
#include "devices/presence/emulator_socket.hpp"
#include "devices/served/line_servo.hpp"

namespace burin::devices {
namespace {

DeviceDescription inverse3_description() {
    constexpr double kServices_s = 0.001;  // of two messages, and of the service's own line to the device
    return describe_served_arm("Haply Inverse3", inverse3_model(), kServices_s);
}

struct Inverse3Choice {
    std::string id, emulator;
    NetworkAddress service = inverse3_service();
};
std::optional<Inverse3Choice> chosen_inverse3(const std::string& text) {
    Inverse3Choice choice;
    if (text.starts_with(kEmulatedName)) {
        choice.emulator = text;
        return choice;
    }
    const std::size_t at = text.find('@');
    const bool names_service = at != std::string::npos || text.contains(':');
    if (!names_service || at != std::string::npos) choice.id = text.substr(0, at);
    if (!names_service) return choice;
    const auto service = network_address(at != std::string::npos ? text.substr(at + 1) : text, inverse3_service());
    if (!service || (at != std::string::npos && choice.id.empty())) return std::nullopt;
    choice.service = *service;
    return choice;
}

// The emulator says its service's port to whoever asks for it by its name.
Result<NetworkAddress> emulated_service(const std::string& where, const std::string& emulator) {
    BURIN_TRY(told, connect_to_emulator(where, kInverse3, emulator));
    NetworkAddress service = inverse3_service();
    const char* const end = told.greeting.data() + told.greeting.size();
    if (std::from_chars(told.greeting.data(), end, service.port).ec != std::errc{})
        return fail(where, "the emulator says no port", "start it again: burin devices emulate inverse3");
    return service;
}

}  // namespace

OmniModel inverse3_model() {
    return {.workspace_m = Vec3(0.16, 0.12, 0.12),
            .resolution_m = 0.00005,
            .apparent_mass_kg = 0.15,
            .friction_N = 0.2,
            .damping_Ns_per_m = 0.2,
            .max_force_N = kInverse3Most_N,
            .max_stiffness_N_per_m = 1000.0,
            .watchdog_s = 0.0};
}

Result<void> check_inverse3(const std::string& choice) {
    if (chosen_inverse3(choice)) return {};
    return fail("haptic device " + std::string(kInverse3) + ":" + choice, "names neither a device nor a service",
                "write inverse3, inverse3:ID, inverse3:HOST:PORT or inverse3:ID@HOST:PORT; burin devices lists IDs");
}

Result<OpenedDevice> open_inverse3(const std::string& choice_text, AnyHand hand, Clock& clock) {
    BURIN_TRY_DO(check_inverse3(choice_text));
    const std::string name = kInverse3 + (choice_text.empty() ? std::string() : ":" + choice_text);
    const std::string where = "haptic device " + name;
    const auto choice = chosen_inverse3(choice_text);
    auto line = std::make_unique<Inverse3Line>(
        name,
        [where, choice]() -> Result<NetworkAddress> {
            return choice->emulator.empty() ? Result<NetworkAddress>(choice->service)
                                            : emulated_service(where, choice->emulator);
        },
        choice->id);
    BURIN_TRY(servo, LineServo::open(std::move(line)));
    return served_arm(std::move(servo), inverse3_description(), std::move(hand), clock);
}

OpenedDevice inverse3_that_rests(Clock& clock) { return arm_that_rests(inverse3_description(), clock); }

std::vector<DevicePresence> look_for_inverse3s() { return look_for_inverse3s(inverse3_service()); }

std::vector<DevicePresence> look_for_inverse3s(const NetworkAddress& service) {
    constexpr Nanoseconds kLooks_ns = 500'000'000;
    std::vector<DevicePresence> found;
    const std::string at = service.port == inverse3_service().port ? "" : "@" + service.text();
    if (const auto greeting = greet_inverse3(kInverse3, service, kLooks_ns); !greeting) {
        const bool is_absent = greeting.error().what.starts_with("no service");
        found.push_back({is_absent ? Presence::absent : Presence::unusable, kInverse3, greeting.error().what,
                         greeting.error().remedy});
    } else if (greeting->words.devices.empty()) {
        found.push_back({Presence::absent, kInverse3, "Haply's service runs and sees no Inverse3",
                         "plug one in and switch it on: its power and its USB cable"});
    } else {
        for (const Inverse3State& device : greeting->words.devices) {
            const bool is_well = device.trouble.value_or(Inverse3Trouble::none) == Inverse3Trouble::none;
            found.push_back({is_well ? Presence::there : Presence::unusable,
                             std::string(kInverse3) + ":" + device.id + at,
                             is_well ? "an Inverse3, as Haply's service sees it"
                                     : "an Inverse3 that has no power or is not calibrated, as Haply's service says",
                             is_well ? "" : "plug its power supply in, and calibrate it as its manual says"});
        }
    }
    for (const std::string& name : running_emulators(kInverse3))
        found.push_back({Presence::there, std::string(kInverse3) + ":" + name, "an emulated one", {}});
    return found;
}

}  // namespace burin::devices

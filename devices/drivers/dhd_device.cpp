// SPDX-License-Identifier: MIT
#include "devices/drivers/dhd_device.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>
#include <utility>

#include "base/try.hpp"
#include "devices/drivers/arm_models.hpp"
#include "devices/drivers/dhd_line.hpp"
#include "devices/drivers/library_beside.hpp"
#include "devices/presence/dhd_shared.hpp"
#include "devices/presence/udev_rules.hpp"

namespace burin::devices {
namespace {

DeviceDescription dhd_description(const ArmModel& model) {
    return describe_served_arm(model.name, model.figures, seconds(SimulatedOmni::kDelay_ns));
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

OmniModel omega_model() { return dhd_model_called("omega").figures; }

Result<void> check_dhd(const std::string& choice_with_model) {
    const auto [choice_at_library, named_model] = without_model(choice_with_model);
    const std::string first = choice_at_library.substr(0, choice_at_library.find('@'));
    const std::string name = kDhd + (first.empty() ? std::string() : ":" + first);
    if (!dhd_chosen(first))
        return fail(
            "haptic device " + name, "names no device",
            "write a place in the library's list, from dhd:0, or a serial number, and @FILE for a library elsewhere");
    const bool names_model = choice_at_library != choice_with_model;
    if (names_model && dhd_model_called(named_model).key != named_model)
        return fail("haptic device " + name, named_model.empty() ? "names no model" : "has no model " + named_model,
                    "write one of " + dhd_model_keys());
    return check_library_named("haptic device " + name, choice_at_library);
}

Result<OpenedDevice> open_dhd(const std::string& choice_with_model, AnyHand hand, Clock& clock) {
    BURIN_TRY_DO(check_dhd(choice_with_model));
    const auto [choice_at_library, named_model] = without_model(choice_with_model);
    const std::size_t at = choice_at_library.find('@');
    const std::string first = choice_at_library.substr(0, at);
    const std::string name = kDhd + (first.empty() ? std::string() : ":" + first);
    auto choice = dhd_chosen(first);
    const bool is_emulated = first.starts_with("emulated");
    if (is_emulated && std::ranges::count(emulated_dhds(), first) == 0)
        return fail("haptic device " + name, "no emulator runs by this name",
                    "start it in another terminal: burin devices emulate dhd" +
                        (first == "emulated" ? std::string() : " --at " + first));
    BURIN_TRY(library, library_chosen("haptic device " + name, at != std::string::npos,
                                      at != std::string::npos ? choice_at_library.substr(at + 1) : std::string(), first,
                                      kEmulatedDhdLibrary, {}));
    BURIN_TRY(api, library.empty() ? load_usual_dhd_api() : load_dhd_api(library));
    if (!named_model.empty()) choice->most_N = dhd_model_called(named_model).figures.max_force_N;
    auto line = std::make_unique<DhdLine>(name, api, *choice);
    const DhdLine* const opened_line = line.get();  // the servo's, and so the device's, from now on
    BURIN_TRY(servo, LineServo::open(std::move(line)));
    const ArmModel& model = named_model.empty() ? dhd_model(opened_line->type()) : dhd_model_called(named_model);
    OpenedDevice opened = served_arm(std::move(servo), dhd_description(model), std::move(hand), clock);
    if (&model != &dhd_model_called("omega"))
        opened.settled = std::string(kDhd) + ":" + with_model(choice_at_library, model.key);
    return opened;
}

OpenedDevice dhd_that_rests(const std::string& choice_at_library, Clock& clock) {
    return arm_that_rests(dhd_description(dhd_model_called(without_model(choice_at_library).model)), clock);
}

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

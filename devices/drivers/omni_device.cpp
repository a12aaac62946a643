// SPDX-License-Identifier: MIT
#include "devices/drivers/omni_device.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/drivers/arm_models.hpp"
#include "devices/drivers/hd_servo.hpp"
#include "devices/drivers/library_beside.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/hd_shared.hpp"
#include "devices/presence/udev_rules.hpp"

namespace burin::devices {
namespace {

DeviceDescription omni_description(const ArmModel& model) {
    return describe_served_arm(model.name, model.figures, seconds(SimulatedOmni::kDelay_ns));
}

// Tells of a model that its library does not name, or names and gives less force than that has.
void tell_if_unsure(HdDevice& device, const ArmModel& described) {
    std::string why;
    if (!hd_knows(device.model()))
        why = "its library calls it \"" + device.model() + "\", which is not known here";
    else if (device.most_N() > 0.0 &&
             device.most_N() < hd_model(device.model(), std::numeric_limits<double>::infinity()).figures.max_force_N)
        why = formatted("its library says that it gives %.1f N, less than a ", device.most_N()) + device.model();
    if (why.empty()) return;
    device.tell_first("the omni is described as a " + std::string(described.name) + ": " + why +
                      "; name its model if it is another, as in omni:NAME,model=touch-x (" + hd_model_keys() + ")");
}

}  // namespace

Result<void> check_omni(const std::string& name_with_model) {
    const auto [name_at_library, named_model] = without_model(name_with_model);
    const bool names_model = name_at_library != name_with_model;
    if (names_model && hd_model_called(named_model).key != named_model)
        return fail("haptic device omni " + name_at_library,
                    named_model.empty() ? "names no model" : "has no model " + named_model,
                    "write one of " + hd_model_keys());
    return check_library_named("haptic device omni " + name_at_library, name_at_library);
}

Result<OpenedDevice> open_omni(const std::string& name_with_model, AnyHand hand, Clock& clock) {
    BURIN_TRY_DO(check_omni(name_with_model));
    const auto [name_at_library, named_model] = without_model(name_with_model);
    const std::size_t at = name_at_library.find('@');
    const std::string name = name_at_library.substr(0, at);
    BURIN_TRY(library, library_chosen("haptic device omni " + name, at != std::string::npos,
                                      at != std::string::npos ? name_at_library.substr(at + 1) : std::string(), name,
                                      kEmulatedHdLibrary, kHdLibrary));
    BURIN_TRY(servo, HdServo::of_library(library));
    auto device = servo->open(name);
    if (!device) {
        const bool runs = !name.starts_with("emulated") || std::ranges::count(emulated_omnis(), name) > 0;
        if (runs) return std::unexpected(device.error());
        return fail(device.error().where, device.error().what,
                    "no emulator runs by this name: start it in another terminal, burin devices emulate omni" +
                        (name == "emulated" ? std::string() : " --at " + name));
    }
    const ArmModel& model =
        named_model.empty() ? hd_model((*device)->model(), (*device)->most_N()) : hd_model_called(named_model);
    if (named_model.empty()) tell_if_unsure(**device, model);
    OpenedDevice opened = served_arm(std::move(*device), omni_description(model), std::move(hand), clock);
    if (&model != &hd_model_called("omni"))
        opened.settled = std::string(kOmni) + ":" + with_model(name_at_library, model.key);
    return opened;
}

OpenedDevice omni_that_rests(const std::string& name_at_library, Clock& clock) {
    return arm_that_rests(omni_description(hd_model_called(without_model(name_at_library).model)), clock);
}

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

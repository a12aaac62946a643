// SPDX-License-Identifier: MIT
#include "devices/registry/device_registry.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "devices/haptic/steered_fingers.hpp"
#include "devices/haptic/wand_file.hpp"

namespace burin::devices {
namespace {

Result<OpenedDevice> open_simulated_omni(HapticHost host, const std::string& file) {
    if (!file.empty())
        return fail("haptic device " + std::string(kDefaultHapticDevice), "takes no description: " + file,
                    "write the name alone");
    return of_one_part(std::make_unique<SimulatedOmni>(std::move(host.hand), OmniModel{}, &host.clock));
}

Result<OpenedDevice> open_simulated_wand(HapticHost host, const std::string& file) {
    Result<WandDescription> wand = file.empty() ? WandDescription{} : read_wand(file);
    if (!wand) return std::unexpected(wand.error());
    auto opened = std::make_unique<SimulatedWand>(std::move(host.hand), std::move(*wand), &host.clock);
    Amplifiers* const amplifiers = opened.get();
    return of_one_part(std::move(opened), amplifiers);
}

Result<OpenedDevice> open_simulated_fingers(HapticHost host, const std::string& file) {
    if (!file.empty())
        return fail("haptic device " + std::string(kSimulatedFingers), "takes no description: " + file,
                    "write the name alone");
    return simulated_fingers(std::move(host.hand), host.clock);
}

Result<OpenedDevice> open_glove_at(HapticHost host, const std::string& port) {
    const std::string where = "haptic device " + std::string(kGlove);
    if (host.stands_in) return open_glove({}, std::move(host.hand), host.clock);
    if (port.empty()) return fail(where, "names no port", "write one: glove:/dev/ttyUSB0");
    if (dynamic_cast<MonotonicClock*>(&host.clock) == nullptr)
        return fail(where, "is on a line in real time, and this session's time is simulated",
                    "run it in a window, or with --record FILE.session, which plays an --input in real time");
    return open_glove(port, std::move(host.hand), host.clock);
}

Result<OpenedDevice> open_simulated_glove(HapticHost host, const std::string& shape) {
    const auto grip = shape.empty() ? GripShape::whole : grip_named(shape);
    if (!grip)
        return fail("haptic device " + std::string(kSimulatedGlove), "closes in no way that is called " + shape,
                    "write one of " + joined(kGripNames));
    return simulated_glove(*grip, std::move(host.hand), host.clock);
}

constexpr std::array kKinds{
    HapticKind{kDefaultHapticDevice, "a PHANTOM Omni in a simulated hand", 1, open_simulated_omni},
    HapticKind{
        "simulated-wand",
        "a wand that is driven in three forces and two torques, in a simulated hand; simulated-wand:FILE.toml as "
        "FILE describes it",
        1, open_simulated_wand},
    HapticKind{kSimulatedFingers, "four fingertips of a simulated hand, each pushed by itself", kFingers,
               open_simulated_fingers},
    HapticKind{kGlove, "a glove that pushes four fingertips, on a serial line: glove:PORT, such as glove:/dev/ttyUSB0",
               kGloveFingers, open_glove_at},
    HapticKind{kSimulatedGlove,
               "the same without a line, in a simulated hand that the first button closes; simulated-glove:pinch or "
               "simulated-glove:point as it closes",
               kGloveFingers, open_simulated_glove},
};

}  // namespace

std::span<const HapticKind> haptic_kinds() { return kKinds; }

Result<OpenedDevice> open_haptic_device(std::string_view name, HapticHost host) {
    const std::string_view kind_name = name.substr(0, name.find(':'));
    const auto kind = std::ranges::find(kKinds, kind_name, &HapticKind::name);
    if (kind != kKinds.end())
        return kind->open(std::move(host), std::string(name.substr(std::min(name.size(), kind_name.size() + 1))));
    std::array<std::string_view, kKinds.size()> names;
    std::ranges::transform(kKinds, names.begin(), &HapticKind::name);
    return fail("haptic device " + std::string(name), "is no device that Burin knows",
                "did you mean " + std::string(nearest_name(kind_name, names)) + "? There are: " + joined(names));
}

std::size_t parts_of_device(std::string_view name) {
    const auto kind = std::ranges::find(kKinds, name.substr(0, name.find(':')), &HapticKind::name);
    return kind != kKinds.end() ? kind->parts : 0;
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

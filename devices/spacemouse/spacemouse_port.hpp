// SPDX-License-Identifier: MIT
// The cable to a SpaceMouse: a file of which each read gives one HID report, number first. It is the kernel's
// /dev/hidrawN, or the socket of an emulated device (devices/emulators/emulated_spacemouse.hpp), whose greeting is its
// two USB numbers. What is behind it makes no difference to the driver.
// Any thread; nothing waits but the greeting of an emulated one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/presence/owned_file.hpp"
#include "devices/spacemouse/spacemouse_report.hpp"

namespace burin::devices {

// As --device, --tracker and the emulator's command spell it.
inline constexpr const char* kSpaceMouse = "spacemouse";

struct SpaceMousePort {
    OwnedFile file;
    SpaceMouseProduct product;
};

// Where the kernel shows HID devices (Documentation/hid/hidraw.rst): a folder with one for each, and that of the files.
struct HidrawPlaces {
    std::filesystem::path devices = "/sys/class/hidraw", files = "/dev";
};

// Opens the SpaceMouse at a place: "hidraw3" as burin devices lists it, the name of an emulated one, or, empty, the
// first that the kernel shows. An Error says that there is none, or that it may not be opened, and what to do.
[[nodiscard]] Result<SpaceMousePort> open_spacemouse_port(const std::string& where, const std::string& place,
                                                          const HidrawPlaces& places = {});
// Looks for such devices, emulated ones included, and opens none. At least one: none is there.
[[nodiscard]] std::vector<DevicePresence> look_for_spacemice(const HidrawPlaces& places);
[[nodiscard]] inline std::vector<DevicePresence> look_for_spacemice() { return look_for_spacemice(HidrawPlaces{}); }

// The greeting of an emulated device, and the product that it says.
[[nodiscard]] std::string spacemouse_greeting(const SpaceMouseProduct& product);

}  // namespace burin::devices

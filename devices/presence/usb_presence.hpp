// SPDX-License-Identifier: MIT
// Which USB and HID devices of a maker the kernel shows, and whether this user may open their files, without opening
// any: a maker's library does not say why it finds none.
// Any thread; files are read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace burin::devices {

// Where the kernel shows them: a folder with one for each, and that of their files.
struct KernelPlaces {
    std::filesystem::path usb = "/sys/bus/usb/devices", usb_files = "/dev/bus/usb";
    std::filesystem::path hidraw = "/sys/class/hidraw", hidraw_files = "/dev";
};

struct ShownDevice {
    std::filesystem::path file;
    std::uint16_t product = 0;
    bool may_be_opened = false;
};
// Returns the devices of a maker by its number, those on USB before those that are HID, in the order of their files.
[[nodiscard]] std::vector<ShownDevice> shown_devices_of(std::uint16_t vendor, const KernelPlaces& places = {});

// Returns those that this user may not open, as "/dev/hidraw3, /dev/bus/usb/001/004"; empty: there are none.
[[nodiscard]] std::string forbidden_among(const std::vector<ShownDevice>& devices);

}  // namespace burin::devices

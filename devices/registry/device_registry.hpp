// SPDX-License-Identifier: MIT
// The registry of all force-feedback devices that there are. To add one, copy devices/sample/sample_device.hpp and its
// source, and enter it in the table of device_registry.cpp: the help of --device and its parsing read that table. A row
// that lacks something does not compile (opening.hpp).
// Thread: the one that opens the session.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace burin::devices {

struct DeviceNature;  // devices/registry/device_nature.hpp

class Recordings;  // devices/haptic/recorded_device.hpp

// Returns the nature of the device of that name, or of NAME:FILE. Fails where there is none of that name, and says
// which there are, and where its description cannot be read. A recorded device is of the nature of the one that was
// recorded.
[[nodiscard]] Result<DeviceNature> nature_of_device(std::string_view name, const Recordings* recordings = nullptr);
// Returns the same of the name alone: no file is read, so that there is no handle, and what a recording plays is not
// known.
[[nodiscard]] Result<DeviceNature> nature_of_name(std::string_view name);
// Returns whether the device of that name has a handle, whatever its description says of it; false where there is no
// such device.
[[nodiscard]] bool has_handle(std::string_view name, const Recordings* recordings = nullptr);
// Returns the names of all devices that have one, for people: "simulated-wand".
[[nodiscard]] std::string devices_with_handles();
// Returns the file that describes a device's handle: FILE of NAME:FILE; empty: none is named, or it has no handle.
[[nodiscard]] std::string handle_file_of(std::string_view name);

inline constexpr const char* kDefaultHapticDevice = "simulated";

// Returns all names with what they are, for the help of --device.
[[nodiscard]] std::string haptic_usage();

}  // namespace burin::devices

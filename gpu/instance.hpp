// SPDX-License-Identifier: MIT
// The Vulkan instance under a device: finds the loader, turns on what is asked for, and counts what the validation
// layer says (validation_messages(), device.hpp). For gpu/ alone. Any thread.
#pragma once

#include "gpu/shared_device.hpp"

namespace burin::gpu {

// Where there is no driver, or none that works.
inline constexpr const char* kNoDriver =
    "install the graphics card's driver, or install mesa-vulkan-drivers, which has one in software too";

// Creates the instance of a device that is being opened, with the extensions of the options. Fails where there is no
// loader or driver, and where an extension or the validation layer is missing.
[[nodiscard]] Result<void> create_instance(SharedDevice& opened, bool validation, const DeviceOptions& options = {});

}  // namespace burin::gpu

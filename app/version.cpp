// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/sculpt.hpp"
#include "gpu/device.hpp"

namespace burin {

void print_version() {
    std::printf("burin %s\n", BURIN_VERSION);
    const auto devices = gpu::list_devices();
    if (!devices) {
        std::printf("Vulkan: %s\n", devices.error().line().c_str());
        return;
    }
    std::printf("Vulkan devices:\n");
    for (const gpu::DeviceInfo& device : *devices) {
        std::printf("  %s%s%s\n", device.line().c_str(),
                    device.unusable.empty() ? "" : " - not usable: ", device.unusable.c_str());
    }
}

}  // namespace burin

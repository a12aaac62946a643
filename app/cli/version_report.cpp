// SPDX-License-Identifier: MIT
#include "app/cli/version_report.hpp"

#include <cstdio>
#include <thread>

#include "app/cli/library_versions.hpp"
#include "base/assets.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_kinds.hpp"
#include "devices/trackers/tracker.hpp"
#include "gpu/device.hpp"

namespace burin::app {
namespace {

void print_vulkan_devices() {
    const auto devices = gpu::list_devices();
    if (!devices) {
        std::printf("%s\n", devices.error().line().c_str());
        return;
    }
    std::printf("Vulkan devices:\n");
    for (const gpu::DeviceInfo& device : *devices) {
        std::printf("  %s%s%s\n", device.line().c_str(),
                    device.unusable.empty() ? "" : " - not usable: ", device.unusable.c_str());
    }
}

void print_libraries() {
    std::printf("libraries:");
    const char* between = " ";
    for (const LibraryVersion& library : library_versions()) {
        std::printf("%s%s %s", between, library.name.c_str(), library.version.c_str());
        between = ", ";
    }
    std::printf("; compiled with %s\n", __VERSION__);
}

}  // namespace

void print_version() {
    std::printf("burin %s\n", version_text().c_str());
    std::printf("assets: %s\n", assets_line().c_str());
    std::printf("engines: cpu, with %u cores; vulkan, on a device below\n", std::thread::hardware_concurrency());
    std::printf("drivers:");
    for (const devices::HapticKind& kind : devices::haptic_kinds()) std::printf(" %s", std::string(kind.name).c_str());
    for (const devices::TrackerKind& kind : devices::tracker_kinds())
        std::printf(" %s", std::string(kind.scheme).c_str());
    std::printf("\n");
    print_libraries();
    print_vulkan_devices();
}

}  // namespace burin::app

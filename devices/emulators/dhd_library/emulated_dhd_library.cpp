// SPDX-License-Identifier: MIT
// The emulated library of Force Dimension: the functions of DHD that Burin calls (devices/drivers/dhd_api.hpp), around
// emulated devices that run in processes of their own (devices/emulators/emulated_dhd.hpp). A session loads it in place
// of libdhd.so.3, so that the driver at work is the real one. It behaves as the driver has to expect of the maker's:
// one list of devices for the process, -1 and a last error where something fails, forces that act as they are written,
// an expert section that is shut until it is opened.
//
// State is static, as the interface is of C. What a test changes is told when it is compiled:
// BURIN_EMULATED_DHD_MAJOR, and BURIN_EMULATED_DHD_LACKS, which leaves a function out.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <string>

#include "devices/drivers/dhd_api.hpp"
#include "devices/presence/dhd_shared.hpp"

#ifndef BURIN_EMULATED_DHD_MAJOR
#define BURIN_EMULATED_DHD_MAJOR 3
#endif

namespace burin::devices {
namespace {

constexpr std::size_t kMostDhds = 8;

struct OpenedDhd {
    std::string name;
    DhdSharedMemory memory;
    std::array<double, 12> pose{};
    bool gives_force = false;
};

struct DhdLibrary {
    std::mutex mutex;
    std::array<std::optional<OpenedDhd>, kMostDhds> opened;
    int error = 0;
    bool is_expert = false;
    MonotonicClock clock;

    // Fails as the maker's does where there is none, or where it does not answer any more.
    OpenedDhd* device(char id) {
        const auto at = static_cast<std::size_t>(id);
        if (id < 0 || at >= kMostDhds || !opened[at]) {
            error = kDhdNoDevice;
            return nullptr;
        }
        if (!opened[at]->memory->is_alive(clock.now_ns())) {
            error = kDhdCommunication;
            return nullptr;
        }
        return &*opened[at];
    }
    // Returns the device's ID; one that is open already keeps its own.
    int open(const std::string& name) {
        const auto open = std::ranges::find_if(opened, [&](const auto& one) { return one && one->name == name; });
        if (open != opened.end()) return static_cast<int>(open - opened.begin());
        auto memory = DhdSharedMemory::open(name);
        if (!memory || !(*memory)->is_alive(clock.now_ns())) {
            error = kDhdNoDevice;
            return -1;
        }
        // It is another's as long as that process lives.
        const auto free = std::ranges::find_if(opened, [](const auto& one) { return !one; });
        if (free == opened.end() || !take_ownership((*memory)->owner)) {
            error = kDhdInUse;
            return -1;
        }
        free->emplace(OpenedDhd{name, std::move(*memory)});
        return static_cast<int>(free - opened.begin());
    }
};

DhdLibrary& dhd() {
    static DhdLibrary one;
    return one;
}

}  // namespace
}  // namespace burin::devices

using burin::devices::dhd;

extern "C" {

void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
    *major = BURIN_EMULATED_DHD_MAJOR;
    *minor = 17;
    *release = *revision = 0;
}

int dhdGetDeviceCount() { return static_cast<int>(burin::devices::emulated_dhds().size()); }

int dhdOpenID(char index) {
    const std::lock_guard lock(dhd().mutex);
    const auto names = burin::devices::emulated_dhds();
    if (index < 0 || static_cast<std::size_t>(index) >= names.size()) {
        dhd().error = burin::devices::kDhdNoDevice;
        return -1;
    }
    return dhd().open(names[static_cast<std::size_t>(index)]);
}

int dhdOpenSerial(int serial) {
    const std::lock_guard lock(dhd().mutex);
    for (const std::string& name : burin::devices::emulated_dhds())
        if (burin::devices::emulated_serial(name) == serial) return dhd().open(name);
    dhd().error = burin::devices::kDhdNoDevice;
    return -1;
}

int dhdClose(char id) {
    const std::lock_guard lock(dhd().mutex);
    const auto at = static_cast<std::size_t>(id);
    if (id < 0 || at >= dhd().opened.size() || !dhd().opened[at]) return -1;
    dhd().opened[at]->memory->owner = 0;
    dhd().opened[at].reset();
    return 0;
}

int dhdEnableForce(unsigned char on, char id) {
    const std::lock_guard lock(dhd().mutex);
    auto* const device = dhd().device(id);
    if (device == nullptr) return -1;
    device->gives_force = on != 0;
    return 0;
}

int dhdGetSystemType(char id) {
    const std::lock_guard lock(dhd().mutex);
    auto* const device = dhd().device(id);
    return device != nullptr ? device->memory->type.load() : -1;
}
const char* dhdGetSystemName(char) { return "emulated"; }

int dhdGetStatus(int* status, char id) {
    using namespace burin::devices;
    const std::lock_guard lock(dhd().mutex);
    auto* const device = dhd().device(id);
    if (device == nullptr) return -1;
    std::fill(status, status + 17, 0);
    const int off = device->memory->force_off;
    status[kDhdStatusPower] = status[kDhdStatusConnected] = 1;
    status[kDhdStatusReset] = device->memory->needs_reset;
    status[kDhdStatusForce] = device->gives_force && off == 0 ? 1 : 0;
    status[kDhdStatusForceOff] = off;
    return 0;
}

#ifndef BURIN_EMULATED_DHD_LACKS
unsigned int dhdGetButtonMask(char id) {
    const std::lock_guard lock(dhd().mutex);
    auto* const device = dhd().device(id);
    if (device == nullptr) return 0;
    // A gripper is no button until it is told to be one.
    const bool is_silent = burin::devices::dhd_type_grips(device->memory->type) && device->memory->emulates_button == 0;
    return is_silent ? 0 : device->memory->buttons.load();
}
#endif

int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double (*turn)[3], char id) {
    const std::lock_guard lock(dhd().mutex);
    auto* const device = dhd().device(id);
    if (device == nullptr) return -1;
    if (const auto pose = device->memory->pose.read()) device->pose = *pose;
    *x = device->pose[0];
    *y = device->pose[1];
    *z = device->pose[2];
    if (!burin::devices::dhd_has_wrist(device->memory->type)) return 0;  // the turn is left alone
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column) turn[row][column] = device->pose[3 + 3 * row + column];
    return 0;
}

// Also where the device does not answer: what is on its way is not taken back.
int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double, double, double, double, char id) {
    const std::lock_guard lock(dhd().mutex);
    const auto at = static_cast<std::size_t>(id);
    if (id >= 0 && at < dhd().opened.size() && dhd().opened[at]) {
        auto& device = *dhd().opened[at];
        const bool acts = device.gives_force && device.memory->force_off == 0;
        device.memory->force_N.write(acts ? std::array<double, 3>{fx, fy, fz} : std::array<double, 3>{});
        device.memory->frame_ns = dhd().clock.now_ns();
    }
    return dhd().device(id) != nullptr ? 0 : -1;
}

int dhdEmulateButton(unsigned char on, char id) {
    const std::lock_guard lock(dhd().mutex);
    auto* const device = dhd().device(id);
    if (device == nullptr || !burin::devices::dhd_type_grips(device->memory->type)) return -1;
    device->memory->emulates_button = on != 0 ? 1 : 0;
    return 0;
}

int dhdErrorGetLast() {
    const std::lock_guard lock(dhd().mutex);
    return dhd().error;
}

const char* dhdErrorGetStr(int error) {
    using namespace burin::devices;
    switch (error) {
        case 0: return "no error";
        case kDhdCommunication: return "communication error";
        case kDhdNoDevice: return "no device found";
        case kDhdNotExpert: return "expert mode disabled";
        case kDhdInUse: return "device is in use";
        default: return "an error";
    }
}

int dhdEnableExpertMode() {
    const std::lock_guard lock(dhd().mutex);
    dhd().is_expert = true;
    return 0;
}

// Stands in the header's expert section.
int dhdSetWatchdog(unsigned char steps, char id) {
    const std::lock_guard lock(dhd().mutex);
    if (!dhd().is_expert) {
        dhd().error = burin::devices::kDhdNotExpert;
        return -1;
    }
    auto* const device = dhd().device(id);
    if (device == nullptr) return -1;
    device->memory->watchdog = steps;
    return 0;
}

}  // extern "C"

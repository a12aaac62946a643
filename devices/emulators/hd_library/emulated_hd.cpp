// SPDX-License-Identifier: MIT
// The emulated library of an Omni's maker: the functions of HDAPI that Burin calls (devices/drivers/hd_api.hpp), around
// an emulated Omni that runs in a process of its own (devices/emulators/emulated_omni.hpp). A session loads it in place
// of libHD.so, so that the driver at work is the real one. It behaves as the driver has to expect of the maker's: one
// list of devices and one scheduler for the process, a thread that calls back a thousand times a second, a stack of
// errors with the newest first, forces that go out at the end of a frame.
//
// State is static, as the interface is of C. What a test changes is told when it is compiled:
// BURIN_EMULATED_HD_VERSION, and BURIN_EMULATED_HD_LACKS, which leaves a function out.
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "devices/drivers/hd_api.hpp"
#include "devices/presence/hd_shared.hpp"

#ifndef BURIN_EMULATED_HD_VERSION
#define BURIN_EMULATED_HD_VERSION "3.00.66"
#endif

namespace burin::devices {
namespace {

constexpr std::size_t kMostOpened = 4, kMostErrors = 64;

struct Opened {
    HdSharedMemory memory;
    std::array<double, 16> transform{};
    std::array<double, 3> force_N{};
    bool gives_force = false;
};

struct Library {
    std::recursive_mutex mutex;  // the callback calls what the program calls
    std::array<std::optional<Opened>, kMostOpened> opened;
    HdHandle current = kHdNoDevice;
    std::vector<HdError> errors;  // the newest last
    HdApi::Callback callback = nullptr;
    void* of_callback = nullptr;
    std::atomic<bool> runs = false;
    std::thread scheduler;
    MonotonicClock clock;

    [[nodiscard]] Opened* device(HdHandle handle) {
        return handle < kMostOpened && opened[handle] ? &*opened[handle] : nullptr;
    }
    void raise(unsigned int code, HdHandle handle) {
        if (errors.size() < kMostErrors) errors.push_back({code, static_cast<int>(errors.size()), handle});
    }
};

Library& library() {
    static Library one;
    return one;
}

void schedule_turns(Library& l) {
    // Asks for a real-time thread, as the maker's library has one; does without where the system refuses.
    sched_param priority{};
    priority.sched_priority = ::sched_get_priority_min(SCHED_FIFO) + 10;
    static_cast<void>(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &priority));
    constexpr Nanoseconds kPeriod_ns = 1'000'000;
    Nanoseconds due_ns = l.clock.now_ns();
    while (l.runs) {
        due_ns = std::max(due_ns + kPeriod_ns, l.clock.now_ns() - 5 * kPeriod_ns);
        l.clock.sleep_until(due_ns);
        const std::lock_guard lock(l.mutex);
        if (l.callback != nullptr && l.callback(l.of_callback) != kHdCallAgain) l.callback = nullptr;
    }
}

}  // namespace
}  // namespace burin::devices

using burin::devices::HdError;
using burin::devices::HdHandle;
using burin::devices::library;

extern "C" {

HdHandle hdInitDevice(const char* name) {
    using namespace burin::devices;
    const std::lock_guard lock(library().mutex);
    const std::string wanted = name != nullptr ? name : "emulated";
    auto memory = HdSharedMemory::open(wanted.starts_with("emulated") ? wanted : "emulated");
    if (!memory || !(*memory)->is_alive(library().clock.now_ns())) {
        library().raise(kHdCommunication, kHdNoDevice);
        return kHdNoDevice;
    }
    for (HdHandle handle = 0; handle < kMostOpened; ++handle) {
        if (library().opened[handle]) continue;
        // It is another's as long as that process lives.
        if (!take_ownership((*memory)->owner)) {
            library().raise(kHdAlreadyOpened, kHdNoDevice);
            return kHdNoDevice;
        }
        library().opened[handle].emplace(Opened{std::move(*memory)});
        library().current = handle;
        return handle;
    }
    library().raise(kHdDeviceFault, kHdNoDevice);
    return kHdNoDevice;
}

void hdDisableDevice(HdHandle handle) {
    const std::lock_guard lock(library().mutex);
    if (auto* device = library().device(handle)) {
        device->memory->owner = 0;
        library().opened[handle].reset();
    }
}

void hdMakeCurrentDevice(HdHandle handle) {
    const std::lock_guard lock(library().mutex);
    library().current = handle;
}

void hdBeginFrame(HdHandle handle) {
    using namespace burin::devices;
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(handle);
    if (device == nullptr) return library().raise(0x0104, handle);
    if (!device->memory->is_alive(library().clock.now_ns())) library().raise(kHdCommunication, handle);
    if (const auto transform = device->memory->transform.read()) device->transform = *transform;
    if (const std::uint32_t error = device->memory->error) library().raise(error, handle);
}

void hdEndFrame(HdHandle handle) {
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(handle);
    if (device == nullptr) return;
    device->memory->force_N.write(device->gives_force ? device->force_N : std::array<double, 3>{});
    device->memory->frame_ns = library().clock.now_ns();
}

HdError hdGetError() {
    const std::lock_guard lock(library().mutex);
    if (library().errors.empty()) return {};
    const HdError newest = library().errors.back();
    library().errors.pop_back();
    return newest;
}

const char* hdGetErrorString(unsigned int code) {
    using namespace burin::devices;
    switch (code) {
        case 0: return "no error";
        case kHdWarmMotors: return "the motors are warm";
        case kHdTooFast: return "the velocity is too great";
        case kHdDeviceFault: return "the device is faulty";
        case kHdAlreadyOpened: return "the device is in use";
        case kHdCommunication: return "there is no communication with the device";
        default: return "an error";
    }
}

void hdEnable(unsigned int what) {
    const std::lock_guard lock(library().mutex);
    if (auto* device = library().device(library().current))
        device->gives_force = device->gives_force || what == burin::devices::kHdForceOutput;
}

void hdGetIntegerv(unsigned int what, int* to) {
    using namespace burin::devices;
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(library().current);
    if (device == nullptr) return library().raise(0x0104, library().current);
    if (what == kHdButtons) *to = static_cast<int>(device->memory->buttons.load());
    if (what == kHdCalibrationStyles) *to = static_cast<int>(device->memory->styles.load());
}

void hdGetDoublev(unsigned int what, double* to) {
    using namespace burin::devices;
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(library().current);
    if (device == nullptr) return library().raise(0x0104, library().current);
    if (what == kHdTransform) std::copy(device->transform.begin(), device->transform.end(), to);
    if (what == kHdMostForce) *to = device->memory->most_N;
    // As EmulatedOmni::kMiddle_hd_m and the Omni's workspace have it, in millimetres.
    constexpr std::array<double, 6> kBox_mm{-81.3, -20.95, -55.55, 81.3, 100.95, 15.55};
    if (what == kHdUsableWorkspace) std::copy(kBox_mm.begin(), kBox_mm.end(), to);
}

void hdSetDoublev(unsigned int what, const double* from) {
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(library().current);
    if (device != nullptr && what == burin::devices::kHdForce) device->force_N = {from[0], from[1], from[2]};
}

const char* hdGetString(unsigned int what) {
    if (what == burin::devices::kHdVersion) return BURIN_EMULATED_HD_VERSION;
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(library().current);
    return device != nullptr && what == burin::devices::kHdModel ? device->memory->model.data() : nullptr;
}

unsigned int hdCheckCalibration() {
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(library().current);
    return device != nullptr ? device->memory->calibration.load() : 0;
}

void hdUpdateCalibration(unsigned int how) {
    using namespace burin::devices;
    const std::lock_guard lock(library().mutex);
    auto* const device = library().device(library().current);
    if (device == nullptr) return library().raise(0x0104, library().current);
    constexpr unsigned int kInvalidValue = 0x0101;
    if ((how & device->memory->styles) == 0) return library().raise(kInvalidValue, library().current);
    // Encoders are reset wherever the arm stands; it is calibrated if that is its reset position.
    const bool is_done = how == kHdByEncoderReset ? device->memory->is_at_reset != 0
                                                  : device->memory->calibration == kHdCalibrationNeedsUpdate;
    if (!is_done) return;
    device->memory->calibration = kHdCalibrated;
    ++device->memory->calibrations;
}

void hdStartScheduler() {
    auto& l = library();
    if (l.runs.exchange(true)) return;
    l.scheduler = std::thread([&l] { burin::devices::schedule_turns(l); });
}

void hdStopScheduler() {
    auto& l = library();
    if (!l.runs.exchange(false)) return;
    l.scheduler.join();
}

#ifndef BURIN_EMULATED_HD_LACKS
unsigned long hdScheduleAsynchronous(burin::devices::HdApi::Callback callback, void* with, unsigned short) {
    const std::lock_guard lock(library().mutex);
    library().callback = callback;
    library().of_callback = with;
    return 1;
}
#endif

void hdUnschedule(unsigned long) {
    const std::lock_guard lock(library().mutex);
    library().callback = nullptr;
}

}  // extern "C"

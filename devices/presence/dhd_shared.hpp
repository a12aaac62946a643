// SPDX-License-Identifier: MIT
// What an emulated Force Dimension device and the emulated library of its maker share (devices/emulators/
// emulated_dhd.hpp, devices/emulators/dhd_library/). As the library has it: metres, its own axes.
#pragma once

#include "devices/presence/shared_memory.hpp"

namespace burin::devices {

struct DhdShared : SharedLife {
    static constexpr std::uint64_t kMagic = 0x6275'7269'6464'4836;  // "buriddH6": of this layout
    static constexpr const char* kPrefix = "burin-dhd-";

    // ---- The emulator's
    SharedNumbers<12> pose;  // place, then the rows of its turn
    std::atomic<std::uint32_t> buttons = 0;
    std::atomic<std::int32_t> type = 0;                        // as DHD numbers its devices
    std::atomic<std::int32_t> needs_reset = 0, force_off = 0;  // as DHD says why
    // ---- The library's
    std::atomic<Nanoseconds> frame_ns = 0;  // of its newest force
    SharedNumbers<3> force_N;
    std::atomic<std::uint32_t> owner = 0;  // the process that has opened it; 0: none
    std::atomic<std::uint32_t> watchdog = 0;
    std::atomic<std::uint32_t> emulates_button = 0;

    [[nodiscard]] bool is_alive(Nanoseconds now_ns) const noexcept { return SharedLife::is_alive(now_ns, kMagic); }
};

// Returns whether a device of this type has a wrist: a handle that turns. By dhdc.h the omega.3, the delta.3 and a
// Falcon have none; the omega.6 and .7, the delta.6 and the sigmas have one.
[[nodiscard]] constexpr bool dhd_has_wrist(int type) noexcept {
    return type == 34 || type == 35 || type == 36 || type == 37 || type == 61 || type == 62 || type == 64 ||
           type >= 102;
}

// Returns whether it has a gripper, by dhdc.h: the third hand's digit of its names, omega33x, sigma33x and lambda33x.
[[nodiscard]] constexpr bool dhd_type_grips(int type) noexcept {
    constexpr int kOmega331 = 35, kOmega331Left = 37, kSigma331 = 104, kSigma331Left = 105, kLambda331 = 108;
    return type == kOmega331 || type == kOmega331Left || type == kSigma331 || type == kSigma331Left ||
           type == kLambda331 || type == kLambda331 + 1;
}

using DhdSharedMemory = SharedMemory<DhdShared>;

// Returns the names of the emulated devices that run now.
[[nodiscard]] inline std::vector<std::string> emulated_dhds() { return emulated_of<DhdShared>(); }
// Returns the serial number of an emulated device of that name: FNV-1a, above the places of a list.
[[nodiscard]] inline int emulated_serial(const std::string& name) {
    std::uint32_t hash = 2166136261u;
    for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
    return 10 + static_cast<int>(hash & 0xffffff);
}

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// What an emulated Force Dimension device and the emulated library of its maker share (devices/emulators/
// emulated_dhd.hpp, devices/emulators/dhd_library/). As the library has it: metres, its own axes.
#pragma once

#include "devices/presence/shared_memory.hpp"

namespace burin::devices {

struct DhdShared : SharedLife {
    static constexpr std::uint64_t kMagic = 0x6275'7269'6464'4833;  // "buriddH3": of this layout
    static constexpr const char* kPrefix = "burin-dhd-";

    // ---- The emulator's
    SharedNumbers<12> pose;  // place, then the rows of its turn
    std::atomic<std::uint32_t> buttons = 0;
    std::atomic<std::int32_t> needs_reset = 0, force_off = 0;  // as DHD says why
    // ---- The library's
    std::atomic<Nanoseconds> frame_ns = 0;  // of its newest force
    SharedNumbers<3> force_N;
    std::atomic<std::uint32_t> owner = 0;  // the process that has opened it; 0: none
    std::atomic<std::uint32_t> watchdog = 0;

    [[nodiscard]] bool is_alive(Nanoseconds now_ns) const noexcept { return SharedLife::is_alive(now_ns, kMagic); }
};

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

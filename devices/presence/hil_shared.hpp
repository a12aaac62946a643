// SPDX-License-Identifier: MIT
// What an emulated Quanser wand and the emulated library of its maker share (devices/emulators/emulated_wand.hpp,
// devices/emulators/hil_library/): six encoders, six analog outputs, and the amplifiers' lines.
#pragma once

#include "devices/presence/shared_memory.hpp"

namespace burin::devices {

struct HilShared : SharedLife {
    static constexpr std::uint64_t kMagic = 0x6275'7269'6e48'4c36;  // "burinHL6": of this layout
    static constexpr const char* kPrefix = "burin-hil-";

    // ---- The emulator's
    SharedNumbers<6> encoder_counts;      // since the emulator began
    std::atomic<std::int32_t> error = 0;  // returned by whatever is called; 0: none
    // ---- The library's
    SharedNumbers<6> volts;
    SharedNumbers<6> zero_counts;              // what the encoders' counters are set back by
    std::atomic<std::uint32_t> enabled = 0;    // bit i: the amplifier of motor i
    std::atomic<std::uint32_t> owner = 0;      // the process that has opened it; 0: none
    std::atomic<std::uint32_t> opener = 0;     // the process that opened it last; 0: none has
    std::atomic<std::uint32_t> setter = 0;     // the process that set its counters last; 0: none has
    std::atomic<Nanoseconds> watchdog_ns = 0;  // when it expires; 0: none is started
    // Whether it then takes the volts off and lets go of the lines, as it was configured; else they stay.
    std::atomic<std::uint32_t> takes_off = 0;

    [[nodiscard]] bool is_alive(Nanoseconds now_ns) const noexcept { return SharedLife::is_alive(now_ns, kMagic); }
    [[nodiscard]] bool has_expired(Nanoseconds now_ns) const noexcept {
        const Nanoseconds at_ns = watchdog_ns.load(std::memory_order_relaxed);
        return at_ns != 0 && now_ns > at_ns;
    }
};

using HilSharedMemory = SharedMemory<HilShared>;

// Returns the names of the emulated wands that run now.
[[nodiscard]] inline std::vector<std::string> emulated_wands() { return emulated_of<HilShared>(); }

}  // namespace burin::devices

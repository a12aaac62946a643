// SPDX-License-Identifier: MIT
// What an emulated Omni and the emulated library of its maker share (devices/emulators/emulated_omni.hpp,
// devices/emulators/hd_library/). Lengths in millimetres, as HDAPI's.
#pragma once

#include <array>

#include "devices/presence/shared_memory.hpp"

namespace burin::devices {

struct HdShared : SharedLife {
    static constexpr std::uint64_t kMagic = 0x6275'7269'6e48'4436;  // "burinHD6": of this layout
    static constexpr const char* kPrefix = "burin-hd-";

    // ---- The emulator's
    SharedNumbers<16> transform;  // column by column
    std::atomic<std::uint32_t> buttons = 0;
    std::atomic<std::uint32_t> calibration = 0;  // as HDAPI says it
    std::atomic<std::uint32_t> styles = 0;       // of calibration, likewise
    std::atomic<std::uint32_t> is_at_reset = 0;  // its links stand where its encoders may be reset
    std::atomic<double> most_N = 0.0;
    std::array<char, 48> model{};          // written before its first beat; ends with a zero
    std::atomic<std::uint32_t> error = 0;  // raised by the library in every frame; 0: none
    // ---- The library's
    std::atomic<Nanoseconds> frame_ns = 0;  // of its newest frame
    SharedNumbers<3> force_N;
    std::atomic<std::uint32_t> owner = 0;  // the process that has opened it; 0: none
    std::atomic<std::uint32_t> calibrations = 0;

    [[nodiscard]] bool is_alive(Nanoseconds now_ns) const noexcept { return SharedLife::is_alive(now_ns, kMagic); }
};
static_assert(std::atomic<double>::is_always_lock_free && std::atomic<Nanoseconds>::is_always_lock_free);

using HdSharedMemory = SharedMemory<HdShared>;

// Returns the names of the emulated Omnis that run now.
[[nodiscard]] inline std::vector<std::string> emulated_omnis() { return emulated_of<HdShared>(); }

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// The memory that an emulated Omni and the emulated library of its maker share: the emulator is a process of its own
// (devices/emulators/emulated_omni.hpp), and the library is loaded into a session's, as the maker's is
// (devices/emulators/hd_library/). Named in POSIX shared memory after the user and the emulator: "emulated",
// "emulated-2".
//
// Each value has one writer. A reader takes a group of them between two equal, even counts of its sequence; where it
// does not come to that in a few tries, it keeps what it had. Lengths in millimetres, as HDAPI's. Any thread; wait-free
// but for opening.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.hpp"

namespace burin::devices {

// A group of numbers with one writer.
template <std::size_t Count>
class SharedNumbers {
public:
    void write(const std::array<double, Count>& values) noexcept {
        // release and acquire as of a sequence lock: numbers are atomic themselves, so nothing is torn, and the fences
        // keep them between the two counts.
        const std::uint32_t before = sequence_.load(std::memory_order_relaxed);
        sequence_.store(before + 1, std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_release);
        for (std::size_t i = 0; i < Count; ++i) values_[i].store(values[i], std::memory_order_relaxed);
        sequence_.store(before + 2, std::memory_order_release);
    }
    [[nodiscard]] std::optional<std::array<double, Count>> read() const noexcept {
        constexpr int kTries = 8;
        for (int i = 0; i < kTries; ++i) {
            const std::uint32_t before = sequence_.load(std::memory_order_acquire);
            std::array<double, Count> values;
            for (std::size_t k = 0; k < Count; ++k) values[k] = values_[k].load(std::memory_order_relaxed);
            std::atomic_thread_fence(std::memory_order_acquire);
            if (before % 2 == 0 && sequence_.load(std::memory_order_relaxed) == before) return values;
        }
        return std::nullopt;
    }

private:
    std::atomic<std::uint32_t> sequence_ = 0;
    std::array<std::atomic<double>, Count> values_{};
};

struct HdShared {
    static constexpr std::uint64_t kMagic = 0x6275'7269'6e48'4431;  // "burinHD1": of this layout
    static constexpr Nanoseconds kSilent_ns = 50'000'000;           // an end that is silent for so long is gone

    std::atomic<std::uint64_t> magic = 0;
    // ---- The emulator's
    std::atomic<Nanoseconds> beat_ns = 0;  // of its newest step, CLOCK_MONOTONIC
    SharedNumbers<16> transform;           // column by column
    std::atomic<std::uint32_t> buttons = 0;
    std::atomic<std::uint32_t> calibration = 0;  // as HDAPI says it
    std::atomic<std::uint32_t> error = 0;        // raised by the library in every frame; 0: none
    // ---- The library's
    std::atomic<Nanoseconds> frame_ns = 0;  // of its newest frame
    SharedNumbers<3> force_N;
    std::atomic<std::uint32_t> owner = 0;  // the process that has opened it; 0: none
    std::atomic<std::uint32_t> calibrations = 0;

    [[nodiscard]] bool is_alive(Nanoseconds now_ns) const {
        return magic.load(std::memory_order_acquire) == kMagic &&
               now_ns - beat_ns.load(std::memory_order_relaxed) < kSilent_ns;
    }
};
static_assert(std::atomic<double>::is_always_lock_free && std::atomic<Nanoseconds>::is_always_lock_free);

// Memory of that name, mapped while the object lives.
class HdSharedMemory {
public:
    // Makes it, as an emulator does: nothing where another lives by that name, or the system refuses. It is gone when
    // the object ends.
    [[nodiscard]] static std::optional<HdSharedMemory> create(const std::string& name);
    // Maps what an emulator has made.
    [[nodiscard]] static std::optional<HdSharedMemory> open(const std::string& name);
    ~HdSharedMemory();
    HdSharedMemory(HdSharedMemory&& other) noexcept;
    HdSharedMemory& operator=(HdSharedMemory&&) = delete;

    [[nodiscard]] HdShared& operator*() const { return *shared_; }
    [[nodiscard]] HdShared* operator->() const { return shared_; }

private:
    HdSharedMemory(HdShared* shared, std::string owned) : shared_(shared), owned_(std::move(owned)) {}
    HdShared* shared_;
    std::string owned_;  // what is unlinked at the end; empty: another's
};

// Returns the names of the emulated Omnis that run now.
[[nodiscard]] std::vector<std::string> emulated_omnis();

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// Memory that an emulated device and the emulated library of its maker share: the emulator is a process of its own, and
// the library is loaded into a session's. Named in POSIX shared memory after the layout, the user and the emulator:
// "emulated", "emulated-2".
//
// Each value has one writer. A reader takes a group of them between two equal, even counts of its sequence; where it
// does not come to that in a few tries, it keeps what it had. Any thread; wait-free but for opening.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"

namespace burin::devices {

// A group of numbers with one writer.
template <std::size_t Count>
class SharedNumbers {
public:
    // There are two places, so that a writer which the system stops in the middle of one leaves the other to be read.
    void write(const std::array<double, Count>& values) noexcept {
        const std::uint32_t next = 1 - (newest_.load(std::memory_order_relaxed) & 1u);
        Place& to = places_[next];
        // release and acquire as of a sequence lock: numbers are atomic themselves, so nothing is torn, and the fences
        // keep them between the two counts.
        const std::uint32_t before = to.sequence.load(std::memory_order_relaxed);
        to.sequence.store(before + 1, std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_release);
        for (std::size_t i = 0; i < Count; ++i) to.values[i].store(values[i], std::memory_order_relaxed);
        to.sequence.store(before + 2, std::memory_order_release);
        newest_.store(next, std::memory_order_release);
    }
    [[nodiscard]] std::optional<std::array<double, Count>> read() const noexcept {
        constexpr int kTries = 8;
        for (int i = 0; i < kTries; ++i) {
            const Place& from = places_[newest_.load(std::memory_order_acquire) & 1u];
            const std::uint32_t before = from.sequence.load(std::memory_order_acquire);
            std::array<double, Count> values;
            for (std::size_t k = 0; k < Count; ++k) values[k] = from.values[k].load(std::memory_order_relaxed);
            std::atomic_thread_fence(std::memory_order_acquire);
            if (before % 2 == 0 && from.sequence.load(std::memory_order_relaxed) == before) return values;
        }
        return std::nullopt;
    }

private:
    struct Place {
        std::atomic<std::uint32_t> sequence = 0;
        std::array<std::atomic<double>, Count> values{};
    };
    std::array<Place, 2> places_{};
    std::atomic<std::uint32_t> newest_ = 0;
};

// A force that no library has renewed for so long is none.
inline constexpr Nanoseconds kSharedForce_ns = 50'000'000;
// An emulator says with each step that it lives. One that is silent for so long has died: longer than a busy machine
// keeps one from its steps. A cable that is pulled is seen at once.
inline constexpr Nanoseconds kSharedDead_ns = 1'000'000'000;

// An emulator's sign of life, at the beginning of its layout.
struct SharedLife {
    std::atomic<std::uint64_t> magic = 0;               // the layout's word, from the first step on
    std::atomic<Nanoseconds> beat_ns = 0;               // of the newest step, CLOCK_MONOTONIC; 0: its cable is pulled
    std::atomic<Nanoseconds> dead_ns = kSharedDead_ns;  // how long it is silent before it counts as dead

    void beat(Nanoseconds now_ns, std::uint64_t word) noexcept {
        beat_ns.store(now_ns, std::memory_order_relaxed);
        // release: who sees the layout's word sees what was written before.
        magic.store(word, std::memory_order_release);
    }
    void pull_cable() noexcept { beat_ns.store(0, std::memory_order_relaxed); }
    [[nodiscard]] bool is_alive(Nanoseconds now_ns, std::uint64_t word) const noexcept {
        const bool is_made = magic.load(std::memory_order_acquire) == word;
        const Nanoseconds at_ns = beat_ns.load(std::memory_order_relaxed);
        return is_made && at_ns != 0 && now_ns - at_ns < dead_ns.load(std::memory_order_relaxed);
    }
};

// Bytes of that name, mapped; the layout's own memory is made of it. `prefix` names the layout.
struct SharedBytes {
    void* at = nullptr;
    std::string owned;  // what is unlinked at the end; empty: another's
};
[[nodiscard]] SharedBytes create_shared(const char* prefix, const std::string& name, std::size_t size);
[[nodiscard]] void* open_shared(const char* prefix, const std::string& name, std::size_t size);
void close_shared(const SharedBytes& bytes, std::size_t size);
[[nodiscard]] std::vector<std::string> shared_names(const char* prefix);

// Makes this process the owner of an emulated device, of which there is one at a time: false where another that lives,
// or this one, has it already. One that has died is no owner. Of several that ask at once one gets it. Any thread.
[[nodiscard]] bool take_ownership(std::atomic<std::uint32_t>& owner) noexcept;

// Memory of one Layout, mapped while the object lives. A Layout has kPrefix, and is_alive(now_ns) for its emulator.
template <typename Layout>
class SharedMemory {
public:
    // Makes it, as an emulator does: nothing where another lives by that name, or the system refuses. It is gone when
    // the object ends. What one that was killed just now has left looks alive until it has been silent for
    // kSharedDead_ns: that is waited for.
    [[nodiscard]] static std::optional<SharedMemory> create(const std::string& name) {
        MonotonicClock clock;
        const auto other = open(name);
        const Nanoseconds until_ns = clock.now_ns() + 2 * kSharedDead_ns;
        while (other && (*other)->is_alive(clock.now_ns())) {
            if (clock.now_ns() >= until_ns) return std::nullopt;
            clock.sleep_until(clock.now_ns() + kSharedDead_ns / 50);
        }
        SharedBytes bytes = create_shared(Layout::kPrefix, name, sizeof(Layout));
        if (bytes.at == nullptr) return std::nullopt;
        new (bytes.at) Layout();
        return SharedMemory(std::move(bytes));
    }
    // Maps what an emulator has made.
    [[nodiscard]] static std::optional<SharedMemory> open(const std::string& name) {
        void* const at = open_shared(Layout::kPrefix, name, sizeof(Layout));
        if (at == nullptr) return std::nullopt;
        return SharedMemory(SharedBytes{at, {}});
    }
    ~SharedMemory() { close_shared(bytes_, sizeof(Layout)); }
    SharedMemory(SharedMemory&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
    SharedMemory& operator=(SharedMemory&&) = delete;

    [[nodiscard]] Layout& operator*() const { return *static_cast<Layout*>(bytes_.at); }
    [[nodiscard]] Layout* operator->() const { return static_cast<Layout*>(bytes_.at); }

private:
    explicit SharedMemory(SharedBytes bytes) : bytes_(std::move(bytes)) {}
    SharedBytes bytes_;
};

// Returns the names of the emulators of a layout that run now, in order.
template <typename Layout>
[[nodiscard]] std::vector<std::string> emulated_of() {
    std::vector<std::string> names;
    MonotonicClock clock;
    for (const std::string& name : shared_names(Layout::kPrefix))
        if (const auto shared = SharedMemory<Layout>::open(name); shared && (*shared)->is_alive(clock.now_ns()))
            names.push_back(name);
    return names;
}

}  // namespace burin::devices

// SPDX-License-Identifier: MIT
// A histogram of durations without locks: a 1 kHz loop can fill it while any thread reads it.
//
// Buckets: exact up to 15 ns, from there eight to each doubling, so a value is known to within an eighth. 2^40 ns (18
// minutes) and more share the last bucket; below zero counts as zero.
// One writer; any number of readers, at any time. A reader sees each count as it was at some moment, but not all at the
// same moment: good for a display while the loop runs, exact when it has stopped. add() is wait-free, a few
// nanoseconds.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/clock.hpp"

namespace burin::haptics {

class Histogram {
public:
    static constexpr std::size_t kPerDoubling = 8;
    static constexpr std::size_t kBuckets = 16 + 36 * kPerDoubling;

    void add(Nanoseconds value_ns) noexcept {
        std::atomic<std::uint64_t>& count = counts_[bucket_of(value_ns)];
        // relaxed, and no read-modify-write: there is one writer, and no other data are ordered by a count.
        count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        if (value_ns > largest_ns_.load(std::memory_order_relaxed))
            largest_ns_.store(value_ns, std::memory_order_relaxed);
    }

    [[nodiscard]] std::uint64_t count(std::size_t bucket) const noexcept {
        return counts_[bucket].load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::uint64_t total() const noexcept {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < kBuckets; ++i) sum += count(i);
        return sum;
    }
    [[nodiscard]] Nanoseconds largest_ns() const noexcept { return largest_ns_.load(std::memory_order_relaxed); }

    // The q-quantile by nearest rank, as the upper end of its bucket but never more than the largest value; 0 when
    // empty.
    [[nodiscard]] Nanoseconds quantile_ns(double q) const noexcept {
        const std::uint64_t all = total();
        const auto rank = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(all)));
        std::uint64_t seen = 0;
        for (std::size_t i = 0; i < kBuckets; ++i) {
            seen += count(i);
            if (seen > 0 && seen >= rank)
                return i + 1 < kBuckets && last_of(i) < largest_ns() ? last_of(i) : largest_ns();
        }
        return 0;
    }

    [[nodiscard]] static constexpr std::size_t bucket_of(Nanoseconds value_ns) noexcept {
        if (value_ns <= 0) return 0;
        const auto value = static_cast<std::uint64_t>(value_ns);
        if (value < 16) return static_cast<std::size_t>(value);
        const auto octave = static_cast<std::size_t>(std::bit_width(value)) - 5;  // 0 for 16 to 31
        const auto within = static_cast<std::size_t>(value >> (octave + 1)) & (kPerDoubling - 1);
        const std::size_t bucket = 16 + octave * kPerDoubling + within;
        return bucket < kBuckets ? bucket : kBuckets - 1;
    }
    // The largest value of a bucket; not defined for the last one, which is open.
    [[nodiscard]] static constexpr Nanoseconds last_of(std::size_t bucket) noexcept {
        if (bucket < 16) return static_cast<Nanoseconds>(bucket);
        const std::size_t octave = (bucket - 16) / kPerDoubling, within = (bucket - 16) % kPerDoubling;
        return static_cast<Nanoseconds>(((kPerDoubling + within + 1) << (octave + 1)) - 1);
    }

private:
    std::array<std::atomic<std::uint64_t>, kBuckets> counts_{};
    std::atomic<Nanoseconds> largest_ns_{0};
};

}  // namespace burin::haptics

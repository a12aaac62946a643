// SPDX-License-Identifier: MIT
// How often a test repeats: fewer times under a sanitizer, where each step costs ten times as much.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

namespace burin::compute::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

[[nodiscard]] constexpr int repeated(int times) { return kSanitized ? std::max(1, times / 16) : times; }

// A seeded source of numbers, the same on every machine (the standard's distributions are not).
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    // lo..hi inclusive.
    [[nodiscard]] std::int64_t whole(std::int64_t lo, std::int64_t hi) {
        return lo + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(hi - lo + 1));
    }
    [[nodiscard]] int small(int lo, int hi) { return static_cast<int>(whole(lo, hi)); }
    // 0 <= x < 1.
    [[nodiscard]] double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    [[nodiscard]] double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
    [[nodiscard]] bool chance(double p) { return unit() < p; }
    // Of either sign and of every magnitude up to 2^bits.
    [[nodiscard]] std::int64_t any_size(int bits) {
        const std::int64_t limit = std::int64_t{1} << whole(0, bits);
        return whole(-limit, limit);
    }
    [[nodiscard]] std::uint64_t bits() { return engine_(); }

private:
    std::mt19937_64 engine_;
};

}  // namespace burin::compute::test

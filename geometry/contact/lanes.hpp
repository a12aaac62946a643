// SPDX-License-Identifier: MIT
// Four points at once, coordinate by coordinate, in float: SIMD for tests of many triangles of which few are of
// interest. Uses the compiler's vector types with + - * / and comparisons only, lane by lane, so that every machine
// gives the same bits.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "base/space.hpp"

namespace burin::geometry {

inline constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;
using LaneMask [[gnu::vector_size(4 * kLanes)]] = std::int32_t;  // all bits of a lane, or none

[[nodiscard]] inline Lanes lesser(Lanes a, Lanes b) noexcept { return b < a ? b : a; }
[[nodiscard]] inline Lanes greater(Lanes a, Lanes b) noexcept { return a < b ? b : a; }
[[nodiscard]] inline bool any(LaneMask mask) noexcept {
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(mask);
    return (halves[0] | halves[1]) != 0;
}

struct Vec3Lanes {
    Lanes x, y, z;

    friend Vec3Lanes operator+(const Vec3Lanes& a, const Vec3Lanes& b) noexcept {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend Vec3Lanes operator-(const Vec3Lanes& a, const Vec3Lanes& b) noexcept {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend Vec3Lanes operator*(Lanes f, const Vec3Lanes& a) noexcept { return {f * a.x, f * a.y, f * a.z}; }
};
[[nodiscard]] inline Vec3Lanes in_all_lanes(const Vec3f& p) noexcept {
    return {Lanes{} + p.x, Lanes{} + p.y, Lanes{} + p.z};
}
[[nodiscard]] inline Lanes dot(const Vec3Lanes& a, const Vec3Lanes& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline Vec3Lanes cross(const Vec3Lanes& a, const Vec3Lanes& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline Vec3Lanes lesser(const Vec3Lanes& a, const Vec3Lanes& b) noexcept {
    return {lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z)};
}
[[nodiscard]] inline Vec3Lanes greater(const Vec3Lanes& a, const Vec3Lanes& b) noexcept {
    return {greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z)};
}

// Loads four points, each as three consecutive floats that are followed by at least one more readable float.
[[nodiscard]] inline Vec3Lanes gathered(const float* const (&from)[kLanes]) noexcept {
    Lanes a, b, c, d;
    std::memcpy(&a, from[0], sizeof a);
    std::memcpy(&b, from[1], sizeof b);
    std::memcpy(&c, from[2], sizeof c);
    std::memcpy(&d, from[3], sizeof d);
    const Lanes ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Lanes ab_z = __builtin_shufflevector(a, b, 2, 6, 2, 6), cd_z = __builtin_shufflevector(c, d, 2, 6, 2, 6);
    return {__builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(ab, cd, 2, 3, 6, 7),
            __builtin_shufflevector(ab_z, cd_z, 0, 1, 4, 5)};
}

}  // namespace burin::geometry

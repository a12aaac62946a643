// SPDX-License-Identifier: MIT
// Sixteen quantised boxes in 96 bytes, and a test which of them meet another box: the step of which the search in a
// touched mesh consists (geometry/contact/touch_patch.hpp).
//
// Each side of a box is a whole number of steps, 0 to 255, of the box around all sixteen. The query box is quantised by
// the same arithmetic. Each operation (subtract, multiply by a positive number, clamp, truncate) preserves the order of
// two numbers, so boxes that meet still meet after quantisation; boxes up to two steps apart may seem to meet.
// Lengths are float metres relative to the mesh's origin. No heap, no throw.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "base/space.hpp"

namespace burin::geometry {

struct SteppedBox {
    std::array<std::uint8_t, 3> lo{}, hi{};
};

// The box around the sixteen boxes, and its quantisation steps.
struct TouchFrame {
    Vec3f lo{0.0f}, hi{0.0f};
    Vec3f steps_per_m{1.0f};  // finite, above 0

    static TouchFrame around(const Vec3f& lo, const Vec3f& hi) noexcept {
        TouchFrame frame{lo, hi, Vec3f(1.0f)};
        for (int k = 0; k < 3; ++k)
            // A flatter box has one step only.
            if (const float extent = hi[k] - lo[k]; extent > 1e-30f) frame.steps_per_m[k] = 255.99f / extent;
        return frame;
    }
    [[nodiscard]] std::uint8_t step(int axis, float at_m) const noexcept {
        const float steps = (at_m - lo[axis]) * steps_per_m[axis];
        return static_cast<std::uint8_t>(static_cast<int>(std::min(std::max(steps, 0.0f), 255.0f)));
    }
    [[nodiscard]] SteppedBox stepped(const Vec3f& from, const Vec3f& to) const noexcept {
        return {{step(0, from.x), step(1, from.y), step(2, from.z)}, {step(0, to.x), step(1, to.y), step(2, to.z)}};
    }
};

struct alignas(32) TouchBoxes {
    static constexpr std::uint32_t kMost = 16;

    std::array<std::array<std::uint8_t, kMost>, 3> lo{}, hi{};

    void set(std::uint32_t i, const SteppedBox& box) noexcept {
        for (std::size_t k = 0; k < 3; ++k) lo[k][i] = box.lo[k], hi[k][i] = box.hi[k];
    }
    // Sides of box i in steps; the upper side reaches to the end of its last step.
    [[nodiscard]] Vec3f lo_of(std::uint32_t i) const noexcept { return {lo[0][i], lo[1][i], lo[2][i]}; }
    [[nodiscard]] Vec3f hi_of(std::uint32_t i) const noexcept { return {hi[0][i], hi[1][i], hi[2][i]}; }
    // Returns a bit mask: bit i tells whether box i, one of the first `count`, meets this one.
    [[nodiscard]] std::uint32_t meeting(const SteppedBox& box, std::uint32_t count) const noexcept {
        const Row meets = (row(lo[0]) <= box.hi[0]) & (row(hi[0]) >= box.lo[0]) & (row(lo[1]) <= box.hi[1]) &
                          (row(hi[1]) >= box.lo[1]) & (row(lo[2]) <= box.hi[2]) & (row(hi[2]) >= box.lo[2]);
        return bits_of(meets) & ((1u << count) - 1u);
    }

private:
    // One vector of sixteen bytes. GCC unrolls a plain loop before it tries to vectorise it, which takes six times as
    // long.
    using Row [[gnu::vector_size(kMost)]] = std::uint8_t;

    [[nodiscard]] static Row row(const std::array<std::uint8_t, kMost>& side) noexcept {
        return std::bit_cast<Row>(side);
    }
    // Packs sixteen bytes, each all ones or zero, into bits. The product moves byte i of eight to bit 56 + i, and
    // nothing else there.
    [[nodiscard]] static std::uint32_t bits_of(const Row& bytes) noexcept {
        static_assert(std::endian::native == std::endian::little, "byte i must be the i-th lowest");
        constexpr std::uint64_t kLowest = 0x0101010101010101u, kGather = 0x0102040810204080u;
        const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(bytes);
        return static_cast<std::uint32_t>(((halves[0] & kLowest) * kGather) >> 56 |
                                          (((halves[1] & kLowest) * kGather) >> 56) << 8);
    }
};

}  // namespace burin::geometry

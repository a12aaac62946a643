// SPDX-License-Identifier: MIT
// shared::encode_normal without its 64-bit divisions and without branches, for one direction of many.
#pragma once

#include <cstdint>

namespace burin {

// |a| * 32767 / length1 rounded to nearest, halves up. In doubles this is exact: a quotient of whole numbers below 2^43 is on
// a half or at least 1 / (2 length1) > 2^-30 away from it, and the division errs by less than 2^-37.
[[gnu::always_inline]] inline std::int32_t nearest_share(std::int32_t size, double length1) {
    return static_cast<std::int32_t>((static_cast<double>(size) * 65534.0 + length1) / (2.0 * length1));
}

// The code of the direction (x, y, z), not zero, components within +-2^26: the same as encode_normal's.
[[gnu::always_inline]] inline std::uint32_t direction_code(std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::int32_t size_x = x < 0 ? -x : x, size_y = y < 0 ? -y : y, size_z = z < 0 ? -z : z;
    const double length1 = static_cast<double>(size_x) + static_cast<double>(size_y) + static_cast<double>(size_z);
    const std::int32_t a = nearest_share(size_x, length1), b = nearest_share(size_y, length1);
    // The lower half is folded outwards.
    const std::int32_t folded_a = z < 0 ? 32767 - b : a, folded_b = z < 0 ? 32767 - a : b;
    // A part that was rounded to zero has lost its sign.
    const std::int32_t signed_a = x < 0 && a != 0 ? -folded_a : folded_a,
                       signed_b = y < 0 && b != 0 ? -folded_b : folded_b;
    return static_cast<std::uint32_t>(signed_b + 32767) << 16 | static_cast<std::uint32_t>(signed_a + 32767);
}

}  // namespace burin

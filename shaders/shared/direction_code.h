// SPDX-License-Identifier: MIT
// The codes of octahedral.h for short integer vectors, which the mesher encodes by the thousand: bit-identical to
// encode_normal, but without 64-bit divisions (software drivers do those one at a time) and without branches.
#ifndef BURIN_SHARED_DIRECTION_CODE_H
#define BURIN_SHARED_DIRECTION_CODE_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

// Returns size * 32767 / length1 rounded to nearest, halves up; size >= 0. In doubles this is exact: a quotient of
// whole numbers below 2^43 is on a half or at least 1 / (2 length1) > 2^-30 away from it, and the division errs by less
// than 2^-37.
BURIN_HOT_FN int nearest_share(int size, double length1) {
    return int((double(size) * 65534.0 + length1) / (2.0 * length1));
}

// Returns the code of the direction (x, y, z), which must not be zero; components within +-2^26.
BURIN_HOT_FN uint direction_code(int x, int y, int z) {
    int size_x = x < 0 ? -x : x;
    int size_y = y < 0 ? -y : y;
    int size_z = z < 0 ? -z : z;
    double length1 = double(size_x) + double(size_y) + double(size_z);
    int a = nearest_share(size_x, length1);
    int b = nearest_share(size_y, length1);
    // The lower half is folded outwards.
    int folded_a = z < 0 ? 32767 - b : a;
    int folded_b = z < 0 ? 32767 - a : b;
    // A component that was rounded to zero has no sign.
    int signed_a = x < 0 && a != 0 ? -folded_a : folded_a;
    int signed_b = y < 0 && b != 0 ? -folded_b : folded_b;
    return uint(signed_b + 32767) << 16 | uint(signed_a + 32767);
}

BURIN_SHARED_END
#endif

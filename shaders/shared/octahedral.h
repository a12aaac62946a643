// SPDX-License-Identifier: MIT
// Unit normals encoded in 32 bits: the octahedron |x| + |y| + |z| = 1 unfolded onto a square, 16 bits an axis (Meyer et
// al. 2010, "On floating-point normal vectors"). Worst angular error 6e-5 rad; axis directions are exact.
//
// Encoding is done on integer vectors of any length, with integer arithmetic alone, so that every machine stores the
// same bits for the same geometry.
#ifndef BURIN_SHARED_OCTAHEDRAL_H
#define BURIN_SHARED_OCTAHEDRAL_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

struct Direction {
    float x;
    float y;
    float z;
};

#ifndef BURIN_NO_INT64  // for shaders that only decode, so that they run on devices without 64-bit integers
struct IntVector {
    int64_t x;
    int64_t y;
    int64_t z;
};

BURIN_FN int64_t absolute(int64_t a) { return a < int64_t(0) ? -a : a; }

// Returns a / b rounded to nearest, halves away from zero, so that mirrored vectors get mirrored codes; b > 0.
BURIN_FN int64_t divide_to_nearest(int64_t a, int64_t b) {
    return a < int64_t(0) ? -((-a + b / int64_t(2)) / b) : (a + b / int64_t(2)) / b;
}

// Returns the code of the direction of v. Components within +-2^47; the zero vector gives +z.
BURIN_FN uint encode_normal(IntVector v) {
    int64_t length1 = absolute(v.x) + absolute(v.y) + absolute(v.z);
    if (length1 == int64_t(0)) return (uint(32767) << 16) | uint(32767);
    int64_t a = divide_to_nearest(v.x * int64_t(32767), length1);
    int64_t b = divide_to_nearest(v.y * int64_t(32767), length1);
    if (v.z < int64_t(0)) {  // fold the lower half outwards; a component that was rounded to zero has no sign
        int64_t folded_a = (int64_t(32767) - absolute(b)) * (a < int64_t(0) ? int64_t(-1) : int64_t(1));
        b = (int64_t(32767) - absolute(a)) * (b < int64_t(0) ? int64_t(-1) : int64_t(1));
        a = folded_a;
    }
    return (uint(b + int64_t(32767)) << 16) | uint(a + int64_t(32767));
}

// Returns the code of a direction along a lattice axis.
BURIN_FN uint axis_normal(int axis, bool positive) {
    int64_t length = positive ? int64_t(1) : int64_t(-1);
    IntVector n;
    n.x = axis == 0 ? length : int64_t(0);
    n.y = axis == 1 ? length : int64_t(0);
    n.z = axis == 2 ? length : int64_t(0);
    return encode_normal(n);
}
#endif

// Returns the code of the opposite direction, in integer arithmetic.
//
// With M = 32767, let (a, b) be the code's point of the square and c = M - |a| - |b|.
//   c > 0, the upper half: the direction is (a, b, c). Its opposite (-a, -b, -c) lies in the lower half, whose points
//     are folded outwards: ((M - |b|) sign(-a), (M - |a|) sign(-b)), with sign(0) = 1 as in encode_normal.
//   c < 0, the lower half: the direction is ((M - |b|) sign(a), (M - |a|) sign(b), c); its opposite lies in the upper
//     half, where a code is the direction itself.
//   c = 0, the equator: (-a, -b).
// Opposite of opposite is the same code for every code that encode_normal gives: |a| and |b| are restored exactly by
// the second subtraction from M, and each sign is turned twice. A zero a has no sign to lose. In the lower half |b| = M
// makes the direction's first component zero and thereby loses a's sign; encode_normal gives such a direction a >= 0,
// which is what comes back. (Likewise for b.)
// It equals encode_normal(-v) for the code of v, except for vectors with v.z = 0 whose a and b were both rounded up:
// (1, 1, 0) has the code of a direction 3e-5 rad below the equator, and the opposite lies as much above it.
BURIN_FN uint opposite_normal(uint code) {
    int a = int(code & uint(0xffff)) - 32767;
    int b = int(code >> 16) - 32767;
    int size_a = a < 0 ? -a : a;
    int size_b = b < 0 ? -b : b;
    int c = 32767 - size_a - size_b;
    int opposite_a = -a;
    int opposite_b = -b;
    if (c > 0) {
        opposite_a = a > 0 ? size_b - 32767 : 32767 - size_b;
        opposite_b = b > 0 ? size_a - 32767 : 32767 - size_a;
    }
    if (c < 0) {
        opposite_a = a < 0 ? 32767 - size_b : size_b - 32767;
        opposite_b = b < 0 ? 32767 - size_a : size_a - 32767;
    }
    return (uint(opposite_b + 32767) << 16) | uint(opposite_a + 32767);
}

// Returns the unit normal of a code.
BURIN_FN Direction decode_normal(uint code) {
    float a = exact_quotient(float(int(code & uint(0xffff)) - 32767), 32767.0f);
    float b = exact_quotient(float(int(code >> 16) - 32767), 32767.0f);
    float c = 1.0f - (a < 0.0f ? -a : a) - (b < 0.0f ? -b : b);
    if (c < 0.0f) {
        float unfolded_a = (1.0f - (b < 0.0f ? -b : b)) * (a < 0.0f ? -1.0f : 1.0f);
        b = (1.0f - (a < 0.0f ? -a : a)) * (b < 0.0f ? -1.0f : 1.0f);
        a = unfolded_a;
    }
    float inverse_length = exact_quotient(1.0f, exact_root(a * a + b * b + c * c));
    Direction d;
    d.x = a * inverse_length;
    d.y = b * inverse_length;
    d.z = c * inverse_length;
    return d;
}

BURIN_SHARED_END
#endif

// SPDX-License-Identifier: MIT
// Encoding of a direction given in doubles as a normal code (octahedral.h).
#ifndef BURIN_SHARED_NORMAL_CODE_H
#define BURIN_SHARED_NORMAL_CODE_H
#include "shaders/shared/doubles.h"
#include "shaders/shared/octahedral.h"

BURIN_SHARED_BEGIN

// Returns x rounded to the nearest whole number, halves away from zero; |x| below 2^52.
BURIN_HOT_FN int64_t nearest_whole(double x) {
    int64_t whole = int64_t(x);
    double left = x - double(whole);
    return whole + (left >= 0.5 ? int64_t(1) : (left <= -0.5 ? int64_t(-1) : int64_t(0)));
}

// Returns the code of a normal of any length; the zero vector gives +z. The result is the same on every machine: the
// vector is scaled until its longest component is 2^40, and rounded to whole numbers.
BURIN_FN uint normal_code(Double3 normal) {
    const double scale = 1099511627776.0;  // 2^40
    double longest = max(max(abs(normal[0]), abs(normal[1])), abs(normal[2]));
    IntVector whole;
    whole.x = int64_t(0);
    whole.y = int64_t(0);
    whole.z = int64_t(0);
    if (longest > 0.0) {
        whole.x = nearest_whole(normal[0] / longest * scale);
        whole.y = nearest_whole(normal[1] / longest * scale);
        whole.z = nearest_whole(normal[2] / longest * scale);
    }
    return encode_normal(whole);
}

BURIN_SHARED_END
#endif

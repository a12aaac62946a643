// SPDX-License-Identifier: MIT
// The interface between the host and shaders/round_doubles.comp, which computes what a device might round otherwise
// than the processor.
#ifndef BURIN_SHARED_ROUNDING_CASE_H
#define BURIN_SHARED_ROUNDING_CASE_H
#include "shaders/shared/doubles.h"

BURIN_SHARED_BEGIN

struct RoundingCase {
    double a;
    double b;
    double radicand;
};

struct RoundedDoubles {
    double quotient;  // a / b
    double root;      // of the radicand
    double product;   // a b
    double sum;       // a + b
};

BURIN_FN RoundedDoubles rounded_doubles(RoundingCase numbers) {
    RoundedDoubles rounded;
    rounded.quotient = numbers.a / numbers.b;
    rounded.root = sqrt(numbers.radicand);
    rounded.product = numbers.a * numbers.b;
    rounded.sum = numbers.a + numbers.b;
    return rounded;
}

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::RoundingCase) == 24 && sizeof(burin::shared::RoundedDoubles) == 32);
#endif
#endif

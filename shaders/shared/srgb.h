// SPDX-License-Identifier: MIT
// Converts between sRGB values and linear light (IEC 61966-2-1), for components 0 to 1. C++ evaluates it in double
// precision, a shader in single; they agree to within the device's pow.
#ifndef BURIN_SHARED_SRGB_H
#define BURIN_SHARED_SRGB_H
#include "shaders/shared/real.h"

BURIN_SHARED_BEGIN

// Both branches are evaluated and one selected: software drivers run both sides of a branch anyway.
BURIN_FN real srgb_of_component(real light) {
    real dark = real(12.92) * light;
    real bright = real(1.055) * pow(light, real(1.0 / 2.4)) - real(0.055);
    return light <= real(0.0031308) ? dark : bright;
}
BURIN_FN real linear_of_component(real value) {
    real dark = value / real(12.92);
    real bright = pow((value + real(0.055)) / real(1.055), real(2.4));
    return value <= real(0.04045) ? dark : bright;
}
BURIN_FN real3 srgb_of(real3 light) {
    return real3(srgb_of_component(light.x), srgb_of_component(light.y), srgb_of_component(light.z));
}
BURIN_FN real3 linear_of(real3 value) {
    return real3(linear_of_component(value.x), linear_of_component(value.y), linear_of_component(value.z));
}

BURIN_SHARED_END
#endif

// SPDX-License-Identifier: MIT
// Between sRGB values and linear light: IEC 61966-2-1. Of components 0 to 1.
#ifndef BURIN_SRGB_GLSL
#define BURIN_SRGB_GLSL

vec3 srgb_of(vec3 c) {
    return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec3 linear_of(vec3 srgb) {
    return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), greaterThan(srgb, vec3(0.04045)));
}

#endif

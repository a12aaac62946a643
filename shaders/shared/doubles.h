// SPDX-License-Identifier: MIT
// Vectors of doubles for kernels that C++ and GLSL evaluate alike, with the operators + - * of both languages, [i] to
// read a component, and the constructors Double3(all) and Double3(x, y, z).
//
// Shaders that include this are compiled as EXACT (cmake/BurinShaders.cmake), which keeps every operation apart, so
// that nothing here needs BURIN_PRECISE. Sums and products of doubles then are those of IEEE 754; for quotients and
// roots Vulkan promises less, and compute/vulkan/rounding_check.hpp asks the device. A constant stands here as GLSL and
// C++ both read it: 0.5, 2.0 and other numbers that a float holds are the same double in both languages, since GLSL
// widens them. Any other number is written twice, with `lf` in GLSL.
#ifndef BURIN_SHARED_DOUBLES_H
#define BURIN_SHARED_DOUBLES_H
#include "shaders/shared/portable.h"

#ifdef __cplusplus

#include <glm/glm.hpp>

namespace burin::shared {
using Double3 = glm::dvec3;
}  // namespace burin::shared

#else

#define Double3 dvec3

#endif

BURIN_SHARED_BEGIN

BURIN_HOT_FN double dot3(Double3 a, Double3 b) {
    Double3 product = a * b;
    return product[0] + product[1] + product[2];
}
BURIN_HOT_FN Double3 cross3(Double3 a, Double3 b) {
    return Double3(a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]);
}
BURIN_HOT_FN double length3(Double3 a) { return sqrt(dot3(a, a)); }
// Tells whether a number is below zero, or is the zero with a minus sign.
#ifdef __cplusplus
BURIN_HOT_FN bool has_minus(double a) { return std::signbit(a); }
#else
bool has_minus(double a) { return (unpackDouble2x32(a).y & 0x80000000u) != 0u; }
#endif
BURIN_HOT_FN bool is_zero(Double3 a) { return a[0] == 0.0 && a[1] == 0.0 && a[2] == 0.0; }

// Returns the direction of a lattice axis.
BURIN_HOT_FN Double3 axis_vector(int axis) {
    return Double3(axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0);
}

// A rotation as a quaternion of length 1.
struct Rotation {
    double w;
    Double3 xyz;
};
BURIN_HOT_FN Rotation opposite_rotation(Rotation q) {
    Rotation back;
    back.w = q.w;
    back.xyz = -q.xyz;
    return back;
}
BURIN_HOT_FN Double3 rotated(Rotation q, Double3 v) {
    Double3 across = cross3(q.xyz, v);
    Double3 twice_across = cross3(q.xyz, across);
    return v + (across * q.w + twice_across) * 2.0;
}

BURIN_SHARED_END
#endif

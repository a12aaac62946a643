// SPDX-License-Identifier: MIT
// Small vectors of floats for kernels that C++ and GLSL evaluate alike, with the operators + - * of both languages,
// exact_quotient(a, b) (portable.h), [i] to read a component, and the constructors Float3(all) and Float3(x, y, z).
//   Float3  a position or a direction; in C++ it lies in the lanes of one processor register
//   Float4  four numbers that the same arithmetic is done on, one by one; in C++ the compiler's own vector type
// A vector operation gives the same bits as the scalar operations component by component.
#ifndef BURIN_SHARED_VECTORS_H
#define BURIN_SHARED_VECTORS_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

#ifdef __cplusplus

using Float4 = float __attribute__((vector_size(16)));
// Returns the components of v with these numbers.
#define BURIN_SHUFFLED(v, a, b, c, d) __builtin_shufflevector(v, v, a, b, c, d)

struct Float3 {
    Float4 lanes;  // the fourth is never read

    Float3() = default;
    constexpr explicit Float3(Float4 all_lanes) : lanes(all_lanes) {}
    constexpr explicit Float3(float all) : lanes{all, all, all, all} {}
    constexpr Float3(float x, float y, float z) : lanes{x, y, z, 0.0f} {}
    float operator[](int i) const { return lanes[i]; }
};
BURIN_HOT_FN Float3 operator+(Float3 a, Float3 b) { return Float3(a.lanes + b.lanes); }
BURIN_HOT_FN Float3 operator-(Float3 a, Float3 b) { return Float3(a.lanes - b.lanes); }
BURIN_HOT_FN Float3 operator*(Float3 a, Float3 b) { return Float3(a.lanes * b.lanes); }
BURIN_HOT_FN Float3 operator*(Float3 a, float b) { return Float3(a.lanes * b); }
BURIN_HOT_FN Float3 operator*(float a, Float3 b) { return Float3(a * b.lanes); }
BURIN_HOT_FN Float3& operator+=(Float3& a, Float3 b) { return a = a + b; }
BURIN_HOT_FN Float3 exact_quotient(Float3 a, float b) { return Float3(a.lanes / b); }
BURIN_HOT_FN Float4 exact_quotient(Float4 a, Float4 b) { return a / b; }

BURIN_HOT_FN Float4 if_positive(Float4 test, Float4 then, float otherwise) {
    return test > 0.0f ? then : Float4{otherwise, otherwise, otherwise, otherwise};
}
BURIN_HOT_FN Float4 size_of_each(Float4 v) { return v < 0.0f ? -v : v; }
BURIN_HOT_FN Float3 clamped(Float3 v, float lo, float hi) {
    return {clamp(v[0], lo, hi), clamp(v[1], lo, hi), clamp(v[2], lo, hi)};
}

#else

#define Float3 vec3
#define Float4 vec4
#define BURIN_SHUFFLED(v, a, b, c, d) vec4((v)[a], (v)[b], (v)[c], (v)[d])

vec4 if_positive(vec4 test, vec4 then, float otherwise) {
    return mix(vec4(otherwise), then, greaterThan(test, vec4(0.0)));
}
vec4 size_of_each(vec4 v) { return abs(v); }
vec3 clamped(vec3 v, float lo, float hi) { return clamp(v, vec3(lo), vec3(hi)); }
#ifdef BURIN_EXACT
vec3 exact_quotient(vec3 a, float b) { return vec3(dvec3(a) / double(b)); }
vec4 exact_quotient(vec4 a, vec4 b) { return vec4(dvec4(a) / dvec4(b)); }
#else
vec3 exact_quotient(vec3 a, float b) { return a / b; }
vec4 exact_quotient(vec4 a, vec4 b) { return a / b; }
#endif

#endif

BURIN_HOT_FN float dot3(Float3 a, Float3 b) {
    BURIN_PRECISE Float3 product = a * b;
    BURIN_PRECISE float sum = product[0] + product[1] + product[2];
    return sum;
}
BURIN_HOT_FN float length3(Float3 a) { return exact_root(dot3(a, a)); }
BURIN_FN Float3 cross3(Float3 a, Float3 b) {
    BURIN_PRECISE Float3 c = Float3(a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]);
    return c;
}

BURIN_SHARED_END
#endif

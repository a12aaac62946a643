// SPDX-License-Identifier: MIT
// Macros that let one text be both GLSL 4.60 and C++23. Everything in shaders/shared/ is written in the common part of
// the two: plain structs and functions, 32- and 64-bit integers, no overloads on anything but vectors, no
// out-parameters. In C++ the names live in burin::shared.
//   BURIN_FN           a function
//   BURIN_HOT_FN       one that C++ always inlines, since it stands in an inner loop of the CPU mesher
//   BURIN_CONSTEXPR_FN one from which C++ makes tables at compile time
//   BURIN_PRECISE      before a variable: each operation that leads to it rounds once, none are fused. GLSL needs the
//                      qualifier; the C++ build never fuses (-ffp-contract=off). Keep such variables in small
//                      functions: glslang 12 follows what they depend on, and does not terminate where that is a part
//                      of a struct which a loop assigns to as a whole.
//   exact_quotient(a, b), exact_root(a)   of floats, in place of a / b and sqrt(a)
// Vulkan lets a division of floats err by 2.5 units in the last place, and a root by more. So shaders that are compiled
// as EXACT (cmake/BurinShaders.cmake, which defines BURIN_EXACT) compute both in doubles and round the result to a
// float. A quotient of two floats lies at least 2^-49 of itself away from any number half-way between two floats, and a
// root 2^-51 of itself; doubles that IEEE 754 rounds are within 2^-53, so that the float is the one that IEEE 754 asks
// for. Vulkan promises neither that nor that sums and products are rounded to nearest, but cards do both. Drawing
// shaders, which must run on cards without doubles, take the plain operations.
// Compare before widening: llvmpipe of Mesa 22.3 (Debian 12) gets int64_t(n) < int64_t(0) wrong for an int n below
// zero.
#ifndef BURIN_SHARED_PORTABLE_H
#define BURIN_SHARED_PORTABLE_H

#ifdef __cplusplus

#include <algorithm>
#include <cmath>
#include <cstdint>

#define BURIN_SHARED_BEGIN namespace burin::shared {
#define BURIN_SHARED_END }
#define BURIN_FN inline
#define BURIN_HOT_FN [[gnu::always_inline]] inline
#define BURIN_CONSTEXPR_FN constexpr
#define BURIN_PRECISE

namespace burin::shared {
using uint = std::uint32_t;
using std::int64_t;
using std::uint64_t;
using std::abs;
using std::ceil;
using std::clamp;
using std::floor;
using std::max;
using std::min;
using std::pow;
using std::sqrt;
BURIN_HOT_FN float exact_quotient(float a, float b) { return a / b; }
BURIN_HOT_FN float exact_root(float a) { return sqrt(a); }
}  // namespace burin::shared

#else

#define BURIN_SHARED_BEGIN
#define BURIN_SHARED_END
#define BURIN_FN
#define BURIN_HOT_FN
#define BURIN_CONSTEXPR_FN
#define BURIN_PRECISE precise

#ifdef BURIN_EXACT
float exact_quotient(float a, float b) { return float(double(a) / double(b)); }
float exact_root(float a) { return float(sqrt(double(a))); }
#else
float exact_quotient(float a, float b) { return a / b; }
float exact_root(float a) { return sqrt(a); }
#endif

#endif
#endif

// SPDX-License-Identifier: MIT
// Macros that let one text be both GLSL 4.60 and C++23. Everything in shaders/shared/ is written in the common part of
// the two: plain structs and functions, 32- and 64-bit integers, no overloads on anything but vectors, no
// out-parameters. In C++ the names live in burin::shared.
//   BURIN_FN           a function
//   BURIN_HOT_FN       one that C++ always inlines, since it stands in an inner loop of the CPU mesher
//   BURIN_CONSTEXPR_FN one from which C++ makes tables at compile time
//   BURIN_PRECISE      before a variable: each operation that leads to it rounds once, none are fused. GLSL needs the
//                      qualifier; the C++ build never fuses (-ffp-contract=off). A value marked so is bit-identical on
//                      every device that rounds division and square roots as IEEE 754 does. Keep such variables in
//                      small functions: glslang 12 follows what they depend on, and does not terminate where that is a
//                      part of a struct which a loop assigns to as a whole.
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
}  // namespace burin::shared

#else

#define BURIN_SHARED_BEGIN
#define BURIN_SHARED_END
#define BURIN_FN
#define BURIN_HOT_FN
#define BURIN_CONSTEXPR_FN
#define BURIN_PRECISE precise

#endif
#endif

// SPDX-License-Identifier: MIT
// Lets one text be both GLSL 4.60 and C++23. Everything in shaders/shared/ is written in the common part of the two:
// plain structs and functions, 32- and 64-bit integers, no overloads on anything but vectors, no out-parameters.
// In C++ the names live in burin::shared.
// Compare before widening: llvmpipe of Mesa 22.3 (Debian 12) gets int64_t(n) < int64_t(0) wrong for an int n below zero.
#ifndef BURIN_SHARED_PORTABLE_H
#define BURIN_SHARED_PORTABLE_H

#ifdef __cplusplus

#include <cmath>
#include <cstdint>

#define BURIN_SHARED_BEGIN namespace burin::shared {
#define BURIN_SHARED_END }
#define BURIN_FN inline

namespace burin::shared {
using uint = std::uint32_t;
using std::int64_t;
using std::uint64_t;
using std::ceil;
using std::floor;
using std::sqrt;
}  // namespace burin::shared

#else

#define BURIN_SHARED_BEGIN
#define BURIN_SHARED_END
#define BURIN_FN

#endif
#endif

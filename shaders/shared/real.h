// SPDX-License-Identifier: MIT
// The number types for arithmetic on pictures: `real` is a double in C++, whose results are the reference, and a float
// in shaders; `whole` has 64 bits in C++ and 32 in shaders, whose pictures are no larger than a display.
#ifndef BURIN_SHARED_REAL_H
#define BURIN_SHARED_REAL_H
#include "shaders/shared/portable.h"

#ifdef __cplusplus

#include <glm/glm.hpp>

namespace burin::shared {
using real = double;
using whole = std::int64_t;
using real2 = glm::dvec2;
using real3 = glm::dvec3;
}  // namespace burin::shared
#define BURIN_TABLE inline constexpr

#else

#define real float
#define whole int
#define real2 vec2
#define real3 vec3
#define BURIN_TABLE const

#endif
#endif

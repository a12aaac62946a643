// SPDX-License-Identifier: MIT
// Four floats that one instruction works on. The compiler's own vector type: it is there on every processor, gives the same
// bits as four floats one by one, and says what the compiler may not find out by itself (cmake/BurinOptions.cmake tells why it
// is not asked to look for such chances).
#pragma once

#include "base/space.hpp"

namespace burin {

using Float4 = float __attribute__((vector_size(16)));

template <int a, int b, int c, int d>
[[nodiscard]] inline Float4 shuffled(Float4 v) {
    return __builtin_shufflevector(v, v, a, b, c, d);
}
template <int lane>
[[nodiscard]] inline Float4 broadcast(Float4 v) {
    return shuffled<lane, lane, lane, lane>(v);
}
// Of the first three, summed in the order x, y, z.
[[nodiscard]] inline float dot3(Float4 a, Float4 b) {
    const Float4 product = a * b;
    return product[0] + product[1] + product[2];
}
[[nodiscard]] inline Vec3f xyz(Float4 v) { return {v[0], v[1], v[2]}; }

}  // namespace burin

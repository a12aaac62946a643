// SPDX-License-Identifier: MIT
// The places of a quad's four corners, one coordinate of all of them after the other, for arithmetic on four numbers.
#pragma once

#include <cstdint>

#include "shaders/shared/surface_vertex.h"
#include "shaders/shared/vectors.h"

namespace burin::compute {

struct QuadCorners {
    [[gnu::always_inline]] QuadCorners(const shared::SurfaceVertex* vertices, std::uint32_t i0, std::uint32_t i1,
                                       std::uint32_t i2, std::uint32_t i3) {
        // The fourth lane holds the vertex's normal, which nobody reads.
        shared::Float4 p0, p1, p2, p3;
        __builtin_memcpy(&p0, vertices + i0, sizeof p0);
        __builtin_memcpy(&p1, vertices + i1, sizeof p1);
        __builtin_memcpy(&p2, vertices + i2, sizeof p2);
        __builtin_memcpy(&p3, vertices + i3, sizeof p3);
        const shared::Float4 xy01 = __builtin_shufflevector(p0, p1, 0, 4, 1, 5),
                             xy23 = __builtin_shufflevector(p2, p3, 0, 4, 1, 5),
                             z01 = __builtin_shufflevector(p0, p1, 2, 6, 2, 6),
                             z23 = __builtin_shufflevector(p2, p3, 2, 6, 2, 6);
        x = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
        y = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
        z = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
    }
    shared::Float4 x, y, z;
};

}  // namespace burin::compute

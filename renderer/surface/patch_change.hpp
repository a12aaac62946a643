// SPDX-License-Identifier: MIT
// Where a patch looks different from what it was: a cut changes a few of its triangles, and only where these are is the picture
// drawn anew.
// Pure; any thread. Cost: some 20 us for a patch of 500 triangles.
#pragma once

#include <cstdint>
#include <span>

#include "base/space.hpp"
#include "geometry/vertex_light.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

// A patch as it is drawn at its finest level. light: one for each vertex, or empty: full.
struct PatchLook {
    std::span<const shared::SurfaceVertex> vertices;
    std::span<const std::uint32_t> indices;  // three a triangle
    std::span<const VertexLight> light;
};

// Around the triangles that only one of the two has; a triangle is the same if its three vertices and their light are, to the bit and
// in the same order. Empty: the two look the same. In the patches' frame.
[[nodiscard]] Box changed_bounds(const PatchLook& before, const PatchLook& after);

}  // namespace burin

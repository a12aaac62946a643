// SPDX-License-Identifier: MIT
// Finds where a patch looks different from its previous state: a cut changes a few of its triangles, and only these
// regions of the picture are redrawn.
// Pure; any thread. Cost: some 20 us for a patch of 500 triangles.
#pragma once

#include <cstdint>
#include <span>

#include "base/space.hpp"
#include "geometry/contact/surface_tile.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::renderer {

// A patch as drawn at its finest level. light: one for each vertex, or empty for full light.
struct PatchLook {
    std::span<const shared::SurfaceVertex> vertices;
    std::span<const std::uint32_t> indices;  // three a triangle
    std::span<const geometry::VertexLight> light;
};

// Returns the bounds, in the patches' frame, of the triangles that only one of the two has; empty if the two look the
// same. Triangles are equal if their three vertices and these vertices' light are, to the bit and in the same order.
[[nodiscard]] Box changed_bounds(const PatchLook& before, const PatchLook& after);

}  // namespace burin::renderer

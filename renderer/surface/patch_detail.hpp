// SPDX-License-Identifier: MIT
// Coarser forms of a patch, for when its triangles are smaller than a picture can show or the surface is smoother than they are small.
//
// A coarser form uses some of the patch's own vertices. Those on its border stay, all of them, so that any form of a patch meets any form of
// its neighbours without a crack. Edges are collapsed by meshoptimizer (quadric errors); then every vertex that went is compared
// with the coarser surface beneath it: how far it lies off, and how its colour, normal and light differ from what is
// interpolated there. A form that would change the look of a single vertex by more than kMostChange is not kept, so a shadow's edge on
// a flat face keeps its triangles. A patch of several colours keeps those along their border.
// Pure; any thread. Cost: one or two milliseconds for a patch of 500 triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vertex_light.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

// Between the vertices of a smooth triangle interpolated light looks like light worked out at every pixel, also where they are far
// apart: along none of its edges does the normal turn, or colour or light change, by more than a little.
struct SmoothFirst {
    std::vector<std::uint32_t> indices;  // three a triangle: the smooth ones, then the others, each in the order given
    std::size_t smooth = 0;              // indices of smooth ones
};
// light: one for each vertex, or empty: full.
[[nodiscard]] SmoothFirst smooth_first(std::span<const shared::SurfaceVertex> vertices,
                                       std::span<const std::uint32_t> indices, std::span<const VertexLight> light);

struct PatchLevel {
    std::vector<std::uint32_t> indices;  // three a triangle, of the patch's own vertices, as smooth_first
    std::size_t smooth =
        0;  // all of them, where all of the patch's own triangles are smooth: none of its vertices looks different
    double error_m = 0.0;  // no vertex of the patch is farther from it
};

// From fine to coarse; none where nothing is gained. light: as above.
[[nodiscard]] std::vector<PatchLevel> coarser_levels(std::span<const shared::SurfaceVertex> vertices,
                                                     std::span<const std::uint32_t> indices,
                                                     std::span<const VertexLight> light, double edge_m);

}  // namespace burin

// SPDX-License-Identifier: MIT
// Coarser levels of a patch, for when its triangles are smaller
// than a picture can show or the surface is smooth at their size.
//
// A coarser level uses a subset of the patch's own vertices. All those on its border stay, so that any level of a patch
// meets any level of its neighbours without a crack. Edges are collapsed by meshoptimizer (quadric errors); then every
// removed vertex is compared with the coarser surface beneath it: its distance, and how its colour, normal and light
// differ from the interpolated ones. A level that would change the appearance of a single vertex by more than
// kMostChange is rejected, so a shadow's edge on a flat face keeps its triangles. In a patch of several colours the
// vertices along colour borders stay.
// Pure; any thread. Cost: one or two milliseconds for a patch of 500 triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/contact/surface_tile.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::renderer {

// A patch's triangles with the smooth ones first. On a smooth triangle interpolated light looks like light computed at
// every pixel, even where its vertices are far apart: normal, colour and light change little along each of its edges.
struct SmoothFirst {
    // Three a triangle: the smooth ones, then the others, each in their original order.
    std::vector<std::uint32_t> indices;
    std::size_t smooth = 0;  // number of indices of smooth triangles
};
// light: one for each vertex, or empty for full light.
[[nodiscard]] SmoothFirst smooth_first(std::span<const shared::SurfaceVertex> vertices,
                                       std::span<const std::uint32_t> indices,
                                       std::span<const geometry::VertexLight> light);

// Returns the triangles by colour: first those between different colours, then those of each colour by itself.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> by_colour(std::span<const shared::SurfaceVertex> vertices,
                                                                std::span<const std::uint32_t> indices);
// Returns fewer triangles on the same vertices, with the border as it is; the surface moves about so far.
[[nodiscard]] std::vector<std::uint32_t> simplified(std::span<const std::uint32_t> indices,
                                                    std::span<const shared::SurfaceVertex> vertices, double error_m);

struct PatchLevel {
    // Three a triangle, of the patch's own vertices, ordered as smooth_first does.
    std::vector<std::uint32_t> indices;
    // Number of indices of smooth triangles: all of them if all of the patch's own triangles are smooth, as then none
    // of its vertices looks different.
    std::size_t smooth = 0;
    double error_m = 0.0;  // bound on the distance of the patch's vertices from this level
};

// Returns levels from fine to coarse; none where nothing is
// gained. light: one for each vertex, or empty for full light.
[[nodiscard]] std::vector<PatchLevel> coarser_levels(std::span<const shared::SurfaceVertex> vertices,
                                                     std::span<const std::uint32_t> indices,
                                                     std::span<const geometry::VertexLight> light, double edge_m);

}  // namespace burin::renderer

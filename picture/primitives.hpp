// SPDX-License-Identifier: MIT
// Meshes of the shapes that the renderer draws besides the workpiece, all in one vertex and one index list, in white.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/space.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::picture {

struct PrimitiveRange {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    Box bounds;

    bool operator==(const PrimitiveRange&) const = default;
};

// Number of rings from pole to pole; twice as many segments go around.
inline constexpr std::array<int, 4> kBallRings{8, 16, 32, 48};

inline constexpr double kRingThickness = 0.09;  // share of the ring's radius

struct Primitives {
    std::vector<shared::SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::array<PrimitiveRange, kBallRings.size()> balls;  // radius 1 around the origin, from coarse to fine
    PrimitiveRange cube;                                  // -0.5 to 0.5
    PrimitiveRange stylus;                                // along +Z from 0 to 1, radius at most 1, thin at z = 0
    PrimitiveRange rod;                                   // along +Z from 0 to 1, radius 1; open at z = 1
    PrimitiveRange cone;                                  // along +Z from 0 to its tip at 1, radius 1
    PrimitiveRange ring;                                  // radius 1 around +Z, as thick as kRingThickness each way
    PrimitiveRange plinth;       // along +Y from -1 to 0, radius 1, its upper edge rounded for a height of 2 to 3 radii
    PrimitiveRange screen_quad;  // -1 to 1 in x and y, z = 0
};

[[nodiscard]] Primitives make_primitives();

}  // namespace burin::picture

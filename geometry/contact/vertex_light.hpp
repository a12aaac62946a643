// SPDX-License-Identifier: MIT
// The share of light that reaches a vertex of the surface past the workpiece itself: computed by
// compute/light/tile_light.hpp, drawn by renderer/. The two bytes are in memory as the vertex shader reads them.
#pragma once

#include <cstdint>

namespace burin::geometry {

// Shares of light from 0 (none) to 255 (all).
struct VertexLight {
    std::uint8_t sun = 255;   // from the lamp
    std::uint8_t open = 255;  // from the surroundings
    bool operator==(const VertexLight&) const = default;
};
static_assert(sizeof(VertexLight) == 2);

}  // namespace burin::geometry

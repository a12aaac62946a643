// SPDX-License-Identifier: MIT
// How much light reaches a vertex of the surface past the workpiece itself: worked out by compute/tile_light.hpp, drawn by
// renderer/. The two bytes lie in memory as the vertex shader reads them.
#pragma once

#include <cstdint>

namespace burin {

// 0 .. 255: none .. all.
struct VertexLight {
    std::uint8_t sun = 255;   // of the lamp
    std::uint8_t open = 255;  // of the surroundings
    bool operator==(const VertexLight&) const = default;
};
static_assert(sizeof(VertexLight) == 2);

}  // namespace burin

// SPDX-License-Identifier: MIT
// A panel as triangles in pixels, and the atlas of its letters: what a user interface toolkit hands to the painter,
// free of any toolkit's types. Colours are sRGB values, not premultiplied, and are blended as such, which is what
// toolkits' colours and letters are designed for.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image.hpp"

namespace burin::renderer {

struct PanelVertex {
    float x = 0.0f, y = 0.0f;  // pixels from the panel's upper left corner, y down
    float u = 0.0f, v = 0.0f;  // in the atlas, 0 to 1
    std::uint32_t rgba = 0;    // red in the lowest byte

    bool operator==(const PanelVertex&) const = default;
};
static_assert(sizeof(PanelVertex) == 20, "handed to the GPU as it is");

// A run of indices, clipped to a rectangle.
struct PanelDraw {
    PixelRect clip;
    std::uint32_t first_index = 0, index_count = 0;

    bool operator==(const PanelDraw&) const = default;
};

struct PanelMesh {
    std::vector<PanelVertex> vertices;
    std::vector<std::uint32_t> indices;  // three a triangle, each below vertices.size()
    std::vector<PanelDraw> draws;        // in painting order

    bool operator==(const PanelMesh&) const = default;
};

// Coverage of each pixel by its letter; a fully covered region of the atlas serves for shapes that are not letters.
struct PanelAtlas {
    ImageSize size;
    std::vector<std::uint8_t> cover;  // one byte a pixel, rows from the top
};

}  // namespace burin::renderer

// SPDX-License-Identifier: MIT
// A panel as triangles in pixels, and the picture of its letters: what a toolkit hands to the painter. No toolkit's type is in here.
// Colours are sRGB values, not premultiplied, and are mixed as such: that is how toolkits' colours and letters are designed.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/image.hpp"

namespace burin {

struct PanelVertex {
    float x = 0.0f, y = 0.0f;  // pixels from the panel's upper left corner, y down
    float u = 0.0f, v = 0.0f;  // of the atlas, 0 to 1
    std::uint32_t rgba = 0;    // red in the lowest byte

    bool operator==(const PanelVertex&) const = default;
};
static_assert(sizeof(PanelVertex) == 20, "handed to the GPU as it is");

// A run of indices, drawn within a rectangle.
struct PanelDraw {
    PixelRect clip;
    std::uint32_t first_index = 0, index_count = 0;

    bool operator==(const PanelDraw&) const = default;
};

struct PanelMesh {
    std::vector<PanelVertex> vertices;
    std::vector<std::uint32_t> indices;  // three a triangle, each below vertices.size()
    std::vector<PanelDraw> draws;        // in the order of painting

    bool operator==(const PanelMesh&) const = default;
};

// How much of a pixel each letter covers; a place that is all covered serves what is not a letter.
struct PanelAtlas {
    ImageSize size;
    std::vector<std::uint8_t> cover;  // one byte a pixel, rows from the top
};

}  // namespace burin

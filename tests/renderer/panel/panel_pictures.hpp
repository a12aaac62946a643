// SPDX-License-Identifier: MIT
// Panels for tests: boxes of a colour, all covered or covered by a third, as the edges of letters are.
#pragma once

#include <cstdint>
#include <utility>

#include "renderer/panel/panel_painter.hpp"

namespace burin::renderer {

inline constexpr std::uint32_t rgba(std::uint32_t r, std::uint32_t g, std::uint32_t b, std::uint32_t a) {
    return r | g << 8 | b << 16 | a << 24;
}

// Two letters: the left half of the atlas is all covered, of the right half a third is.
inline PanelAtlas plain_atlas() {
    PanelAtlas atlas{{8, 8}, std::vector<std::uint8_t>(64, 255)};
    for (std::size_t i = 0; i < 64; ++i) {
        if (i % 8 >= 4) atlas.cover[i] = 85;
    }
    return atlas;
}
inline constexpr float kCovered = 0.25f, kThird = 0.75f;

inline void add_box(PanelMesh& mesh, PixelRect place, std::uint32_t colour, float u = kCovered,
                    PixelRect clip = {0, 0, 64, 48}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto x0 = static_cast<float>(place.x), y0 = static_cast<float>(place.y);
    const float x1 = x0 + static_cast<float>(place.width), y1 = y0 + static_cast<float>(place.height);
    for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}) {
        mesh.vertices.push_back({x, y, u, 0.5f, colour});
    }
    mesh.draws.push_back({clip, static_cast<std::uint32_t>(mesh.indices.size()), 6});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

}  // namespace burin::renderer

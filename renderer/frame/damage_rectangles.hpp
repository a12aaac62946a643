// SPDX-License-Identifier: MIT
// Merges many damaged rectangles of a picture into a few that cover them with little
// excess. Each rectangle is a draw of its own with a fixed cost, but one rectangle around
// a tool, its shadow and a panel, which lie far apart, would be most of the picture.
// Pure; any thread. Cost: some microseconds for a hundred rectangles.
#pragma once

#include <span>
#include <vector>

#include "base/image.hpp"

namespace burin::renderer {

// Returns rectangles that cover all of `rects`: the whole picture where they would cover most of it, none where all
// given are empty. They lie within the picture if the given ones do, and may overlap.
[[nodiscard]] std::vector<PixelRect> damage_rectangles(std::span<const PixelRect> rects, ImageSize size);

}  // namespace burin::renderer

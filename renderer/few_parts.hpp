// SPDX-License-Identifier: MIT
// Few rectangles of a picture that hold many, and little else: what has changed is drawn rectangle by rectangle, and each of them has a
// price of its own. A tool, its shadow and a window of numbers are far apart; one rectangle around them would be most of the picture.
// Pure; any thread. Cost: some microseconds for a hundred rectangles.
#pragma once

#include <span>
#include <vector>

#include "renderer/image.hpp"

namespace burin {

// All of the picture where it would be most of it; none where all given are empty. They lie within the picture, as those given do, and may
// overlap.
[[nodiscard]] std::vector<PixelRect> few_parts(std::span<const PixelRect> rects, ImageSize size);

}  // namespace burin

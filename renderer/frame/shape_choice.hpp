// SPDX-License-Identifier: MIT
// Chooses which of a scene's shapes are drawn in a part of the picture, and how finely its balls are tessellated.
// Pure; any thread.
#pragma once

#include "base/image.hpp"
#include "renderer/scene/frame_setup.hpp"
#include "renderer/scene/primitives.hpp"
#include "renderer/surface/patch_choice.hpp"

namespace burin::renderer {

struct ShownShapes {
    Shapes shapes;
    std::uint32_t left_out = 0;  // shapes outside the part
};
// Returns the shapes whose bounds are not outside the part for both eyes. Balls are tessellated for their size in the
// picture, which does not depend on the part.
[[nodiscard]] ShownShapes shapes_in(const PixelRect& part, const Scene& scene, const Primitives& primitives,
                                    ImageSize size, const Savings& savings);

// Returns the coarsest ball whose error is at most a quarter of a pixel.
[[nodiscard]] const PrimitiveRange& ball_for(const Primitives& primitives, double radius_px);

}  // namespace burin::renderer

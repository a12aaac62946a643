// SPDX-License-Identifier: MIT
// Which of a scene's shapes a part of the picture shows, and how round its balls are.
// Pure; any thread.
#pragma once

#include "renderer/frame_setup.hpp"
#include "renderer/image.hpp"
#include "renderer/primitives.hpp"
#include "renderer/surface/patch_choice.hpp"

namespace burin {

struct ShownShapes {
    Shapes shapes;
    std::uint32_t left_out = 0;  // beside the part
};
// Shapes whose bounds lie beside the part for both eyes are left out; balls are as round as their size in the picture asks for,
// which does not depend on the part.
[[nodiscard]] ShownShapes shapes_in(const PixelRect& part, const Scene& scene, const Primitives& primitives,
                                    ImageSize size, const Savings& savings);

// The coarsest ball that lies off by no more than a quarter of a pixel.
[[nodiscard]] const PrimitiveRange& ball_for(const Primitives& primitives, double radius_px);

}  // namespace burin

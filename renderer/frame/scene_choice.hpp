// SPDX-License-Identifier: MIT
// Chooses what of the scene is drawn in a part of the picture: which shapes, how finely its balls are tessellated, and
// the shader for each part of the room. (Patches of the workpiece: renderer/surface/patch_choice.hpp.)
// Pure functions; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image.hpp"
#include "picture/frame_setup.hpp"
#include "picture/primitives.hpp"
#include "renderer/surface/patch_choice.hpp"

namespace burin::renderer {

struct ShownShapes {
    picture::Shapes shapes;
    std::uint32_t left_out = 0;  // shapes outside the part
};
// Returns the shapes whose bounds are not outside the part for both eyes. Balls are tessellated for their size in the
// picture, which does not depend on the part.
[[nodiscard]] ShownShapes shapes_in(const PixelRect& part, const picture::Picture& picture,
                                    const picture::Primitives& primitives, ImageSize size, const Savings& savings);

// Returns the coarsest ball whose error is at most a quarter of a pixel.
[[nodiscard]] const picture::PrimitiveRange& ball_for(const picture::Primitives& primitives, double radius_px);

// The shaders of the room. A software driver executes all of a shader at every pixel, so pixels with neither the
// floor's grid nor a shadow get a shader with neither. Which pixels these are depends on the room and the eyes alone,
// not on the redrawn part, so that redrawn parts match a whole picture. The choice is conservative: no shadow and no
// grid line is left out.
enum class RoomLook : std::uint8_t { full, without_shadows, plain };  // plain: without shadows and grid
struct RoomPart {
    PixelRect rect;
    RoomLook look = RoomLook::full;
};
// Returns parts that together cover `part`, each of its pixels once.
[[nodiscard]] std::vector<RoomPart> room_parts(const picture::Picture& picture, const picture::Workpiece& workpiece,
                                               ImageSize size, const PixelRect& part);

// Returns a rectangle around all that either eye may see of the
// workpiece's, the plinth's and the objects' shadows on the floor (shaders/backdrop_stage.glsl).
[[nodiscard]] PixelRect shadows_on_floor(const picture::Picture& picture, const picture::Workpiece& workpiece,
                                         ImageSize size);
// Returns the number of rows, from the picture's top, in which neither eye sees the floor's grid.
[[nodiscard]] std::uint32_t rows_above_grid(const picture::Picture& picture, ImageSize size);

}  // namespace burin::renderer

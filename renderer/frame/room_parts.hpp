// SPDX-License-Identifier: MIT
// How a part of the picture's room is drawn: a software driver works through all of a shader at every pixel, so pixels that have neither
// the floor's grid nor a shadow get one that has neither. Which pixels these are depends on the room and the eyes alone, not on the part, so
// that parts drawn anew have the pixels of a whole picture. Stated conservatively: no shadow and no line of the grid is left out.
// Pure functions; any thread.
#pragma once

#include <vector>

#include "renderer/frame_setup.hpp"
#include "renderer/image.hpp"

namespace burin {

enum class RoomLook : std::uint8_t { full, without_shadows, plain };  // plain: without shadows and grid
struct RoomPart {
    PixelRect rect;
    RoomLook look = RoomLook::full;
};
// They cover the part, each of its pixels once.
[[nodiscard]] std::vector<RoomPart> room_parts(const Scene& scene, const Workpiece& workpiece, ImageSize size,
                                               const PixelRect& part);

// Where the shadows of the workpiece and the plinth on the floor may be seen by either eye (backdrop.frag).
[[nodiscard]] PixelRect shadows_on_floor(const Scene& scene, const Workpiece& workpiece, ImageSize size);
// Rows of the picture, from its top, in which neither eye sees the floor's grid.
[[nodiscard]] std::uint32_t rows_above_grid(const Scene& scene, ImageSize size);

}  // namespace burin

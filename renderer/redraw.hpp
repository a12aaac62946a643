// SPDX-License-Identifier: MIT
// What of the picture has to be drawn anew, given what it shows and what it shall show.
//
// Where the eyes, the screen and the room are as they were, only things that moved, changed, came or went are: the tool with its
// ring, its shadow and the light it keeps off, where these fall on something and end at a stated distance
// (shaders/shared/frame_uniforms.h); the signs of its contact, the workspace's boxes, the standing panel, and patches of the surface.
// Each has a rectangle around it in both eyes' views. Pixels outside of these would come out the same.
// Pure functions; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/frame_setup.hpp"
#include "renderer/image.hpp"

namespace burin {

// What a picture was drawn from, but for the patches.
struct Shown {
    Scene scene;
    Workpiece workpiece;
    DepthRange depth;
    std::uint64_t panel_pictures = 0;  // how many the renderer was given for the standing panel
};

// Where either eye may see boxes of the world or what lies between them; all of the picture where they come too near to an eye.
[[nodiscard]] PixelRect seen_part(const Scene& scene, ImageSize size, std::span<const Box> boxes_world);

// All is the same but what may be drawn anew by itself. Where it is not, the whole picture has to be.
[[nodiscard]] bool same_room(const Shown& shown, const Shown& wanted);
// In the same room. changed: around patches and parts of patches, in their frame; those that look different because the tool moved are
// among them (changed_near_tool in surface/patch_choice.hpp). Some of the rectangles may be empty.
[[nodiscard]] std::vector<PixelRect> changed_rects(const Shown& shown, const Shown& wanted, ImageSize size,
                                                   std::span<const Box> changed);

}  // namespace burin

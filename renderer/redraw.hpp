// SPDX-License-Identifier: MIT
// What of the picture has to be drawn anew, given what it shows and what it shall show.
//
// Where the eyes, the screen and the room are as they were, only things that moved, changed, came or went are: the tool with its
// ring, its shadow and the light it keeps off, where these fall on something and end at a stated distance
// (shaders/shared/frame_uniforms.h); the signs of its contact, the workspace's boxes, the standing panel, and patches of the surface.
// The part is the smallest rectangle around all of them in both eyes' views. Pixels outside of it would come out the same.
// Pure functions; any thread.
#pragma once

#include <optional>
#include <span>

#include "renderer/frame_setup.hpp"
#include "renderer/image.hpp"

namespace burin {

// What a picture was drawn from, but for the patches.
struct Shown {
    Scene scene;
    Workpiece workpiece;
    DepthRange depth;
    Box patches;                       // around all of them, in their frame
    std::uint64_t panel_pictures = 0;  // how many the renderer was given for the standing panel
};

// Where either eye may see boxes of the world or what lies between them; all of the picture where they come too near to an eye.
[[nodiscard]] PixelRect seen_part(const Scene& scene, ImageSize size, std::span<const Box> boxes_world);

// shown: nothing when there is no picture yet. changed: around patches and parts of patches, in their frame.
[[nodiscard]] PixelRect changed_part(const std::optional<Shown>& shown, const Shown& wanted, ImageSize size,
                                     std::span<const Box> changed);

}  // namespace burin

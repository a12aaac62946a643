// SPDX-License-Identifier: MIT
// Computes which parts of the picture must be redrawn, given the scene that it shows and the scene that it shall show.
//
// Where eyes, screen and room have not changed, only what moved, changed, appeared or vanished is redrawn: the tool
// with its ring, its shadow and the light it occludes, where these fall on something, up to a stated distance
// (shaders/shared/frame_uniforms.h); the marks of its contact, the workspace's boxes, the standing panel, and patches
// of the surface. Each has a rectangle around it in both eyes' views. Pixels outside of these would come out the same.
// Many such rectangles are merged into a few damage rectangles.
// Pure functions; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/image.hpp"
#include "picture/frame_setup.hpp"

namespace burin::renderer {

// The inputs that a picture was drawn from, except the patches.
struct Shown {
    picture::Picture picture;
    picture::Workpiece workpiece;
    picture::DepthRange depth;
    std::uint64_t panel_pictures = 0;  // how many pictures the renderer was given for the standing panel
};

// Returns a rectangle around all that either eye may see of the given boxes and of what lies between them; the whole
// picture where they come too near to an eye.
[[nodiscard]] PixelRect seen_part(const picture::Picture& picture, ImageSize size, std::span<const Box> boxes_world);

// Returns whether the two differ at most in what can be redrawn in part. If not, the whole picture must be redrawn.
[[nodiscard]] bool same_room(const Shown& shown, const Shown& wanted);
// The part of it that two scenes tell.
[[nodiscard]] bool same_room(const picture::Picture& shown, const picture::Picture& wanted);
// Returns the damaged rectangles, given that same_room() holds; some may be empty. changed: boxes around changed
// patches and parts of patches, in the patches' frame, including patches that look different because the tool moved
// (changed_near_tool in renderer/surface/patch_choice.hpp).
[[nodiscard]] std::vector<PixelRect> changed_rects(const Shown& shown, const Shown& wanted, ImageSize size,
                                                   std::span<const Box> changed);

// Merges damaged rectangles into a few that cover them with little excess: each is a draw of its own with a fixed cost,
// but one rectangle around a tool, its shadow and a panel, which lie far apart, would be most of the picture. Returns
// rectangles that cover all of `rects`: the whole picture where they would cover most of it, none where all given are
// empty. They lie within the picture if the given ones do, and may overlap. Cost: some microseconds for a hundred.
[[nodiscard]] std::vector<PixelRect> damage_rectangles(std::span<const PixelRect> rects, ImageSize size);

}  // namespace burin::renderer

// SPDX-License-Identifier: MIT
// Chooses which patches of the surface a frame draws, at which level of detail, and where they are lit. Each kind of
// saving has a switch, and its effect is counted. Where the fade of parallax bends the picture, patches keep all their
// triangles and are culled only outside the frusta.
// Pure, except that the choice is stored in the screen's DrawnPatches; any thread.
#pragma once

#include <vector>

#include "base/image.hpp"
#include "picture/picture.hpp"
#include "renderer/surface/drawn_patches.hpp"

namespace burin::renderer {

struct Savings {
    bool cull_beside = true;       // what lies outside both eyes' frusta, shapes as well as patches
    bool cull_turned_away = true;  // what faces away from both eyes
    bool cull_behind = true;       // what solid material hides from both eyes
    bool coarser_levels = true;    // fewer triangles where the picture cannot show more, of patches and of balls
    bool vertex_rate = true;       // light computed at vertices where they are close together
    bool parts_only = true;        // redraw only what changed
    bool plain_room = true;        // the room without grid and shadows where there are none
    bool parts_apart = true;       // several damage rectangles where one around all would hold much else
};

struct PatchCounts {
    std::uint32_t drawn = 0, beside = 0, turned_away = 0, behind = 0;
    std::uint32_t groups = 0;       // drawn, in place of their patches
    std::uint32_t coarser = 0;      // drawn with fewer triangles than they have
    std::uint32_t vertex_rate = 0;  // drawn, with some or all triangles lit at vertices
    std::uint64_t triangles = 0;    // drawn, in one view

    PatchCounts& operator+=(const PatchCounts& other) {
        drawn += other.drawn;
        groups += other.groups;
        beside += other.beside;
        turned_away += other.turned_away;
        behind += other.behind;
        coarser += other.coarser;
        vertex_rate += other.vertex_rate;
        triangles += other.triangles;
        return *this;
    }
};

// A run of the index buffer.
struct DrawRange {
    std::uint32_t first_index = 0, index_count = 0;
};
struct PatchDraws {
    std::vector<DrawRange> fine, solid;  // lit at vertices, lit at pixels
    PatchCounts counts;
};

// Chooses the level and shading rate of every patch for a full redraw; marks patches in view as wanted.
void choose_levels(DrawnPatches& drawn, const picture::Picture& picture, ImageSize size, const Savings& savings,
                   std::span<const Box> occluders);
// Chooses the shading rate alone, which depends on the tool too. Returns the bounds of the patches whose rate changed.
[[nodiscard]] std::vector<Box> choose_rates(DrawnPatches& drawn, const picture::Picture& picture, ImageSize size,
                                            const Savings& savings);
// Returns the bounds of the patches in view that may look different because the tool changed: those near its old or new
// position, or in its shadow.
[[nodiscard]] std::vector<Box> changed_near_tool(std::span<PatchStore::Patch* const> patches,
                                                 const picture::Picture& before, const picture::Picture& now,
                                                 ImageSize size, std::span<const Box> occluders);
// Returns what has to be drawn for this part of the picture. moving: groups of patches are drawn as one, with few
// triangles, where they have any (patch_groups.hpp).
[[nodiscard]] PatchDraws choose_draws(const DrawnPatches& drawn, const picture::Picture& picture, ImageSize size,
                                      const PixelRect& part, const Savings& savings, std::span<const Box> occluders,
                                      bool moving = false);

}  // namespace burin::renderer

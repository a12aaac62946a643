// SPDX-License-Identifier: MIT
// Which patches of the surface a frame draws, how finely, and where they are lit. Each kind of saving has a switch, and what it
// saved is counted. Where the fade of parallax bends the picture, patches keep all their triangles and are left out only beside it.
// Pure but for the patches' own notes of how they stand in the picture; any thread.
#pragma once

#include <vector>

#include "renderer/image.hpp"
#include "renderer/scene.hpp"
#include "renderer/surface/patch_store.hpp"

namespace burin {

struct Savings {
    bool cull_beside = true;       // what lies outside both eyes' frusta, shapes as well as patches
    bool cull_turned_away = true;  // what turns its back to both eyes
    bool cull_behind = true;       // what solid material hides from both eyes
    bool coarser_levels = true;    // fewer triangles where a picture cannot show more, of patches and of balls
    bool vertex_rate = true;       // light worked out at vertices where they are close
    bool parts_only = true;        // only what changed is drawn anew
    bool plain_room = true;        // the room without grid and shadows where there are none
    bool parts_apart = true;       // in several rectangles where one around all would hold much else
};

struct PatchCounts {
    std::uint32_t drawn = 0, beside = 0, turned_away = 0, behind = 0;
    std::uint32_t coarser = 0;      // drawn with fewer triangles than they have
    std::uint32_t vertex_rate = 0;  // drawn, some or all of their triangles lit at vertices
    std::uint64_t triangles = 0;    // drawn, in one view

    PatchCounts& operator+=(const PatchCounts& other) {
        drawn += other.drawn;
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

// Level and shading rate of every patch, for a picture that is drawn as a whole; marks those in view as wanted.
void choose_levels(std::span<PatchStore::Patch* const> patches, const Scene& scene, ImageSize size,
                   const Savings& savings, std::span<const Box> occluders);
// The shading rate alone, which depends on the tool too. Bounds of the patches whose rate has changed.
[[nodiscard]] std::vector<Box> choose_rates(std::span<PatchStore::Patch* const> patches, const Scene& scene,
                                            ImageSize size, const Savings& savings);
// Bounds of the patches in view that may look different because the tool is no longer as it was: near either, or in its shadow.
[[nodiscard]] std::vector<Box> changed_near_tool(std::span<PatchStore::Patch* const> patches, const Scene& before,
                                                 const Scene& now, ImageSize size, std::span<const Box> occluders);
// What has to be drawn for this part of the picture.
[[nodiscard]] PatchDraws choose_draws(std::span<PatchStore::Patch* const> patches, const Scene& scene, ImageSize size,
                                      const PixelRect& part, const Savings& savings, std::span<const Box> occluders);

}  // namespace burin

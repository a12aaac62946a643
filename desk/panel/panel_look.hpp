// SPDX-License-Identifier: MIT
// Colours, font and sizes of the panel. On a stereo wall light letters on black leave ghosts in the other eye, and
// black stands out of every scene: so the background is a dark grey that lets the scene through, and letters are light
// grey, with a contrast of at most 9 to 1.
#pragma once

#include <imgui/imgui.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "renderer/panel/panel_mesh.hpp"

namespace burin::session::panel {

// Colours in sRGB, as the toolkit packs them.
inline constexpr ImU32 kGround = IM_COL32(38, 41, 45, 236);
inline constexpr ImU32 kCard = IM_COL32(64, 68, 74, 242);
inline constexpr ImU32 kControl = IM_COL32(80, 85, 91, 255);
inline constexpr ImU32 kControlHovered = IM_COL32(96, 101, 108, 255);
inline constexpr ImU32 kField = IM_COL32(46, 49, 53, 255);
inline constexpr ImU32 kText = IM_COL32(222, 225, 228, 255);
inline constexpr ImU32 kDim = IM_COL32(163, 169, 176, 255);
inline constexpr ImU32 kFaint = IM_COL32(112, 118, 125, 255);
inline constexpr ImU32 kAccent = IM_COL32(226, 163, 96, 255);
inline constexpr ImU32 kAccentHovered = IM_COL32(236, 180, 120, 255);
inline constexpr ImU32 kOnAccent = IM_COL32(40, 36, 32, 255);
inline constexpr ImU32 kGood = IM_COL32(132, 188, 142, 255);
inline constexpr ImU32 kBlue = IM_COL32(146, 178, 214, 255);
inline constexpr ImU32 kWarning = IM_COL32(230, 190, 104, 255);
inline constexpr ImU32 kFault = IM_COL32(230, 124, 112, 255);

[[nodiscard]] constexpr ImU32 with_alpha(ImU32 colour, std::uint32_t alpha) {
    return (colour & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

struct Type {
    ImFont* text = nullptr;
    ImFont* small = nullptr;
    ImFont* strong = nullptr;
    ImFont* title = nullptr;
    std::string notice;
};

// Applies colours and sizes to the current context.
void apply_style(float scale);
// Adds the fonts to the current context in place of those that it has, and rasterises them into its atlas: Latin 1 and
// these letters, those that the font lacks from another that is installed.
[[nodiscard]] Result<Type> load_type(const std::string& file, float scale, std::span<const std::uint32_t> letters);
// Returns the letters of a UTF-8 text that are beyond Latin 1 and that the toolkit can show, which ends at U+FFFF.
[[nodiscard]] std::vector<std::uint32_t> letters_beyond_latin(std::string_view text);
[[nodiscard]] renderer::PanelAtlas atlas_of_context();

}  // namespace burin::session::panel

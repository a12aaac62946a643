// SPDX-License-Identifier: MIT
// Which place of which eye's picture is seen at a place of the output: the other way round than compose() (renderer/output/compose.hpp)
// lays the pictures out. For the mouse. Pure; any thread.
// Units: px are the output's pixels from its upper left corner, not whole ones; uv as in output_settings.hpp.
#pragma once

#include <optional>

#include "renderer/output/output_settings.hpp"

namespace burin {

// Two windows: places in the right eye's window are told this far to the right of those in the left eye's.
inline constexpr double kRightWindow_px = 65536.0;
[[nodiscard]] constexpr bool in_right_window(const Vec2& px) { return px.x >= 0.5 * kRightWindow_px; }

struct SeenPlace {
    std::optional<Eye>
        eye;  // nothing: both eyes look at it, each at its own picture (anaglyphs, pictures by turns or layers)
    Vec2 picture_uv{0.0};
};

// Nothing where the output is black. held_px: where a button was pressed that is still down. What is dragged stays with the picture that
// it began on, also beyond its edge: the place may then lie outside the picture.
[[nodiscard]] std::optional<SeenPlace> seen_at(const OutputSettings& settings, const OutputPlace& place, Vec2 px,
                                               std::optional<Vec2> held_px = std::nullopt);

// How far a pixel of the output leads on an eye's picture, in its pixels: 2 across where two of them become one.
[[nodiscard]] Vec2 picture_px_per_px(StereoMode mode);

}  // namespace burin

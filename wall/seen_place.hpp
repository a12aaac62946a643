// SPDX-License-Identifier: MIT
// Maps a position of the output to the eye's picture that is seen there and the position in it: the inverse of
// compose() (renderer/output/compose.hpp), which lays the pictures out. For the mouse. Pure; any thread.
// Units: px are the output's pixels from its upper left corner, not necessarily whole; uv as in output_settings.hpp.
#pragma once

#include <optional>

#include "wall/output_settings.hpp"

namespace burin::wall {

// Two windows: positions in the right eye's window lie this far to the right of those in the left eye's.
inline constexpr double kRightWindow_px = 65536.0;
[[nodiscard]] constexpr bool in_right_window(const Vec2& px) { return px.x >= 0.5 * kRightWindow_px; }

struct SeenPlace {
    // None: both eyes look at it, each at its own picture (anaglyphs, pictures by turns or layers).
    std::optional<Eye> eye;
    Vec2 picture_uv{0.0};
};

// Returns nothing where the output is black. held_px: where a button was pressed that is still down. What is dragged
// stays with the picture that it began on, also beyond its edge: the position may then lie outside the picture.
[[nodiscard]] std::optional<SeenPlace> seen_at(const OutputSettings& settings, const OutputPlace& place, Vec2 px,
                                               std::optional<Vec2> held_px = std::nullopt);

// Returns how many pixels of an eye's picture a pixel of the output covers: 2 across where two of them become one.
[[nodiscard]] Vec2 picture_px_per_px(StereoMode mode);

}  // namespace burin::wall

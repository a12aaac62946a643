// SPDX-License-Identifier: MIT
// A panel that stands in the scene, and which of its pixels a wand points at. Pure; any thread.
// The panel's own frame: origin in its middle, +X to the right and +Y up as its reader sees it, +Z towards the reader.
#pragma once

#include <array>
#include <optional>

#include "base/space.hpp"
#include "renderer/image.hpp"

namespace burin {

struct PanelStand {
    Pose world_from_panel;
    Vec2 size_m{0.0};  // both above 0

    bool operator==(const PanelStand&) const = default;
};

// As its reader sees them: lower left, lower right, upper left, upper right.
[[nodiscard]] std::array<Vec3, 4> corners_world(const PanelStand& stand);

// Of a height such that its pixels are square.
[[nodiscard]] PanelStand stand_of_width(const Pose& world_from_panel, double width_m, ImageSize pixels);

// Where the ray along the wand's own -Z meets the front of the panel, in pixels from its upper left corner, y down; nothing where it
// misses, comes from behind or runs along it, or where a number is not finite.
[[nodiscard]] std::optional<Vec2> panel_ray(const PanelStand& stand, ImageSize pixels, const Pose& world_from_wand);

}  // namespace burin

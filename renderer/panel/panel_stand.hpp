// SPDX-License-Identifier: MIT
// The pose and size of a panel that stands in the scene, and which of its pixels a wand points at. Pure; any thread.
// The panel's own frame: origin in its middle, +X to the right and +Y up as its reader sees it, +Z towards the reader.
#pragma once

#include <array>
#include <optional>

#include "base/image.hpp"
#include "base/space.hpp"

namespace burin::renderer {

struct PanelStand {
    Pose world_from_panel;
    Vec2 size_m{0.0};  // both components positive

    bool operator==(const PanelStand&) const = default;
};

// Returns the corners as the reader sees them: lower left, lower right, upper left, upper right.
[[nodiscard]] std::array<Vec3, 4> corners_world(const PanelStand& stand);

// Returns a panel of this width whose height makes its pixels square.
[[nodiscard]] PanelStand stand_of_width(const Pose& world_from_panel, double width_m, ImageSize pixels);

// Returns where the ray along the wand's own -Z meets the front of the panel, in pixels from its upper left corner, y
// down; nullopt where it misses, comes from behind or runs parallel to the panel, or where a number is not finite.
[[nodiscard]] std::optional<Vec2> panel_ray(const PanelStand& stand, ImageSize pixels, const Pose& world_from_wand);

}  // namespace burin::renderer

// SPDX-License-Identifier: MIT
// The pose and size of a panel that stands in the scene, and which of its pixels a wand points at. Pure; any thread.
// The panel's own frame: origin in its middle, +X to the right and +Y up as its reader sees it, +Z towards the reader.
#pragma once

#include <array>
#include <optional>

#include "base/image.hpp"
#include "base/space.hpp"

namespace burin::picture {

struct PanelStand {
    Pose world_from_panel;
    Vec2 size_m{0.0};  // both components positive

    bool operator==(const PanelStand&) const = default;
};

// Returns the corners as the reader sees them: lower left, lower right, upper left, upper right.
[[nodiscard]] inline std::array<Vec3, 4> corners_world(const PanelStand& stand) {
    const auto at = [&](double x, double y) {
        return stand.world_from_panel * Vec3(x * stand.size_m.x, y * stand.size_m.y, 0.0);
    };
    return {at(-0.5, -0.5), at(0.5, -0.5), at(-0.5, 0.5), at(0.5, 0.5)};
}

// Returns a panel of this width whose height makes its pixels square.
[[nodiscard]] inline PanelStand stand_of_width(const Pose& world_from_panel, double width_m, ImageSize pixels) {
    const double aspect = pixels.width > 0 ? static_cast<double>(pixels.height) / pixels.width : 1.0;
    return {world_from_panel, {width_m, width_m * aspect}};
}

// Returns where the ray along the wand's own -Z meets the front of the panel, in pixels from its upper left corner, y
// down; nullopt where it misses, comes from behind or runs parallel to the panel, or where a number is not finite.
[[nodiscard]] inline std::optional<Vec2> panel_ray(const PanelStand& stand, ImageSize pixels,
                                                   const Pose& world_from_wand) {
    const Quat panel_from_world = glm::conjugate(stand.world_from_panel.orientation);
    const Vec3 from = panel_from_world * (world_from_wand.position_m - stand.world_from_panel.position_m);
    const Vec3 along = panel_from_world * (world_from_wand.orientation * Vec3(0.0, 0.0, -1.0));
    // Negated comparisons, so that NaN misses too. Below a thousandth
    // of a radian a tremor would make the point leap over the panel.
    if (!(from.z > 0.0) || !(along.z < -1e-3)) return std::nullopt;
    const Vec3 hit = from - along * (from.z / along.z);
    const Vec2 uv(0.5 + hit.x / stand.size_m.x, 0.5 - hit.y / stand.size_m.y);
    if (!(uv.x >= 0.0 && uv.x < 1.0 && uv.y >= 0.0 && uv.y < 1.0)) return std::nullopt;
    return Vec2(uv.x * pixels.width, uv.y * pixels.height);
}

}  // namespace burin::picture

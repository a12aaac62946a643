// SPDX-License-Identifier: MIT
// A ball that is set somewhere: at the hand when contact begins, or out of material after an edit; whether it is
// inside, where it is put, and whether it fits. Frame: relative to the surface's origin, metres. No heap, lock, throw.
#pragma once

#include <cmath>

#include "haptics/contact/touching.hpp"

namespace burin::haptics {

// Depth, as a fraction of the radius, beyond which a ball that was set somewhere does not fit there: between walls that
// are nearer than its diameter it could not even move along them. It is pushed out for so many ticks; then it follows
// the hand.
inline constexpr double kUnfit = 0.01;
inline constexpr std::uint32_t kMostUnfitTicks = 16;

// Distance from `center` to the border of the ball within which the surface is known; negative outside it.
[[nodiscard]] inline double known_around(const Vec3& center, const geometry::PosedSurface& posed) {
    const geometry::LocalSurface& surface = posed.surface();
    const Vec3 off = center - (surface.center_object - surface.origin_object);
    return surface.radius_m - std::sqrt(glm::dot(off, off));
}

// Decides only where the ball around `center` that reaches the nearest triangle lies within the known surface;
// elsewhere a nearer triangle may be unknown.
[[nodiscard]] inline bool inside_material(const Nearest& nearest, const Vec3& center,
                                          const geometry::PosedSurface& surface) {
    return nearest.height < 0.0 && nearest.distance <= known_around(center, surface);
}

[[nodiscard]] inline Vec3 put_outside(const Nearest& nearest, const Vec3& center, double radius) {
    const bool on_surface = nearest.distance < kTie * radius;
    const Vec3 way = on_surface ? nearest.normal : (nearest.point - center) / nearest.distance;
    return nearest.point + radius * way;
}

}  // namespace burin::haptics

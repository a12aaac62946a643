// SPDX-License-Identifier: MIT
// A ball that is set somewhere: at the hand when contact begins, or out of material after an edit; whether it is
// inside, where it is put, whether it fits, and where it is tried next if not. Frame: relative to the surface's origin,
// metres. No heap, lock, throw.
#pragma once

#include <cmath>

#include "haptics/contact/touching.hpp"

namespace burin::haptics {

// Depth, as a fraction of the radius, beyond which a ball that was set somewhere does not fit there: between walls that
// are nearer than its diameter it could not even move along them. It is pushed out for so many ticks; then it follows
// the hand.
inline constexpr double kUnfit = 0.01;
inline constexpr std::uint32_t kMostUnfitTicks = 16;

// Where a ball that fits neither at the hand nor where it was pushed to is tried next: places around the hand, as far
// off as it was pushed and farther, in directions of a golden spiral, near and far ones in turn. They go on for ever,
// each time in other directions. From there it may be pushed on. A hand between walls, in free air, was pushed by
// little; so it is not taken out to their rim unless that is near.
struct StartPlaces {
    static constexpr std::uint32_t kDirections = 24, kRings = 6;
    static constexpr std::uint32_t kMostInATick = 8;
    static constexpr double kTriedTo = 1.5, kTakenTo = 2.5;  // multiples of the radius

    double radius_m = 0.0, put_off_m = 0.0;

    // From the hand; of a place where a ball is tried, and of one where it fits.
    [[nodiscard]] double farthest_tried_m() const { return kTriedTo * radius_m + 2.0 * put_off_m; }
    [[nodiscard]] double farthest_m() const { return kTakenTo * radius_m + 2.0 * put_off_m; }
    // The n-th place, from the hand.
    [[nodiscard]] Vec3 operator[](std::uint32_t n) const {
        constexpr double kGolden_rad = 2.399963229728653;
        const std::uint32_t ring = (n + n / kDirections) % kRings;
        const double up = 1.0 - (2.0 * (n % kDirections) + 1.0) / kDirections, around = kGolden_rad * n;
        const double out = std::sqrt(1.0 - up * up);
        return (farthest_tried_m() * (ring + 1.0) / kRings) * Vec3(out * std::cos(around), up, out * std::sin(around));
    }
};

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

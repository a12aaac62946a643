// SPDX-License-Identifier: MIT
// Force shading: the normals that the surface would have if it were as smooth as the normals at its corners say.
//
// After Ruspini et al. 1997: the god-object's goal is sought under planes turned into the interpolated normals, and the true
// planes only keep the ball outside. Where it comes to rest the HIP lies straight below it along the interpolated normal, and
// that normal is continuous over the surface, across edges and corners of facets, so the force is too.
//
// A ball's centre goes over an offset surface, on which it lies over a corner or an edge most of the time while the nearest
// point of the facets stands still. So the interpolation is done where the centre is: over the triangle whose corners are moved
// along their normals by the radius. For a point that is the facet itself.
// Sharp edges stay sharp: where facets that share the nearest point disagree about its normal, and where normals at the
// corners turn away from the facet by more than 45 degrees, the plane stays as it is. So it does in a hollow too tight for
// the ball, where the moved triangle has turned over.
#pragma once

#include <array>
#include <optional>

#include "haptics/contact/room.hpp"
#include "haptics/contact/touching.hpp"

namespace burin {

struct ShadedPlanes {
    std::array<HalfSpace, 3> planes;  // those that bear the ball, as the smooth surface has them
    std::uint32_t count = 0;
    bool any = false;  // false: all are as they were
};

// A triangle of a smooth piece of surface.
struct SmoothFacet {
    Triangle triangle;
    Vec3 normal;  // of any length
    std::array<Vec3, 3> normals;
};

// Remembers the last few that were asked about: a tick's steps ask about the same ones again, and finding normals takes a way
// through the surface's tree.
class SmoothFacets {
public:
    explicit SmoothFacets(const LocalSurface& surface) noexcept : surface_(surface) {}
    // None if it is not known to be part of a smooth surface.
    [[nodiscard]] std::optional<SmoothFacet> of(const Candidates& candidates, std::uint32_t candidate) noexcept;

private:
    static constexpr std::uint32_t kMost = 8;
    const LocalSurface& surface_;
    std::array<std::uint32_t, kMost> ids_;
    std::array<bool, kMost> is_smooth_;
    Room<SmoothFacet, kMost> facets_;
    std::uint32_t count_ = 0;  // ever asked for; the newest is in place (count_ - 1) % kMost
};

// Of the planes that `goal` bears on. Corner normals looked up: at most about 30 for each of them.
[[nodiscard]] ShadedPlanes shaded(SmoothFacets& facets, const Candidates& candidates, const Touches& touches,
                                  const NearestInside& goal, const Vec3& center, double radius) noexcept;

// The way to where the shaded planes want the ball, `wish` along `normal`, onto the true planes: never through them, and not off
// them either. Relative to the centre.
[[nodiscard]] Vec3 onto_true_planes(const Touches& touches, const Vec3& wish, const Vec3& normal,
                                    double tolerance) noexcept;

// On a hollow the way along the tangent plane overshoots what is nearest, and on a bump it falls short: by as much as the HIP is
// deep over the radius of curvature. How much of it to go, from how much was left of it after the last step (Barzilai and
// Borwein, "Two-point step size gradient methods", IMA Journal of Numerical Analysis 8, 1988).
class StepShare {
public:
    [[nodiscard]] double of(const Vec3& center, const Vec3& wish) noexcept;

private:
    bool known_ = false;
    Vec3 center_{0.0}, wish_{0.0};
};

}  // namespace burin

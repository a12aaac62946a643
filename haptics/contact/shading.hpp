// SPDX-License-Identifier: MIT
// Force shading: contact with the smooth surface that the corner normals of the facets describe.
//
// After Ruspini et al. 1997: the god-object's goal is sought under planes turned into the interpolated normals, and the
// true planes only keep the ball outside. Where it comes to rest the HIP lies straight below it along the interpolated
// normal. That normal is continuous over the surface, across edges and corners of facets, and so is the force.
//
// A ball's centre moves on an offset surface: most of the time it lies above a corner or an edge, and the nearest point
// of the facets does not move. So the normal is interpolated at the centre, over the triangle whose corners are moved
// along their normals by the radius. For a point that is the facet itself.
// Sharp edges stay sharp: a plane is not turned where facets that share the nearest point disagree about its normal,
// nor where normals at the corners turn away from the facet by more than 45 degrees, nor in a hollow too tight for the
// ball, where the moved triangle has turned over.
#pragma once

#include <array>
#include <optional>

#include "haptics/contact/static_vector.hpp"
#include "haptics/contact/touching.hpp"

namespace burin::haptics {

struct ShadedPlanes {
    std::array<HalfSpace, 3> planes;  // the planes that bear the ball, turned to the smooth surface
    std::uint32_t count = 0;
    bool any = false;  // false: no plane was turned
};

// A triangle of a smooth piece of surface.
struct SmoothFacet {
    geometry::Triangle triangle;
    Vec3 normal;  // of any length
    std::array<Vec3, 3> normals;
};

// Caches the last few facets that were asked for: the steps of a tick ask for the same ones again, and finding corner
// normals takes a descent through the surface's tree.
class SmoothFacets {
public:
    explicit SmoothFacets(const geometry::PosedSurface& surface) noexcept : surface_(surface) {}
    // Returns nothing for a triangle that is not known to be part of a smooth surface. From the back the facet and its
    // normals are turned over.
    [[nodiscard]] std::optional<SmoothFacet> of(std::uint32_t id, const geometry::Triangle& triangle,
                                                bool from_back) noexcept;
    [[nodiscard]] const geometry::PosedSurface& surface() const noexcept { return surface_; }

private:
    static constexpr std::uint32_t kMost = 16;
    geometry::PosedSurface surface_;
    std::array<std::uint32_t, kMost> ids_;
    std::array<bool, kMost> is_smooth_, from_back_;
    StaticVector<SmoothFacet, kMost> facets_;
    std::uint32_t count_ = 0;  // facets ever asked for; the newest is in slot (count_ - 1) % kMost
};

// Shades the planes that bear `goal`. Looks up corner normals at most about 30 times for each plane.
[[nodiscard]] ShadedPlanes shaded(SmoothFacets& facets, const Candidates& candidates, const Touches& touches,
                                  const NearestInside& goal, const Vec3& center, double radius) noexcept;

// Moves the ball's goal under the shaded planes, `wish`, along `normal` onto the true planes: neither through them nor
// off them. All relative to the ball's centre.
[[nodiscard]] Vec3 onto_true_planes(const Touches& touches, const Vec3& wish, const Vec3& normal,
                                    double tolerance) noexcept;

// Step length of the ball under shading. In a hollow a step along the tangent plane overshoots the nearest point, and
// on a bump it falls short, by the ratio of the HIP's depth to the radius of curvature. The fraction to go is estimated
// from what was left after the last step (Barzilai and Borwein, "Two-point step size gradient methods", IMA Journal of
// Numerical Analysis 8, 1988).
class StepShare {
public:
    explicit StepShare(double first) noexcept : share_(first) {}
    [[nodiscard]] double of(const Vec3& center, const Vec3& wish) noexcept;
    [[nodiscard]] double last() const noexcept { return share_; }

private:
    bool known_ = false;
    double share_;
    Vec3 center_{0.0}, wish_{0.0};
};

}  // namespace burin::haptics

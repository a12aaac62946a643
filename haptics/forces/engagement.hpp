// SPDX-License-Identifier: MIT
// Engagement depth: how deep a ball lies in the material around it, read from the surface, whether in a groove, at a
// wall or on a face.
//
// The engaged part, seen from the ball's centre, is where a surface that faces the centre is no farther than 1.1 R. Its
// solid angle W is summed over the triangles near. A ball at depth d in a plane sees
//     W = 2 pi (1 - (R - d) / (1.1 R)), whether it has cut its bed already or not, so
//     d = 1.1 D - 0.1 R,  D = R W / (2 pi)
// and this is used for any shape: an edge gives half of what a face gives. The extra tenth allows for facets and for
// the clearance between the ball that cuts and the ball that touches. A ball that is moved sideways meets what lies
// ahead, so the part of the solid angle ahead then counts for both halves, since behind it lies the groove that it has
// cut.
// The direction into the material is the vector area of the surface that faces the ball within 1.6 R. A vector area
// depends on a surface's border alone, so the groove, which lies wholly within, does not tilt it.
// Frame: object, metres. Work: the triangles near, in at most kMostEngagementPieces pieces. Pure; no heap, lock, throw.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "geometry/contact/local_surface.hpp"

namespace burin::haptics {

struct Engagement {
    double depth_m = 0.0;   // d, 0 to 2 R
    Vec3 into_object{0.0};  // unit, the direction into the material; zero: no surface near
};

struct EngagementLook {
    Engagement engagement;
    std::uint32_t triangles_seen = 0;  // checked by their box or ball; a quad counts as one
};

// Triangles larger than a third of the radius are divided into pieces; beyond this many pieces in total the rest is
// left out.
inline constexpr std::uint32_t kMostEngagementPieces = 20000;

// Computes the engagement of a ball. ahead_object: direction in which the ball is driven sideways, its length (at most
// 1) the sideways share of the drive.
[[nodiscard]] EngagementLook engagement(const geometry::LocalSurface& surface, const Vec3& center_object_m,
                                        double radius_m, const Vec3& ahead_object = Vec3(0.0)) noexcept;

}  // namespace burin::haptics

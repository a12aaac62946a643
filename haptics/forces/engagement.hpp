// SPDX-License-Identifier: MIT
// How deep a ball lies in the material around it, read from the surface: in a groove, at a wall, on a face.
//
// Seen from the ball's centre, the engaged part is where a surface that faces the centre is no farther than 1.1 R. Its solid
// angle W is summed over the triangles near. A ball that lies d deep in a plane sees
//     W = 2 pi (1 - (R - d) / (1.1 R)), whether it has cut its bed already or not, so
//     d = 1.1 D - 0.1 R,  D = R W / (2 pi)
// and that is taken for any shape: an edge has half of what a face has. The tenth is room for facets and for the clearance
// between the ball that cuts and the ball that touches. A ball that is drawn sideways meets what lies ahead: the part of the
// view ahead then counts for both halves, since behind it lies the groove that it has cut.
// The direction into the material is the vector area of the surface that faces the ball within 1.6 R. A vector area depends on
// a surface's border alone, so that the groove, which is all within, does not tilt it.
// Frame: object, metres. Work: the triangles near, at most kMostEngagementPieces pieces of them. Pure; no heap, lock, throw.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "geometry/local_surface.hpp"

namespace burin {

struct Engagement {
    double depth_m = 0.0;   // d, 0 to 2 R
    Vec3 into_object{0.0};  // unit, the direction into the material; zero: nothing near
};

struct EngagementLook {
    Engagement engagement;
    std::uint32_t triangles_seen = 0;  // by their boxes or balls; a quad is one
};

// Triangles larger than a third of the radius are looked at in pieces; beyond so many pieces in all the rest is left out.
inline constexpr std::uint32_t kMostEngagementPieces = 20000;

// ahead_object: which way the ball is drawn, at most of length 1: 1 where all of what drives it is sideways, 0 where none is.
[[nodiscard]] EngagementLook engagement(const LocalSurface& surface, const Vec3& center_object_m, double radius_m,
                                        const Vec3& ahead_object = Vec3(0.0)) noexcept;

}  // namespace burin

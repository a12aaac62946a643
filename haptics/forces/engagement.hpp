// SPDX-License-Identifier: MIT
// How deep a ball lies in the material around it, read from the surface: in a groove, at a wall, on a face.
//
// Seen from the ball's centre, the engaged part is where a surface that faces the centre is no farther than 1.1 R. Its solid
// angle W and the mean direction to it are summed over the triangles near. A ball that lies d deep in a plane sees
// W = 2 pi (1 - (R - d) / (1.1 R)), whether it has cut its bed already or not, so
//     d = 1.1 D - 0.1 R,  D = R W / (2 pi)
// and that is taken for any shape: an edge has half of what a face has. The tenth is room for facets and for the clearance
// between the ball that cuts and the ball that touches.
// Frame: object, metres. Work: the triangles near, at most kMostEngagementPieces pieces of them. Pure; no heap, lock, throw.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "geometry/local_surface.hpp"

namespace burin {

struct Engagement {
    double depth_m = 0.0;   // d, 0 to 2 R
    Vec3 into_object{0.0};  // unit, the mean direction into the material; zero: nothing near
};

struct EngagementLook {
    Engagement engagement;
    std::uint32_t triangles_seen = 0;
};

// Triangles larger than a third of the radius are looked at in pieces; beyond so many pieces in all the rest is left out.
inline constexpr std::uint32_t kMostEngagementPieces = 20000;

[[nodiscard]] EngagementLook engagement(const LocalSurface& surface, const Vec3& center_object_m,
                                        double radius_m) noexcept;

}  // namespace burin

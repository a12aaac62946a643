// SPDX-License-Identifier: MIT
// A smooth surface that moves with the tetrahedra of a body: what is touched and drawn of it. Contacts at the bare
// corners of tetrahedra would make forces depend on where in the mesh a finger is; these points lie much closer.
// Units: metres; frame: the body's own. Pure; any thread. Allocates.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bodies/mesh/tetrahedra.hpp"

namespace burin::bodies {

// A point of the body: a mean of four corners. Shares add up to 1; a point just outside the tetrahedra has some below
// 0.
struct Anchor {
    std::array<std::uint32_t, 4> corners{};
    std::array<double, 4> shares{};
};
[[nodiscard]] inline Vec3 place_of(const Anchor& anchor, std::span<const Vec3> places_m) {
    Vec3 place(0.0);
    for (std::size_t i = 0; i < 4; ++i) place += anchor.shares[i] * places_m[anchor.corners[i]];
    return place;
}

struct EmbeddedSurface {
    std::vector<Anchor> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    std::vector<double> areas_m2;                         // of each point at rest, a third of its triangles'
};

// Returns an ellipsoid's surface: the icosahedron's, divided `level` times (10 * 4^level + 2 points). Requires a level
// of 0 to 6 and a body with cells.
[[nodiscard]] EmbeddedSurface ellipsoid_surface(const Tetrahedra& body, const Vec3& half_axes_m, unsigned level);
// Returns where the points are.
[[nodiscard]] std::vector<Vec3> places_of(const EmbeddedSurface& surface, std::span<const Vec3> places_m);

}  // namespace burin::bodies

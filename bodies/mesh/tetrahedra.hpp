// SPDX-License-Identifier: MIT
// A solid as tetrahedra, made of Burin's own lattice: for balls and ellipsoids, with elements alike in size.
//
// The lattice is body-centred cubic, whose tetrahedra are all congruent. Where its edges leave the solid they are cut;
// lattice points too near to a cut are first moved onto the surface, so that no sliver is left (Labelle and Shewchuk
// 2007, "Isosurface stuffing", whose bounds of angles hold for their diagonals and not for ours: here the quadrilateral
// between two tetrahedra is split at its corner of the least number, which needs no colouring). Then inner points go to
// the middle of their neighbours where that makes the worst element around them better.
// Units: metres; frame: the body's own, its middle at the origin. Pure, deterministic; any thread. Allocates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"

namespace burin::bodies {

struct Tetrahedra {
    using Cell = std::array<std::uint32_t, 4>;
    std::vector<Vec3> places_m;
    std::vector<Cell> cells;  // of positive volume: the fourth corner lies on the side to which 0, 1, 2 turn left
};

// Returns the volume of a tetrahedron, negative where it is inside out.
[[nodiscard]] double volume_m3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
[[nodiscard]] double volume_m3(const Tetrahedra& body);
// Returns the worst quality of all: 1 is a regular tetrahedron, 0 a flat one (volume over the cube of the root mean
// square edge, after Parthasarathy et al. 1994).
[[nodiscard]] double worst_quality(const Tetrahedra& body);

// Makes an ellipsoid of about 50 / (h1 h2 h3) elements, h the lattice's spacing over each half axis. The surface's
// corners are moved out a little, so that the volume is the ellipsoid's. Fails on half axes or a spacing that are not
// positive, and on fewer than 3 or more than 40 cells along a half axis.
[[nodiscard]] Result<Tetrahedra> ellipsoid(const Vec3& half_axes_m, double spacing_m);

}  // namespace burin::bodies

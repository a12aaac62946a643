// SPDX-License-Identifier: MIT
// Where to put a cell's vertex: the point nearest to the tangent planes of the surface where it crosses the cell's edges
// (the quadratic error function of Ju et al. 2002), taken about the mean of the crossings and with weak directions left
// alone (Schaefer and Warren), so that it lies on a flat or curved surface, on a sharp edge, or in a corner.
//
// Most cells hold one, two or three smooth pieces of surface: there the point is found from the mean plane of each, in closed
// form. What is left, rare, goes through the eigenvalues.
#pragma once

#include <array>
#include <span>

#include "base/space.hpp"

namespace burin {

// One crossing: in cell units relative to the cell's lowest corner, with the unit normal there.
struct Crossing {
    Vec3f position;
    Vec3f normal;
};

// Cell units relative to the cell's lowest corner, within half a cell of the cell. 1 to 12 crossings.
[[nodiscard]] Vec3f feature_point(std::span<const Crossing> crossings);

}  // namespace burin

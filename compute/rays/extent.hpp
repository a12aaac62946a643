// SPDX-License-Identifier: MIT
// The size of what a solid holds, from the ends of its rays: what its lattice, which is larger, cannot tell.
#pragma once

#include "compute/rays/solid.hpp"

namespace burin::compute {

// Returns the bounds of the material in the object frame, metres; an empty box where there is none. A face across an
// axis is met by rays and therefore exact to a 4096th of a cell. The top of something round lies between rays: it is
// taken to be as curved as the normals of the outermost ray and its neighbours say (second order; a ball of 16 cells or
// more to 1e-3 of a cell). A tip between rays may be missed by as much as it rises within a cell. Along an axis whose
// rays meet nothing, of a part thinner than a cell, they are those of the other rays, up to a cell too small.
// Cost: one look at each ray. Thread: any, while nobody changes the solid.
[[nodiscard]] Box material_bounds(const Solid& solid);

}  // namespace burin::compute

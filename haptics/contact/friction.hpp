// SPDX-License-Identifier: MIT
// Coulomb friction by where the proxy is: how much of its way along the surface friction lets it go.
//
// The force is k (proxy - HIP), so its angle to the contact normal is that of the way from the HIP to the proxy: while the
// HIP lies within the cone of static friction below the proxy, the proxy stays, to the last bit, and so nothing drifts. Outside it the
// proxy slides, until the HIP lies on the cone of dynamic friction, and goes on sliding on that one from tick to tick until
// it need not move any more (Salisbury, Brock, Massie, Swarup and Zilles 1995; Harwin and Melder 2002).
#pragma once

#include <cmath>

#include "base/space.hpp"

namespace burin {

// Which share of the way `along` the surface is left: 0 within the cone. depth: of the HIP along the contact normal.
[[nodiscard]] inline double sliding_share(const Vec3& along, double depth, double coefficient) noexcept {
    const double length2 = glm::dot(along, along), held = coefficient * depth;
    if (!(length2 > held * held)) return 0.0;
    return 1.0 - held / std::sqrt(length2);
}

}  // namespace burin

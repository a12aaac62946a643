// SPDX-License-Identifier: MIT
// Coulomb friction by the proxy's position: how far friction lets the proxy slide along the surface.
//
// The force is k (proxy - HIP), so its angle to the contact normal is that of the vector from the HIP to the proxy.
// While the HIP lies within the cone of static friction below the proxy, the proxy stays exactly where it is, so
// nothing drifts. Outside that cone the proxy slides until the HIP lies on the cone of dynamic friction, and it stays
// with that cone from tick to tick until it need not move any more (Salisbury, Brock, Massie, Swarup and Zilles 1995;
// Harwin and Melder 2002).
#pragma once

#include <cmath>

#include "base/space.hpp"

namespace burin::haptics {

// Fraction of the displacement `along` the surface that the proxy slides: 0 within the friction cone. depth: of the HIP
// along the contact normal.
[[nodiscard]] inline double sliding_share(const Vec3& along, double depth, double coefficient) noexcept {
    const double length2 = glm::dot(along, along), held = coefficient * depth;
    if (!(length2 > held * held)) return 0.0;
    return 1.0 - held / std::sqrt(length2);
}

}  // namespace burin::haptics

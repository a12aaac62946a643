// SPDX-License-Identifier: MIT
// The lamp that lights a carved surface (compute/light/tile_light.hpp). Frame: object. Plain data.
#pragma once

#include "base/space.hpp"

namespace burin::compute {

// A disc far away.
struct Lamp {
    Vec3 direction_object{0.0, 1.0, 0.0};  // towards the lamp; of any length above zero
    double tangent = 0.05;                 // tangent of half the angle that it subtends, 0.002 to 0.5
    bool operator==(const Lamp&) const = default;
};

}  // namespace burin::compute

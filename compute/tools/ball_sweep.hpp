// SPDX-License-Identifier: MIT
// A ball that moves along a segment. Plain data.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "compute/rays/operation.hpp"

namespace burin::compute {

// A ball of radius_m that moves from start to end (object frame, metres); start == end is a stamp.
struct BallSweep {
    Vec3 start_object_m{0.0};
    Vec3 end_object_m{0.0};
    double radius_m = 0.0;
    // Material of the surface that the sweep leaves; an index into Solid::materials.
    std::uint8_t material = 0;
    Operation operation = Operation::cut;  // cut, fill or paint
};

}  // namespace burin::compute

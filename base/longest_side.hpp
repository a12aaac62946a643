// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "base/space.hpp"

namespace burin {

// Returns the longest side of a box, which is not empty.
[[nodiscard]] inline double longest_side_m(const Box& box) {
    const Vec3 size_m = box.extent();
    return std::max({size_m.x, size_m.y, size_m.z});
}

}  // namespace burin

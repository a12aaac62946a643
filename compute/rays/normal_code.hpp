// SPDX-License-Identifier: MIT
// From a direction in doubles to the code of its normal (shaders/shared/octahedral.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/space.hpp"
#include "shaders/shared/octahedral.h"

namespace burin {

// Of any length; the zero vector gives +z. The same on every machine: the longest part becomes 2^40 and all are rounded.
[[nodiscard]] inline std::uint32_t normal_code(const Vec3& normal) {
    const double longest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (!(longest > 0.0)) return shared::encode_normal({0, 0, 0});
    const auto whole = [&](double x) { return std::llround(x / longest * 0x1p40); };
    return shared::encode_normal({whole(normal.x), whole(normal.y), whole(normal.z)});
}

}  // namespace burin

// SPDX-License-Identifier: MIT
// Encoding of a direction given in doubles as a normal code (shaders/shared/octahedral.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/space.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::compute {

// Returns the code of a normal of any length; the zero vector gives +z. The result is the same on every machine: the
// vector is scaled until its longest component is 2^40, and rounded to whole numbers.
[[nodiscard]] inline std::uint32_t normal_code(const Vec3& normal) {
    const double longest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (!(longest > 0.0)) return shared::encode_normal({0, 0, 0});
    const auto whole = [&](double x) { return std::llround(x / longest * 0x1p40); };
    return shared::encode_normal({whole(normal.x), whole(normal.y), whole(normal.z)});
}

}  // namespace burin::compute

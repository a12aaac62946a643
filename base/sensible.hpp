// SPDX-License-Identifier: MIT
// Whether numbers from outside may be computed with.
#pragma once

#include <cmath>

#include "base/space.hpp"

namespace burin {

[[nodiscard]] inline bool finite(const Vec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

[[nodiscard]] inline bool not_negative(double x) noexcept { return std::isfinite(x) && x >= 0.0; }

[[nodiscard]] inline bool not_negative(const Vec3& v) noexcept {
    return not_negative(v.x) && not_negative(v.y) && not_negative(v.z);
}

}  // namespace burin

// SPDX-License-Identifier: MIT
// The quick look of a search at a triangle's or quad's box, in float.
#pragma once

#include <algorithm>

#include "geometry/componentwise.hpp"
#include "geometry/triangle.hpp"

namespace burin {

// Which boxes are within reach, in float; for a few beyond it too, because of the rounding.
struct RoundedBox {
    Vec3f lo, hi;
    float reach2;

    explicit RoundedBox(const Near& near) noexcept : lo(near.lo), hi(near.hi) {
        const Vec3 size = upper_of(glm::abs(near.lo), glm::abs(near.hi));
        const double rounding = 1e-7 * std::max({size.x, size.y, size.z});
        const double reach = (near.reach_m + 4.0 * rounding) * (1.0 + 1e-6);
        reach2 = static_cast<float>(reach * reach);
    }
    [[nodiscard]] bool meets(const Vec3f& from, const Vec3f& to) const noexcept {
        const Vec3f outside = upper_of(upper_of(from - hi, lo - to), Vec3f(0.0f));
        return glm::dot(outside, outside) <= reach2;
    }
};

}  // namespace burin

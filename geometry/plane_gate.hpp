// SPDX-License-Identifier: MIT
// The quick look of a search at a triangle's plane, in float.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/triangle.hpp"

namespace burin {

// Which planes are within reach of the way of a search (Near::by_plane), in float; for a few beyond it too, because of the rounding.
class PlaneGate {
public:
    // No edge of a triangle asked about is longer than longest_edge_m.
    PlaneGate(const Near& near, double longest_edge_m) noexcept
        : open_(!near.by_plane), from_(near.from), motion_(near.to - near.from) {
        const Vec3 size = glm::max(glm::abs(near.from), glm::abs(near.to));
        const double reach = near.reach_m + 4e-7 * std::max({size.x, size.y, size.z});
        // Heights times twice the area are compared squared. Their rounding is at most 6e-7 of the longest edge squared times
        // the way there; (a + b)^2 <= (1 + s) a^2 + (1 + 1 / s) b^2 keeps it apart, with s = 1e-3.
        const double far = reach + std::sqrt(glm::dot(motion_, motion_)) + longest_edge_m;
        const double rounding = 6e-7 * longest_edge_m * longest_edge_m * far;
        reach2_ = static_cast<float>(1.001 * reach * reach);
        rounding2_ = static_cast<float>(1001.0 * rounding * rounding);
    }
    [[nodiscard]] bool meets(const Vec3f& a, const Vec3f& b, const Vec3f& c) const noexcept {
        if (open_) return true;
        const Vec3f normal = glm::cross(b - a, c - a);
        const float at_start = glm::dot(normal, from_ - a), at_end = at_start + glm::dot(normal, motion_);
        const float limit = reach2_ * glm::dot(normal, normal) + rounding2_;
        return !(at_start * at_end > 0.0f && at_start * at_start > limit && at_end * at_end > limit);
    }

private:
    bool open_;
    Vec3f from_, motion_;
    float reach2_ = 0.0f, rounding2_ = 0.0f;
};

}  // namespace burin

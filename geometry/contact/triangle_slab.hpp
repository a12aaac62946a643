// SPDX-License-Identifier: MIT
// A plane that neighbouring triangles lie behind: lets a search leave out a whole group of them at once where it knows
// that nothing behind another plane matters.
//
// The plane's normal is the mean of the triangles' normals, so that for a group that is flat, or nearly so, it is as
// tight as the triangles themselves, however they are turned to the axes.
// Any one frame and unit of length. Made with the group, once. Pure; no heap, no throw.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/space.hpp"
#include "geometry/mesh/triangle.hpp"

namespace burin::geometry {

struct TriangleSlab {
    Vec3f normal{0.0f};  // unit; zero: nothing is known
    double top_m = 0.0;  // dot(normal, v) of the highest corner
};

// The greatest that dot(direction, v) may be for a corner v within the box and behind the slab.
[[nodiscard]] inline double highest(const Box& box, const TriangleSlab& slab, const Vec3& direction) noexcept {
    const Vec3 middle = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
    const double by_box = glm::dot(direction, middle) + glm::dot(glm::abs(direction), half);
    const Vec3 normal(slab.normal);
    const double along = glm::dot(direction, normal);
    if (!(along > 0.0)) return by_box;
    // direction = along * normal + rest; the slab bounds the first term, the box the rest.
    const Vec3 rest = direction - along * normal;
    const double by_slab = along * slab.top_m + glm::dot(rest, middle) + glm::dot(glm::abs(rest), half);
    return std::min(by_box, by_slab);
}

// Makes the slab of the triangles that for_each calls a visitor with, twice.
template <typename ForEach>
[[nodiscard]] TriangleSlab slab_around(ForEach&& for_each) {
    Vec3 sum(0.0);
    for_each([&](const Triangle& t) { sum += glm::cross(t.b - t.a, t.c - t.a); });
    const double length = std::sqrt(glm::dot(sum, sum));
    if (!(length > 0.0) || !(length < HUGE_VAL)) return {};
    const Vec3f normal(sum / length);
    double top_m = -HUGE_VAL;
    for_each([&](const Triangle& t) {
        for (const Vec3& v : {t.a, t.b, t.c}) top_m = std::max(top_m, glm::dot(Vec3(normal), v));
    });
    return {normal, top_m};
}

}  // namespace burin::geometry

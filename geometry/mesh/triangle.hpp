// SPDX-License-Identifier: MIT
// A triangle by its three corners, in any one frame and unit of length.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/space.hpp"

namespace burin {

struct Triangle {
    Vec3 a, b, c;  // counter-clockwise seen from outside
};

// The normals at a triangle's corners, of the smooth surface that it is a facet of. None where it is not known.
struct CornerNormals {
    bool known = false;
    std::array<Vec3f, 3> normals{};  // unit
};

// Thinner than 1e-5 of its longest edge, or a point: it adds nothing that its neighbours lack, and its normal is noise.
[[nodiscard]] inline bool is_degenerate(const Triangle& t) noexcept {
    const Vec3 ab = t.b - t.a, ca = t.a - t.c, bc = t.c - t.b;
    const double longest2 = std::max({glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
    const Vec3 twice_area = glm::cross(ca, ab);
    // height = twice the area over the longest edge; compared squared
    return !(glm::dot(twice_area, twice_area) > 1e-10 * longest2 * longest2);
}

// The ball around the box [lo, hi]: centre, radius; a little too large rather than too small, since it is float.
[[nodiscard]] inline glm::vec4 sphere_around(const Vec3f& lo, const Vec3f& hi) noexcept {
    const Vec3f center = 0.5f * (lo + hi);
    const Vec3f half = glm::max(hi - center, center - lo);  // from the middle as it was rounded
    return {center, glm::length(half) * (1.0f + 1e-6f)};
}

// What a search asks for: the triangles within reach of a box, metres, in the frame of what is searched.
struct Near {
    Vec3 lo{0.0}, hi{0.0};  // the box; a point when they are equal
    double reach_m = 0.0;   // how far from it
    std::uint32_t looks_left =
        UINT32_MAX;  // bounding boxes or balls it may look at; counted down, and none left ends it
    // True: triangles that are farther than reach_m from all of the way between two points, or whose planes are, may be left out
    // too. That is most of those around a ball in its own groove.
    bool by_way = false;
    Vec3 from{0.0}, to{0.0};

    [[nodiscard]] bool look() noexcept {
        if (looks_left == 0) return false;
        --looks_left;
        return true;
    }
};

}  // namespace burin

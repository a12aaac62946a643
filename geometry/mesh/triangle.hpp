// SPDX-License-Identifier: MIT
// A triangle by its three corners, in any one frame and unit of length, and the query of a search for triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/space.hpp"

namespace burin::geometry {

struct Triangle {
    Vec3 a, b, c;  // counter-clockwise seen from outside
};

// The normals of the smooth surface at the corners of one of its facets; not every surface knows them.
struct CornerNormals {
    bool known = false;
    std::array<Vec3f, 3> normals{};  // unit
};

// Tells whether the triangle is a point or lower than 1e-5 of its longest edge: it adds nothing that its neighbours
// lack, and its normal is noise.
[[nodiscard]] inline bool is_degenerate(const Triangle& t) noexcept {
    const Vec3 ab = t.b - t.a, ca = t.a - t.c, bc = t.c - t.b;
    const double longest2 = std::max({glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
    const Vec3 twice_area = glm::cross(ca, ab);
    // Height = twice the area over the longest edge; compared squared.
    return !(glm::dot(twice_area, twice_area) > 1e-10 * longest2 * longest2);
}

// Returns the ball around the box [lo, hi]: centre, radius. The float radius is rounded up rather than down.
[[nodiscard]] inline glm::vec4 sphere_around(const Vec3f& lo, const Vec3f& hi) noexcept {
    const Vec3f center = 0.5f * (lo + hi);
    const Vec3f half = glm::max(hi - center, center - lo);  // from the rounded centre
    return {center, glm::length(half) * (1.0f + 1e-6f)};
}

// A query for the triangles within reach of a box, metres, in the frame of the searched object.
struct Near {
    Vec3 lo{0.0}, hi{0.0};  // the box; a point when they are equal
    double reach_m = 0.0;   // distance from the box
    // Number of bounding boxes or balls that the search may still test; counted down, and the search ends at 0.
    std::uint32_t looks_left = UINT32_MAX;
    // Allows the search to leave out triangles that are farther than reach_m from the whole segment from `from` to
    // `to`, or whose planes are. Those are most triangles around a ball in its own groove.
    bool by_way = false;
    Vec3 from{0.0}, to{0.0};
    // Of the triangles, or pairs of them, only each so manieth is looked at, and the others are passed by: for sums
    // over very many. Passing by a few costs as much as a look.
    std::uint32_t thin = 1;
    std::uint32_t met = 0;

    [[nodiscard]] bool look() noexcept {
        if (looks_left == 0) return false;
        --looks_left;
        return true;
    }
    // How many of the next are passed by before one is looked at, at most so many.
    [[nodiscard]] std::uint32_t pass_over(std::uint32_t most) noexcept {
        const std::uint32_t from_last = met % thin;
        const std::uint32_t passed = from_last == 0 ? 0 : std::min(thin - from_last, most);
        met += passed;
        return passed;
    }
    // Whether this one is passed by.
    [[nodiscard]] bool passes_by() noexcept {
        constexpr std::uint32_t kPassedInALook = 16;
        if (thin == 1 || met++ % thin == 0) return false;
        if (met % kPassedInALook == 0 && looks_left > 0) --looks_left;
        return true;
    }
};

}  // namespace burin::geometry

// SPDX-License-Identifier: MIT
#include "wall/screen.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin::wall {
namespace {

constexpr double kTouching_m = 0.01;

// A screen shrunk by kTouching_m on each side.
struct Rectangle {
    Vec3 centre, right, up, normal;
    double half_width_m, half_height_m;

    explicit Rectangle(const Screen& s) {
        const Vec3 across = s.lower_right_world - s.lower_left_world, upwards = s.upper_left_world - s.lower_left_world;
        centre = 0.5 * (s.lower_right_world + s.upper_left_world);
        right = glm::normalize(across);
        up = glm::normalize(upwards);
        normal = glm::normalize(glm::cross(right, up));
        half_width_m = std::max(0.5 * glm::length(across) - kTouching_m, 0.0);
        half_height_m = std::max(0.5 * glm::length(upwards) - kTouching_m, 0.0);
    }
    [[nodiscard]] std::array<Vec3, 4> corners() const {
        const Vec3 r = half_width_m * right, u = half_height_m * up;
        return {centre - r - u, centre + r - u, centre + r + u, centre - r + u};
    }
    [[nodiscard]] bool holds(const Vec3& in_plane) const {
        const Vec3 d = in_plane - centre;
        return std::abs(glm::dot(d, right)) <= half_width_m && std::abs(glm::dot(d, up)) <= half_height_m;
    }
};

bool in_one_plane(const Rectangle& a, const Rectangle& b) {
    return std::ranges::all_of(
        b.corners(), [&](const Vec3& p) { return std::abs(glm::dot(p - a.centre, a.normal)) <= kTouching_m; });
}

// Separating axis test: two rectangles in a plane are disjoint exactly when a side of one separates them.
bool share_area(const Rectangle& a, const Rectangle& b) {
    for (const Vec3& axis : {a.right, a.up, b.right, b.up}) {
        const auto reach = [&](const Rectangle& r) {
            return r.half_width_m * std::abs(glm::dot(r.right, axis)) +
                   r.half_height_m * std::abs(glm::dot(r.up, axis));
        };
        if (std::abs(glm::dot(b.centre - a.centre, axis)) > reach(a) + reach(b)) return false;
    }
    return true;
}

// Whether a side of `a` passes through `b`. Two rectangles that cross share a segment, each of whose ends lies on a
// side of one of them.
bool side_pierces(const Rectangle& a, const Rectangle& b) {
    const std::array<Vec3, 4> corners = a.corners();
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 from = corners[i], to = corners[(i + 1) % 4];
        const double h0 = glm::dot(from - b.centre, b.normal), h1 = glm::dot(to - b.centre, b.normal);
        if (h0 * h1 >= 0.0) continue;
        if (b.holds(from + (to - from) * (h0 / (h0 - h1)))) return true;
    }
    return false;
}

}  // namespace

Overlap overlap_of(const Screen& a, const Screen& b) {
    const Rectangle first(a), second(b);
    if (in_one_plane(first, second)) return share_area(first, second) ? Overlap::lying_on : Overlap::none;
    return side_pierces(first, second) || side_pierces(second, first) ? Overlap::crossing : Overlap::none;
}

}  // namespace burin::wall

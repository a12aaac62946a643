// SPDX-License-Identifier: MIT
#include "haptics/contact/tool_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin::haptics {
namespace {

struct OnSegment {
    double x = 0.0, z = 0.0, squared = 0.0;
};

// The place of a segment that is nearest to the axis, seen along it.
OnSegment nearest_to_axis(const Vec3& a, const Vec3& b) {
    const double x = b.x - a.x, z = b.z - a.z, squared = x * x + z * z;
    const double share = squared > 0.0 ? std::clamp(-(a.x * x + a.z * z) / squared, 0.0, 1.0) : 0.0;
    OnSegment place{a.x + share * x, a.z + share * z};
    place.squared = place.x * place.x + place.z * place.z;
    return place;
}

// Seen along the axis; a triangle with the axis on one of its sides is none, and nor is one that is a line or a place.
bool is_around_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = a.x * b.z - a.z * b.x, bc = b.x * c.z - b.z * c.x, ca = c.x * a.z - c.z * a.x;
    return (ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0);
}

// A side that is turned to where the triangle is the nearest to the axis.
SideGap turned_gap(const ToolShape& shape, const std::array<Vec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    OnSegment nearest = nearest_to_axis(a, b);
    for (const OnSegment& other : {nearest_to_axis(b, c), nearest_to_axis(c, a)})
        if (other.squared < nearest.squared) nearest = other;
    if (is_around_axis(a, b, c)) nearest = {};
    const double away = std::sqrt(nearest.squared);
    const double low = std::min({a.y, b.y, c.y}), high = std::max({a.y, b.y, c.y});
    const double to_x = away > 0.0 ? nearest.x / away : 0.0, to_z = away > 0.0 ? nearest.z / away : 0.0;
    const std::array<double, 3> towards{to_x * a.x + to_z * a.z, to_x * b.x + to_z * b.z, to_x * c.x + to_z * c.z};
    SideGap best{-HUGE_VAL, -HUGE_VAL};
    for (std::uint32_t i = 0; i < shape.side_count; ++i) {
        const auto& [normal, offset_m] = shape.sides[i];
        // All around the axis each place of the triangle is at least so far; and it lies beyond a plane.
        const double around = normal.x * away + normal.y * (normal.y > 0.0 ? low : high) - offset_m;
        const double beyond = std::min({normal.x * towards[0] + normal.y * a.y, normal.x * towards[1] + normal.y * b.y,
                                        normal.x * towards[2] + normal.y * c.y}) -
                              offset_m;
        if (const double gap = std::max(around, beyond); gap > best.gap_m)
            best = {gap, beyond, Vec3(normal.x * to_x, normal.y, normal.x * to_z)};
    }
    return best;
}

}  // namespace

SideGap side_gap(const ToolShape& shape, const geometry::Triangle& triangle, const Vec3& at) noexcept {
    const std::array<Vec3, 3> corners{triangle.a - at, triangle.b - at, triangle.c - at};
    if (shape.side_count == 0) return {};
    if (shape.pieces[0].turned) return turned_gap(shape, corners);
    SideGap best{-HUGE_VAL, -HUGE_VAL};
    for (std::uint32_t i = 0; i < shape.side_count; ++i) {
        const ToolSide& side = shape.sides[i];
        const double lowest = std::min(
            {glm::dot(side.normal, corners[0]), glm::dot(side.normal, corners[1]), glm::dot(side.normal, corners[2])});
        if (lowest - side.offset_m > best.gap_m) best = {lowest - side.offset_m, lowest - side.offset_m, side.normal};
    }
    return best;
}

}  // namespace burin::haptics

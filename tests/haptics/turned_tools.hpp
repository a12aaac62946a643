// SPDX-License-Identifier: MIT
// Tools whose hulls can be projected onto in closed form, and the distance of such a hull from a triangle by
// alternating projections onto both, which is independent of how the program finds it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "haptics/contact/tool_shape.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics::test {

// Converges from above.
template <typename Onto>
double distance_by_projections(const geometry::Triangle& t, const Onto& onto) {
    Vec3 on_triangle = (t.a + t.b + t.c) / 3.0, on_hull = onto(on_triangle);
    for (int i = 0; i < 20'000; ++i) {
        on_triangle = nearest_on_triangle(on_hull, t).point;
        const Vec3 next = onto(on_triangle);
        if (glm::length(next - on_hull) < 1e-13) break;
        on_hull = next;
    }
    return glm::length(on_hull - on_triangle);
}

struct KnownTool {
    const char* name;
    ToolShape shape;
    std::function<Vec3(const Vec3&)> onto_hull;
};

inline void bound(ToolShape& shape, const Vec3& lo, const Vec3& hi, double width_m) {
    shape.size_m = width_m;
    shape.rounding_m = 0.02 * width_m;
    shape.bounds = {lo - shape.rounding_m, hi + shape.rounding_m};
    shape.reach_m = glm::length(glm::max(glm::abs(shape.bounds.lo), glm::abs(shape.bounds.hi)));
    shape.inside_m = 0.5 * (lo + hi);
}

inline KnownTool box_tool(const Vec3& half) {
    ToolShape shape;
    shape.piece_count = 1;
    shape.pieces[0] = {0, 8, false};
    for (int i = 0; i < 8; ++i)
        shape.corners[static_cast<std::size_t>(i)] = {(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                                      (i & 4) != 0 ? half.z : -half.z};
    bound(shape, -half, half, 2.0 * std::min({half.x, half.y, half.z}));
    return {"box", shape, [half](const Vec3& p) { return glm::clamp(p, -half, half); }};
}

// From the origin up.
inline KnownTool cylinder_tool(double radius_m, double length_m) {
    ToolShape shape;
    shape.piece_count = 1;
    shape.pieces[0] = {0, 2, true};
    shape.corners[0] = {radius_m, 0.0, 0.0};
    shape.corners[1] = {radius_m, length_m, 0.0};
    bound(shape, {-radius_m, 0.0, -radius_m}, {radius_m, length_m, radius_m}, std::min(2.0 * radius_m, length_m));
    return {"cylinder", shape, [=](const Vec3& p) {
                const double across = std::hypot(p.x, p.z), share = across > radius_m ? radius_m / across : 1.0;
                return Vec3(share * p.x, std::clamp(p.y, 0.0, length_m), share * p.z);
            }};
}

}  // namespace burin::haptics::test

// SPDX-License-Identifier: MIT
#include "bench/measure/exact_creases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/measure/exact_rays.hpp"

namespace burin::bench {
namespace {

constexpr double kOnSurface_m = 1e-9;  // far below what a mesh resolves, far above a double's rounding

Vec3 corner(int bits) { return {bits & 1 ? 1.0 : 0.0, bits & 2 ? 1.0 : 0.0, bits & 4 ? 1.0 : 0.0}; }

// Two unit vectors perpendicular to `axis` and to each other.
struct Across {
    Vec3 a, b;
};
Across across(const Vec3& axis) {
    const Vec3 size = glm::abs(axis);
    const Vec3 least = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                       : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                            : Vec3(0, 0, 1);
    const Vec3 a = glm::normalize(glm::cross(axis, least));
    return {a, glm::cross(axis, a)};
}

bool inside_cube(const Vec3& p) { return cube_distance(p) < 0.0; }

// Adds the points of one circle that lie on the solid's surface.
void add_circle(const compute::BallSweep& a, const compute::BallSweep& b, const SweptUnion& tools, double step_m,
                std::vector<Vec3>& points) {
    const Vec3 between = b.start_object_m - a.start_object_m;
    const double d = glm::length(between);
    const double to_plane = (d * d + a.radius_m * a.radius_m - b.radius_m * b.radius_m) / (2.0 * d);
    const double circle2 = a.radius_m * a.radius_m - to_plane * to_plane;
    if (circle2 <= 0.0) return;
    const double radius = std::sqrt(circle2);
    const Vec3 axis = between / d, center = a.start_object_m + axis * to_plane;
    const Across side = across(axis);
    const int count = std::max(8, static_cast<int>(std::ceil(2.0 * std::numbers::pi * radius / step_m)));
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const Vec3 p = center + (side.a * std::cos(angle) + side.b * std::sin(angle)) * radius;
        if (inside_cube(p) && tools.surface_error(p).error_m < kOnSurface_m) points.push_back(p);
    }
}

}  // namespace

std::vector<Vec3> untouched_edge_points(const SweptUnion& tools, int an_edge, double clearance_m) {
    std::vector<Vec3> points;
    for (int axis = 0; axis < 3; ++axis) {
        for (int bits = 0; bits < 8; ++bits) {
            if (bits & 1 << axis) continue;
            for (int i = 0; i < an_edge; ++i) {
                Vec3 p = corner(bits);
                p[axis] = (i + 0.5) / an_edge;
                if (tools.distance(p) > clearance_m) points.push_back(p);
            }
        }
    }
    return points;
}

std::vector<Vec3> untouched_corners(const SweptUnion& tools, double clearance_m) {
    std::vector<Vec3> points;
    for (int bits = 0; bits < 8; ++bits) {
        if (tools.distance(corner(bits)) > clearance_m) points.push_back(corner(bits));
    }
    return points;
}

std::vector<Vec3> rim_points(const CarveScene& scene, int lines) {
    std::vector<Vec3> points;
    for (int axis = 0; axis < 3; ++axis) {  // direction of the lines
        const RayColumns columns(scene.sweeps, axis, 0.0);
        for (int side = 0; side < 4; ++side) {  // the face: which of the other two axes is fixed, and where
            for (int i = 0; i < lines; ++i) {
                const double fixed = side & 1 ? 1.0 : 0.0, running = (i + 0.5) / lines;
                const double u = side & 2 ? running : fixed, v = side & 2 ? fixed : running;
                for (const Interval& gone : columns.covered(u, v)) {
                    for (const double depth : {gone.lo, gone.hi}) {
                        if (depth <= 0.0 || depth >= 1.0) continue;
                        Vec3 p(0.0);
                        p[axis] = depth;
                        p[(axis + 1) % 3] = u;
                        p[(axis + 2) % 3] = v;
                        points.push_back(p);
                    }
                }
            }
        }
    }
    return points;
}

std::vector<Vec3> ball_ball_crease_points(const CarveScene& scene, const SweptUnion& tools, double least_angle_rad,
                                          double step_m) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < scene.sweeps.size(); ++i) {
        for (std::size_t j = i + 1; j < scene.sweeps.size(); ++j) {
            const compute::BallSweep &a = scene.sweeps[i], &b = scene.sweeps[j];
            const double d = glm::length(b.start_object_m - a.start_object_m);
            if (d == 0.0 || d >= a.radius_m + b.radius_m || d <= std::abs(a.radius_m - b.radius_m)) continue;
            // The angle between the two surfaces' normals on the circle.
            const double cosine =
                (a.radius_m * a.radius_m + b.radius_m * b.radius_m - d * d) / (2.0 * a.radius_m * b.radius_m);
            if (cosine < std::cos(least_angle_rad)) add_circle(a, b, tools, step_m, points);
        }
    }
    return points;
}

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
#include "haptics/contact/triangle_contact.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

double clamp01(double x) { return x < 0.0 ? 0.0 : (x > 1.0 ? 1.0 : x); }

Vec3 nearest_on_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 e = b - a;
    return a + e * clamp01(glm::dot(p - a, e) / glm::dot(e, e));
}

// The root at which A t^2 + 2 B t + C passes from positive to negative, or kNoTouch. C > 0: outside at the start.
double entry(double A, double B, double C) {
    if (!(C > 0.0) || !(B < 0.0)) return kNoTouch;
    const double discriminant = B * B - A * C;
    if (discriminant < 0.0) return kNoTouch;
    return C / (-B + std::sqrt(discriminant));  // the form without cancellation
}

struct Sweep {
    Vec3 center, motion;
    double radius;
    double height, approach;  // height of the centre above the plane at the start, and its change over the motion

    // Discards a touch from behind: the ball is on its way out of the material. The touched point lies in the plane.
    [[nodiscard]] double if_from_outside(double t) const {
        return t <= 1.0 && height + t * approach >= -1e-6 * radius ? t : kNoTouch;
    }
    [[nodiscard]] double until_corner(const Vec3& corner) const {
        const Vec3 from = center - corner;
        const double from_motion = glm::dot(from, motion);
        if (!(from_motion < 0.0)) return kNoTouch;
        return if_from_outside(entry(glm::dot(motion, motion), from_motion, glm::dot(from, from) - radius * radius));
    }
    // Sweeps against the cylinder around the edge; its ends are handled as corners.
    [[nodiscard]] double until_edge(const Vec3& a, const Vec3& b) const {
        const Vec3 e = b - a, from = center - a;
        const double per_e2 = 1.0 / glm::dot(e, e), from_e = glm::dot(from, e);
        const Vec3 across = from - e * (from_e * per_e2);
        const double across_motion = glm::dot(across, motion);
        if (!(across_motion < 0.0)) return kNoTouch;
        const double motion_e = glm::dot(motion, e);
        const Vec3 motion_across = motion - e * (motion_e * per_e2);
        const double t =
            entry(glm::dot(motion_across, motion_across), across_motion, glm::dot(across, across) - radius * radius);
        const double along = (from_e + t * motion_e) * per_e2;
        return along >= 0.0 && along <= 1.0 ? if_from_outside(t) : kNoTouch;
    }
};

}  // namespace

Vec3 outward_normal(const geometry::Triangle& t) noexcept {
    const Vec3 n = glm::cross(t.b - t.a, t.c - t.a);
    return n / std::sqrt(glm::dot(n, n));
}

// Works from the dot products of the two edges at `a` with each other and with p - a: the barycentric coordinates of
// p's foot decide which edges p is beyond, and the nearest point is then the foot or lies on one of those edges.
NearestOnTriangle nearest_on_triangle(const Vec3& p, const geometry::Triangle& t) noexcept {
    const Vec3 u = t.b - t.a, v = t.c - t.a, w = p - t.a;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double wu = glm::dot(w, u), wv = glm::dot(w, v);
    const double area = uu * vv - uv * uv;     // (twice the area)^2, above 0
    const double along_u = vv * wu - uv * wv;  // barycentric coordinates of the foot, times area
    const double along_v = uu * wv - uv * wu;
    if (along_u >= 0.0 && along_v >= 0.0 && along_u + along_v <= area)
        return {t.a + u * (along_u / area) + v * (along_v / area), true};
    // At an obtuse corner p may be beyond two edges, and the nearest point may lie on either.
    NearestOnTriangle best;
    double best2 = HUGE_VAL;
    const auto consider = [&](const Vec3& q) {
        const double d2 = glm::dot(p - q, p - q);
        if (d2 < best2) best2 = d2, best.point = q;
    };
    if (along_v < 0.0) consider(t.a + u * clamp01(wu / uu));
    if (along_u < 0.0) consider(t.a + v * clamp01(wv / vv));
    if (along_u + along_v > area) consider(nearest_on_edge(p, t.b, t.c));
    return best;
}

// The barycentric coordinates of the centre's foot, times (twice the area)^2, give its side of each edge. They rule out
// most triangles before edges and corners are tested.
double fraction_until_touch(const Vec3& center, const Vec3& motion, double radius,
                            const geometry::Triangle& t) noexcept {
    const Vec3 u = t.b - t.a, v = t.c - t.a, w = center - t.a, n = glm::cross(u, v);
    const double n2 = glm::dot(n, n), per_n = 1.0 / std::sqrt(n2);
    const double height = glm::dot(n, w) * per_n, approach = glm::dot(n, motion) * per_n;
    if (height >= radius && !(height + approach < radius)) return kNoTouch;

    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double wu = glm::dot(w, u), wv = glm::dot(w, v), mu = glm::dot(motion, u), mv = glm::dot(motion, v);
    const double at_u = vv * wu - uv * wv, at_v = uu * wv - uv * wu, at_a = n2 - at_u - at_v;
    const double by_u = vv * mu - uv * mv, by_v = uu * mv - uv * mu, by_a = -by_u - by_v;
    if (height >= radius) {
        // The face comes first when it is hit at all: edges and corners lie behind its plane's offset.
        const double face = (height - radius) / -approach;
        if (at_u + face * by_u >= 0.0 && at_v + face * by_v >= 0.0 && at_a + face * by_a >= 0.0) return face;
    }
    const double beside2 = 1.000001 * radius * radius * n2;
    const auto beside = [&](double at, double by, double edge2) {
        const double nearer = by > 0.0 ? at + by : at;
        return nearer < 0.0 && nearer * nearer > beside2 * edge2;
    };
    if (beside(at_u, by_u, vv) || beside(at_v, by_v, uu) || beside(at_a, by_a, uu + vv - 2.0 * uv)) return kNoTouch;

    const Sweep sweep{center, motion, radius, height, approach};
    return std::min({sweep.until_edge(t.a, t.b), sweep.until_edge(t.b, t.c), sweep.until_edge(t.c, t.a),
                     sweep.until_corner(t.a), sweep.until_corner(t.b), sweep.until_corner(t.c)});
}

double fraction_until_touch(const Vec3& center, const Vec3& motion, double radius, const Vec3& point,
                            const Vec3& normal) noexcept {
    return Sweep{center, motion, radius, glm::dot(center - point, normal), glm::dot(motion, normal)}.until_corner(
        point);
}

double solid_angle_tangent(const Vec3& p, const geometry::Triangle& t) noexcept {
    const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
    const double la = std::sqrt(glm::dot(a, a)), lb = std::sqrt(glm::dot(b, b)), lc = std::sqrt(glm::dot(c, c));
    const double volume = glm::dot(a, glm::cross(b, c));
    const double base = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    constexpr double kMost = 1e3;  // p lies almost on the triangle
    if (std::abs(volume) >= kMost * base) return volume == 0.0 ? 0.0 : std::copysign(kMost, volume);
    return volume / base;
}

}  // namespace burin::haptics

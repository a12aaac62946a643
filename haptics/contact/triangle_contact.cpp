// SPDX-License-Identifier: MIT
#include "haptics/contact/triangle_contact.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

double clamp01(double x) { return x < 0.0 ? 0.0 : (x > 1.0 ? 1.0 : x); }

Vec3 nearest_on_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 e = b - a;
    return a + e * clamp01(glm::dot(p - a, e) / glm::dot(e, e));
}

// The root at which A t^2 + 2 B t + C passes from above 0 to below, or kNoTouch. C > 0: outside at the start.
double entry(double A, double B, double C) {
    if (!(C > 0.0) || !(B < 0.0)) return kNoTouch;
    const double discriminant = B * B - A * C;
    if (discriminant < 0.0) return kNoTouch;
    return C / (-B + std::sqrt(discriminant));  // the form that does not cancel
}

struct Sweep {
    Vec3 center, motion;
    double radius;
    Vec3 normal;

    // Touching from behind is not touching: the ball is on its way out of the material.
    [[nodiscard]] bool from_outside(double t, const Vec3& touched) const {
        return glm::dot(center + t * motion - touched, normal) >= -1e-6 * radius;
    }

    [[nodiscard]] double until_corner(const Vec3& corner) const {
        const Vec3 from = center - corner;
        const double t =
            entry(glm::dot(motion, motion), glm::dot(from, motion), glm::dot(from, from) - radius * radius);
        return t <= 1.0 && from_outside(t, corner) ? t : kNoTouch;
    }

    // The cylinder around the edge; its ends belong to the corners.
    [[nodiscard]] double until_edge(const Vec3& a, const Vec3& b) const {
        const Vec3 e = b - a;
        const double e2 = glm::dot(e, e);
        const Vec3 from = center - a;
        const double from_e = glm::dot(from, e), motion_e = glm::dot(motion, e);
        const Vec3 from_across = from - e * (from_e / e2), motion_across = motion - e * (motion_e / e2);
        const double t = entry(glm::dot(motion_across, motion_across), glm::dot(from_across, motion_across),
                               glm::dot(from_across, from_across) - radius * radius);
        if (t > 1.0) return kNoTouch;
        const double along = (from_e + t * motion_e) / e2;
        return along >= 0.0 && along <= 1.0 && from_outside(t, a + e * along) ? t : kNoTouch;
    }

    [[nodiscard]] double until_face(const Triangle& tri) const {
        const double height = glm::dot(normal, center - tri.a) - radius;
        const double approach = glm::dot(normal, motion);
        if (height < 0.0 || approach >= 0.0) return kNoTouch;
        const double t = height / -approach;
        if (t > 1.0) return kNoTouch;
        return nearest_on_triangle(center + t * motion - radius * normal, tri).on_face ? t : kNoTouch;
    }
};

}  // namespace

Vec3 outward_normal(const Triangle& t) noexcept {
    const Vec3 n = glm::cross(t.b - t.a, t.c - t.a);
    return n / std::sqrt(glm::dot(n, n));
}

// All from the products of the two edges at `a` with each other and with p - a: the barycentric coordinates of p's foot
// tell which edges p is beyond, and the nearest point then is the foot or lies on one of those.
NearestOnTriangle nearest_on_triangle(const Vec3& p, const Triangle& t) noexcept {
    const Vec3 u = t.b - t.a, v = t.c - t.a, w = p - t.a;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double wu = glm::dot(w, u), wv = glm::dot(w, v);
    const double area = uu * vv - uv * uv;     // (twice the area)^2, above 0
    const double along_u = vv * wu - uv * wv;  // barycentric coordinates of the foot, times area
    const double along_v = uu * wv - uv * wu;
    if (along_u >= 0.0 && along_v >= 0.0 && along_u + along_v <= area)
        return {t.a + u * (along_u / area) + v * (along_v / area), true};
    // With an obtuse corner p may be beyond two edges, and the nearest point on either.
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

double fraction_until_touch(const Vec3& center, const Vec3& motion, double radius, const Triangle& t) noexcept {
    const Sweep sweep{center, motion, radius, outward_normal(t)};
    // The face comes first when it is hit at all: edges and corners lie behind its plane's offset.
    if (const double face = sweep.until_face(t); face <= 1.0) return face;
    return std::min({sweep.until_edge(t.a, t.b), sweep.until_edge(t.b, t.c), sweep.until_edge(t.c, t.a),
                     sweep.until_corner(t.a), sweep.until_corner(t.b), sweep.until_corner(t.c)});
}

double solid_angle_tangent(const Vec3& p, const Triangle& t) noexcept {
    const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
    const double la = std::sqrt(glm::dot(a, a)), lb = std::sqrt(glm::dot(b, b)), lc = std::sqrt(glm::dot(c, c));
    const double volume = glm::dot(a, glm::cross(b, c));
    const double base = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    constexpr double kMost = 1e3;  // p is all but on the triangle
    if (std::abs(volume) >= kMost * base) return volume == 0.0 ? 0.0 : std::copysign(kMost, volume);
    return volume / base;
}

}  // namespace burin

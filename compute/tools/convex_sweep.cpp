// SPDX-License-Identifier: MIT
#include "compute/tools/convex_sweep.hpp"

#include <array>
#include <cmath>

namespace burin::compute {
namespace {

constexpr double kSweepSlack = 0x1p-20;  // lattice units; far above rounding at coordinates up to 2^27
constexpr double kFar = 1e9;             // lattice units; farther than any point of a tool

Vec3 unit_vector(int axis) {
    Vec3 e(0.0);
    e[axis] = 1.0;
    return e;
}

// Returns the point of a ray that has the same depth as `near`.
Vec3 ray_beside(int axis, double ray_u, double ray_v, const Vec3& near) {
    Vec3 p;
    p[axis] = near[axis];
    p[(axis + 1) % 3] = ray_u;
    p[(axis + 2) % 3] = ray_v;
    return p;
}

// A line of the (s, t) plane: (s, t) + a (ds, dt).
struct Line {
    double s, t, ds, dt;
};

// Returns the line on which r s + w t + k = 0. Its point is chosen near the strip 0 <= t <= T; side() rejects a line
// that passes far away.
Line line_where(double r, double w, double k, double half_distance) {
    if (std::abs(r) >= std::abs(w)) return {-(k + w * half_distance) / r, half_distance, -w / r, 1.0};
    return {0.0, -k / w, 1.0, -r / w};
}

enum class Part { side, rim, cap };

struct Candidate {
    double s, t;
    Part part;
};

// The swept frustum in the (s, t) plane of one ray.
class Section {
public:
    Section(const Frustum& shape, double slope, const Vec3& axis, const Vec3& o, const Vec3& e, const Vec3& d,
            double distance)
        : shape_(shape), distance_(distance) {
        // |p|^2 - (p.axis)^2 - (tip_radius + slope p.axis)^2 <= 0 with p = o + s e - t d.
        const double turned = 1.0 + slope * slope, pull = shape.tip_radius * slope;
        const double oy = glm::dot(o, axis), ey = glm::dot(e, axis), dy = glm::dot(d, axis);
        ss_ = 1.0 - turned * ey * ey;
        st_ = turned * ey * dy - glm::dot(e, d);
        tt_ = glm::dot(d, d) - turned * dy * dy;
        s_ = glm::dot(o, e) - turned * oy * ey - pull * ey;
        t_ = turned * oy * dy - glm::dot(o, d) + pull * dy;
        one_ = glm::dot(o, o) - turned * oy * oy - 2.0 * pull * oy - shape.tip_radius * shape.tip_radius;
        y_ = oy;
        ys_ = ey;
        yt_ = -dy;
        noise_ = 4e-15 * (glm::dot(o, o) + distance * distance) + kSweepSlack * (shape.tip_radius + shape.top_radius);
    }

    // Finds the candidates with the least and the greatest s; returns false when there are none.
    bool extremes(Candidate& least, Candidate& greatest) {
        side({0.0, 0.0, 1.0, 0.0}, Part::side);
        if (distance_ > 0.0) {
            side({0.0, distance_, 1.0, 0.0}, Part::side);
            side(line_where(st_, tt_, t_, 0.5 * distance_), Part::side);
            for (const double y : {0.0, shape_.length}) side(line_where(ys_, yt_, y_ - y, 0.5 * distance_), Part::rim);
        }
        for (const double y : {0.0, shape_.length}) {
            cap((y - y_) / ys_, 0.0);
            if (distance_ > 0.0) cap((y - y_ - yt_ * distance_) / ys_, distance_);
        }
        least = least_;
        greatest = greatest_;
        return found_;
    }

private:
    [[nodiscard]] static bool within(double x, double length) { return x >= -kSweepSlack && x <= length + kSweepSlack; }
    [[nodiscard]] double height(double s, double t) const { return y_ + ys_ * s + yt_ * t; }
    [[nodiscard]] double conic(double s, double t) const {
        return (ss_ * s + 2.0 * (st_ * t + s_)) * s + (tt_ * t + 2.0 * t_) * t + one_;
    }

    void take(const Candidate& c) {
        if (!found_ || c.s < least_.s) least_ = c;
        if (!found_ || c.s > greatest_.s) greatest_ = c;
        found_ = true;
    }

    // Adds the candidates at which a line meets the side.
    void side(const Line& line, Part part) {
        if (!(std::abs(line.s) < kFar && std::abs(line.t) < kFar)) return;
        const double a = (ss_ * line.ds + 2.0 * st_ * line.dt) * line.ds + tt_ * line.dt * line.dt;
        const double b = (ss_ * line.s + st_ * line.t + s_) * line.ds + (st_ * line.s + tt_ * line.t + t_) * line.dt;
        const double c = conic(line.s, line.t);
        double root2 = b * b - a * c;
        if (root2 < 0.0) {
            if (root2 < -1e-13 * (b * b + std::abs(a * c))) return;
            root2 = 0.0;  // the line touches the conic, but for rounding
        }
        const double root = std::sqrt(root2), q = b < 0.0 ? root - b : -root - b;
        for (const double way : {q / a, c / q}) {
            const double s = line.s + way * line.ds, t = line.t + way * line.dt;
            if (within(t, distance_) && within(height(s, t), shape_.length)) take({s, t, part});
        }
    }

    // Adds the candidate in a cap's plane at one end of the motion.
    void cap(double s, double t) {
        if (std::abs(s) < kFar && conic(s, t) <= noise_ + 4e-15 * s * s) take({s, t, Part::cap});
    }

    const Frustum& shape_;
    double distance_;
    double ss_, st_, tt_, s_, t_, one_;  // coefficients of the conic; s_, t_ and st_ are halved
    double y_, ys_, yt_;                 // coefficients of the height above the tip
    double noise_;                       // bound of the conic's value where it should be zero, from rounding and slack
    bool found_ = false;
    Candidate least_{}, greatest_{};
};

}  // namespace

FrustumSweep::FrustumSweep(const Frustum& shape, const Vec3& tip, const Vec3& axis, const Vec3& along)
    : shape_(shape),
      tip_(tip),
      axis_(axis),
      along_(along),
      distance_(std::sqrt(glm::dot(along, along))),
      slope_((shape.top_radius - shape.tip_radius) / shape.length) {
    if (distance_ > 0.0) direction_ = along / distance_;
}

SweepSpan FrustumSweep::span(int axis, double ray_u, double ray_v) const {
    const Vec3 e = unit_vector(axis);
    const Vec3 on_ray = ray_beside(axis, ray_u, ray_v, tip_ + 0.5 * (along_ + axis_ * shape_.length));
    const Vec3 o = on_ray - tip_;
    Candidate least{}, greatest{};
    if (!Section(shape_, slope_, axis_, o, e, direction_, distance_).extremes(least, greatest)) return {};
    struct Normals {
        Vec3 body, slice;
    };
    // Returns the outward normals at a candidate: of the body whose slice this is, and of the slice itself.
    const auto normals_at = [&](const Candidate& c) -> Normals {
        const Vec3 p = o + c.s * e - c.t * direction_;
        const double y = glm::dot(p, axis_);
        const Vec3 outward = p - axis_ * y, cap = y < 0.5 * shape_.length ? -axis_ : axis_;
        if (c.part == Part::cap) return {cap, cap};
        const bool moving = c.t > kSweepSlack && c.t < distance_ - kSweepSlack, at_edge = moving && c.part == Part::rim;
        const Vec3 side = outward - axis_ * (slope_ * (shape_.tip_radius + slope_ * y));
        if (at_edge) {
            // At an edge the motion selects a normal n with n.d = 0 between those of the side and the cap.
            const Vec3 n = cap * std::abs(glm::dot(side, direction_)) + side * std::abs(glm::dot(cap, direction_));
            const Vec3& either = n == Vec3(0.0) ? cap : n;
            return {either, either};
        }
        if (shape_.rim_radius < 0.0) return {side, side};
        const double out = std::sqrt(glm::dot(outward, outward));
        const Vec3 from_rim = out > shape_.rim_radius ? outward * (1.0 - shape_.rim_radius / out) : Vec3(0.0);
        const Vec3 n = from_rim + axis_ * (y - shape_.rim_height);
        return {moving ? n - direction_ * glm::dot(n, direction_) : n, side};
    };
    const Normals at_least = normals_at(least), at_greatest = normals_at(greatest);
    SweepSpan span{on_ray[axis] + least.s, on_ray[axis] + greatest.s, at_least.body, at_greatest.body,
                   at_least.slice,         at_greatest.slice};
    if (glm::dot(span.normal_lo, span.normal_lo) == 0.0) span.normal_lo = -e;  // at the tip of a cone
    if (glm::dot(span.normal_hi, span.normal_hi) == 0.0) span.normal_hi = e;
    return span;
}

Box FrustumSweep::bounds() const {
    Box box;
    const Vec3 across(std::sqrt(std::max(0.0, 1.0 - axis_.x * axis_.x)),
                      std::sqrt(std::max(0.0, 1.0 - axis_.y * axis_.y)),
                      std::sqrt(std::max(0.0, 1.0 - axis_.z * axis_.z)));
    for (const Vec3& tip : {tip_, tip_ + along_}) {
        const Vec3 top = tip + axis_ * shape_.length;
        box.include(tip - across * shape_.tip_radius);
        box.include(tip + across * shape_.tip_radius);
        box.include(top - across * shape_.top_radius);
        box.include(top + across * shape_.top_radius);
    }
    return box;
}

BoxSweep::BoxSweep(const Vec3& half_size, const Vec3& center, const Quat& orientation, const Vec3& along)
    : half_size_(half_size),
      middle_(center + 0.5 * along),
      along_(along),
      orientation_(orientation),
      half_along_tool_(glm::conjugate(orientation) * (0.5 * along)) {}

SweepSpan BoxSweep::span(int axis, double ray_u, double ray_v) const {
    const Quat tool_from_lattice = glm::conjugate(orientation_);
    const Vec3 on_ray = ray_beside(axis, ray_u, ray_v, middle_);
    const Vec3 o = tool_from_lattice * (on_ray - middle_), e = tool_from_lattice * unit_vector(axis);
    const Vec3& h = half_size_;
    const Vec3& d = half_along_tool_;
    // Normals of the six pairs of planes: perpendicular to two sides of the box, or to one side and the motion.
    const std::array<Vec3, 6> normals{Vec3(1, 0, 0),      Vec3(0, 1, 0),      Vec3(0, 0, 1),
                                      Vec3(0, d.z, -d.y), Vec3(-d.z, 0, d.x), Vec3(d.y, -d.x, 0)};
    SweepSpan span{-kFar, kFar, {}, {}, {}, {}};
    for (const Vec3& n : normals) {
        const double reach = std::abs(n.x) * h.x + std::abs(n.y) * h.y + std::abs(n.z) * h.z + std::abs(glm::dot(n, d));
        const double rise = glm::dot(n, e), at = glm::dot(n, o);
        if (rise == 0.0) {
            if (std::abs(at) > reach) return {};
            continue;
        }
        const double one = (-reach - at) / rise, other = (reach - at) / rise;
        const double lo = std::min(one, other), hi = std::max(one, other);
        if (lo > span.lo) span.lo = lo, span.normal_lo = rise > 0.0 ? -n : n;
        if (hi < span.hi) span.hi = hi, span.normal_hi = rise > 0.0 ? n : -n;
    }
    if (span.empty()) return {};
    span.lo += on_ray[axis];
    span.hi += on_ray[axis];
    span.normal_lo = orientation_ * span.normal_lo;
    span.normal_hi = orientation_ * span.normal_hi;
    span.plane_lo = span.normal_lo;
    span.plane_hi = span.normal_hi;
    return span;
}

Vec3 BoxSweep::side(int side) const { return orientation_ * unit_vector(side); }

Box BoxSweep::bounds() const {
    Vec3 reach = glm::abs(0.5 * along_);
    for (int side = 0; side < 3; ++side) reach += glm::abs(orientation_ * unit_vector(side)) * half_size_[side];
    return {middle_ - reach, middle_ + reach};
}

}  // namespace burin::compute

// SPDX-License-Identifier: MIT
#include "bench/measure/exact_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace burin::bench {
namespace {

// Returns the interval of the line that a ball covers.
std::optional<Interval> through_ball(const Vec3& center, double radius, const Vec3& through, int axis) {
    const Vec3 d = center - through;
    const double away2 = glm::dot(d, d) - d[axis] * d[axis], half2 = radius * radius - away2;
    if (half2 <= 0.0) return std::nullopt;
    return Interval{center[axis] - std::sqrt(half2), center[axis] + std::sqrt(half2)};
}

// Returns the interval of the line that a cylinder without its
// round ends covers: |w - (w.e)e|^2 < r^2 and 0 < w.e < length.
std::optional<Interval> through_cylinder(const compute::BallSweep& s, double radius, const Vec3& through, int axis) {
    const Vec3 e_long = s.end_object_m - s.start_object_m;
    const double length = glm::length(e_long);
    if (length == 0.0) return std::nullopt;
    const Vec3 e = e_long / length, w = through - s.start_object_m;  // the point at depth x: w + x * along
    Vec3 along(0.0);
    along[axis] = 1.0;
    const Vec3 w_across = w - e * glm::dot(w, e), along_across = along - e * e[axis];
    const double a = glm::dot(along_across, along_across), b = glm::dot(along_across, w_across),
                 c = glm::dot(w_across, w_across) - radius * radius;
    Interval x{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    if (a < 1e-18) {
        if (c >= 0.0) return std::nullopt;
    } else {
        const double root2 = b * b - a * c;
        if (root2 <= 0.0) return std::nullopt;
        x = {(-b - std::sqrt(root2)) / a, (-b + std::sqrt(root2)) / a};
    }
    const double w_along = glm::dot(w, e);
    if (e[axis] == 0.0) {
        if (w_along <= 0.0 || w_along >= length) return std::nullopt;
    } else {
        const double at_start = -w_along / e[axis], at_end = (length - w_along) / e[axis];
        x = {std::max(x.lo, std::min(at_start, at_end)), std::min(x.hi, std::max(at_start, at_end))};
    }
    if (x.lo >= x.hi) return std::nullopt;
    return x;
}

std::vector<Interval> joined(std::vector<Interval> pieces) {
    std::ranges::sort(pieces, {}, &Interval::lo);
    std::vector<Interval> whole;
    for (const Interval& piece : pieces) {
        if (whole.empty() || piece.lo > whole.back().hi) {
            whole.push_back(piece);
        } else {
            whole.back().hi = std::max(whole.back().hi, piece.hi);
        }
    }
    return whole;
}

Vec3 point_of(int axis, double u, double v) {
    Vec3 p(0.0);
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    return p;
}

}  // namespace

std::vector<Interval> covered(std::span<const compute::BallSweep> sweeps, int axis, double u, double v,
                              double growth_m) {
    const Vec3 through = point_of(axis, u, v);
    std::vector<Interval> pieces;
    const auto add = [&](const std::optional<Interval>& piece) {
        if (piece) pieces.push_back(*piece);
    };
    for (const compute::BallSweep& s : sweeps) {
        const double radius = s.radius_m + growth_m;
        add(through_ball(s.start_object_m, radius, through, axis));
        if (s.end_object_m == s.start_object_m) continue;
        add(through_ball(s.end_object_m, radius, through, axis));
        add(through_cylinder(s, radius, through, axis));
    }
    return joined(std::move(pieces));
}

RayColumns::RayColumns(std::span<const compute::BallSweep> sweeps, int axis, double margin_m)
    : axis_(axis), columns_(static_cast<std::size_t>(kColumns) * kColumns) {
    const auto column = [](double x) {
        return std::clamp(static_cast<int>(std::floor(x * kColumns)), 0, kColumns - 1);
    };
    for (const compute::BallSweep& s : sweeps) {
        const Vec3 lo = glm::min(s.start_object_m, s.end_object_m) - Vec3(s.radius_m + margin_m);
        const Vec3 hi = glm::max(s.start_object_m, s.end_object_m) + Vec3(s.radius_m + margin_m);
        const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
        for (int v = column(lo[v_axis]); v <= column(hi[v_axis]); ++v) {
            for (int u = column(lo[u_axis]); u <= column(hi[u_axis]); ++u) {
                columns_[static_cast<std::size_t>(v) * kColumns + static_cast<std::size_t>(u)].push_back(s);
            }
        }
    }
}

std::vector<Interval> RayColumns::covered(double u, double v, double growth_m) const {
    const auto column = [](double x) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(std::floor(x * kColumns)), 0, kColumns - 1));
    };
    return bench::covered(columns_[column(v) * kColumns + column(u)], axis_, u, v, growth_m);
}

std::vector<Interval> RayColumns::kept(double u, double v, double growth_m) const {
    if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) return {};
    constexpr Interval kCube{0.0, 1.0};
    return kept_of({&kCube, 1}, u, v, growth_m);
}

std::vector<Interval> RayColumns::kept_of(std::span<const Interval> uncut, double u, double v, double growth_m) const {
    const std::vector<Interval> all_gone = covered(u, v, growth_m);
    std::vector<Interval> rest;
    for (const Interval& piece : uncut) {
        double from = piece.lo;
        for (const Interval& gone : all_gone) {
            if (gone.hi <= piece.lo) continue;
            if (gone.lo > from) rest.push_back({from, std::min(gone.lo, piece.hi)});
            from = std::max(from, gone.hi);
            if (from >= piece.hi) break;
        }
        if (from < piece.hi) rest.push_back({from, piece.hi});
    }
    std::erase_if(rest, [](const Interval& i) { return i.lo >= i.hi; });
    return rest;
}

std::optional<Interval> through_cube(const Pose& object_from_cube, int axis, double u, double v, double growth_m) {
    const Quat cube_from_object = glm::conjugate(object_from_cube.orientation);
    Vec3 along_object(0.0);
    along_object[axis] = 1.0;
    const Vec3 along = cube_from_object * along_object;
    const Vec3 at = cube_from_object * (point_of(axis, u, v) - object_from_cube.position_m);
    Interval x{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (int a = 0; a < 3; ++a) {
        const double lo = -growth_m - at[a], hi = 1.0 + growth_m - at[a];
        if (along[a] == 0.0) {
            if (lo > 0.0 || hi < 0.0) return std::nullopt;
            continue;
        }
        x = {std::max(x.lo, std::min(lo / along[a], hi / along[a])),
             std::min(x.hi, std::max(lo / along[a], hi / along[a]))};
    }
    if (x.lo >= x.hi) return std::nullopt;
    return x;
}

double removed_volume_m3(std::span<const compute::BallSweep> sweeps, int rays_a_side) {
    const RayColumns columns(sweeps, 2, 0.0);
    const double width = 1.0 / rays_a_side;
    double removed = 0.0;
    for (int v = 0; v < rays_a_side; ++v) {
        double row = 0.0;  // summed row by row, to keep rounding errors small
        for (int u = 0; u < rays_a_side; ++u) {
            for (const Interval& gone : columns.covered((u + 0.5) * width, (v + 0.5) * width)) {
                row += std::max(0.0, std::min(gone.hi, 1.0) - std::max(gone.lo, 0.0));
            }
        }
        removed += row;
    }
    return removed * width * width;
}

std::uint64_t pieces_missing(std::span<const Interval> a, std::span<const Interval> b, double least) {
    std::uint64_t missing = 0;
    for (const Interval& piece : a) {
        double from = piece.lo;
        for (const Interval& other : b) {
            if (other.hi <= from) continue;
            if (other.lo >= piece.hi) break;
            if (other.lo - from > least) ++missing;
            from = std::max(from, other.hi);
        }
        if (piece.hi - from > least) ++missing;
    }
    return missing;
}

}  // namespace burin::bench

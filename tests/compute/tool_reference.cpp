// SPDX-License-Identifier: MIT
#include "tests/compute/tool_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace burin::compute::test {
namespace {

double segment_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 ab = b - a;
    const double length2 = glm::dot(ab, ab);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + t * ab));
}

// Of (distance from the axis, height) from a profile that is convex together with its mirror image.
double frustum_distance(const Vec2& p, double tip, double top, double low, double high) {
    const double radius = tip + (top - tip) * (p.y - low) / (high - low);
    const double outside =
        std::min({segment_distance(p, {tip, low}, {top, high}), segment_distance(p, {0, low}, {tip, low}),
                  segment_distance(p, {0, high}, {top, high})});
    return p.y >= low && p.y <= high && p.x <= radius ? -outside : outside;
}

struct SignedDistance {
    Vec3 p;
    [[nodiscard]] Vec2 profile() const { return {std::hypot(p.x, p.z), p.y}; }
    double operator()(const BallTool& t) const { return glm::length(p) - t.radius_m; }
    double operator()(const CylinderTool& t) const {
        return frustum_distance(profile(), t.radius_m, t.radius_m, 0.0, t.length_m);
    }
    double operator()(const ConeTool& t) const {
        return frustum_distance(profile(), t.tip_radius_m, t.top_radius_m, 0.0, t.length_m);
    }
    double operator()(const BullNoseTool& t) const {
        const Vec2 q = profile();
        const double rim = t.radius_m - t.corner_radius_m;
        // Below the corner's height the rounded disc, above it the cylinder; inside, whichever border is nearer.
        if (q.y < t.corner_radius_m) {
            const double rounded =
                segment_distance(q, {0, t.corner_radius_m}, {rim, t.corner_radius_m}) - t.corner_radius_m;
            return rounded <= 0.0 ? std::max(rounded, q.y - t.length_m) : rounded;
        }
        const double side = q.x - t.radius_m, top = q.y - t.length_m;
        if (side <= 0.0 && top <= 0.0) return std::max({side, top, -q.y});
        return std::hypot(std::max(side, 0.0), std::max(top, 0.0));
    }
    double operator()(const BoxTool& t) const {
        const Vec3 d = glm::abs(p) - t.half_size_m;
        return glm::length(glm::max(d, Vec3(0.0))) + std::min(std::max({d.x, d.y, d.z}), 0.0);
    }
    double operator()(const MeshTool&) const { return NAN; }
};

// Draws a tool of the same kind.
struct AnyOfKind {
    Random& random;
    double lo, hi;
    [[nodiscard]] double part() const { return random.between(lo, hi); }
    ToolShape operator()(const BallTool&) const { return BallTool{part()}; }
    ToolShape operator()(const CylinderTool&) const { return CylinderTool{part(), part()}; }
    ToolShape operator()(const ConeTool&) const {
        const double tip = random.chance(0.3) ? 0.0 : part();
        return ConeTool{tip, random.chance(0.2) && tip > 0.0 ? 0.0 : part(), part()};
    }
    ToolShape operator()(const BullNoseTool&) const {
        const double radius = part(), length = part(), corner = std::min(radius, length);
        return BullNoseTool{radius, random.chance(0.2) ? corner : corner * random.between(0.1, 1.0), length};
    }
    ToolShape operator()(const BoxTool&) const { return BoxTool{{part(), part(), part()}}; }
    ToolShape operator()(const MeshTool&) const { return MeshTool{}; }  // which every test would see refused
};

template <std::size_t... indices>
ToolShape shape_of_kind(int kind, std::index_sequence<indices...>) {
    const std::array<ToolShape, sizeof...(indices)> all{ToolShape(std::in_place_index<indices>)...};
    return all.at(static_cast<std::size_t>(kind));
}

constexpr double kGolden = 0.6180339887498949;

// The least value of a convex function on lo..hi, and where.
template <typename F>
std::pair<double, double> least(F f, double lo, double hi, int steps) {
    double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo), fa = f(a), fb = f(b);
    for (int i = 0; i < steps; ++i) {
        // On a flat part, where the tool is reached, any point will do.
        if (fa <= fb) {
            hi = b, b = a, fb = fa;
            fa = f(a = hi - kGolden * (hi - lo));
        } else {
            lo = a, a = b, fa = fb;
            fb = f(b = lo + kGolden * (hi - lo));
        }
    }
    return fa <= fb ? std::pair(a, fa) : std::pair(b, fb);
}

}  // namespace

double signed_distance(const ToolShape& shape, const Vec3& p_tool) { return std::visit(SignedDistance{p_tool}, shape); }

double distance_from_sweep(const ToolSweep& sweep, const Vec3& p_object) {
    const Quat tool_from_object = glm::conjugate(glm::normalize(sweep.start.orientation));
    const Vec3 along = sweep.end.position_m - sweep.start.position_m;
    const auto at = [&](double t) {
        const Vec3 p = tool_from_object * (p_object - (sweep.start.position_m + t * along));
        return std::max(0.0, signed_distance(sweep.shape, p));
    };
    double best = std::min(at(0.0), at(1.0));
    if (best > 0.0 && along != Vec3(0.0)) best = std::min(best, least(at, 0.0, 1.0, 60).second);
    return best;
}

Pose pose_at(const ToolSweep& sweep, double share) {
    const Quat from = glm::normalize(sweep.start.orientation);
    Quat to = glm::normalize(sweep.end.orientation);
    if (glm::dot(from, to) < 0.0) to = -to;
    const double cosine = std::min(1.0, glm::dot(from, to)), angle = std::acos(cosine);
    const Quat turned =
        angle < 1e-9 ? from : (from * std::sin((1 - share) * angle) + to * std::sin(share * angle)) / std::sin(angle);
    return {sweep.start.position_m + share * (sweep.end.position_m - sweep.start.position_m), turned};
}

// From one pose to the next the place moves, as the tool sees it, by no more than the tool's own way and the arc of its
// turn, and its distance changes by no more than that. So poses that cannot be the nearest are passed by.
double signed_distance_from_poses(const ToolSweep& sweep, const Vec3& p_object, int poses) {
    const Vec3 way = sweep.end.position_m - sweep.start.position_m;
    const double farthest =
        std::max(glm::length(p_object - sweep.start.position_m), glm::length(p_object - sweep.end.position_m));
    const double cosine =
        std::abs(glm::dot(glm::normalize(sweep.start.orientation), glm::normalize(sweep.end.orientation)));
    const double angle = 2.0 * std::acos(std::min(1.0, cosine));
    const double step = (glm::length(way) + angle * farthest) / poses;
    double best = 1e300;
    for (int i = 0; i <= poses;) {
        const Pose pose = pose_at(sweep, static_cast<double>(i) / poses);
        const double here =
            signed_distance(sweep.shape, glm::conjugate(pose.orientation) * (p_object - pose.position_m));
        best = std::min(best, here);
        const double passed_by = step > 0.0 ? std::floor((here - best) / step) : poses;
        i += std::max(1, static_cast<int>(std::min<double>(passed_by, poses)));
    }
    return best;
}

ReferenceSpan reference_span(const Lattice& lattice, const ToolSweep& sweep, int axis, int u, int v) {
    const double deepest = lattice.cells[static_cast<std::size_t>(axis)] * double(shared::kUnitsPerCell);
    const auto distance = [&](double s) {
        Vec3 units;
        units[axis] = s;
        units[(axis + 1) % 3] = u * double(shared::kUnitsPerCell);
        units[(axis + 2) % 3] = v * double(shared::kUnitsPerCell);
        return distance_from_sweep(sweep, lattice.object_from_units(units)) / lattice.unit_m();
    };
    // Beyond the lattice as well, so that a tool half outside still has its own two ends.
    const auto [at, clearance] = least(distance, -2.0 * deepest, 3.0 * deepest, 75);
    ReferenceSpan span;
    span.clearance = clearance;
    span.misses = clearance > 1e-6;
    if (span.misses) return span;
    const auto border = [&](double inside, double outside) {
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (inside + outside);
            (distance(middle) <= 1e-6 ? inside : outside) = middle;
        }
        return inside;
    };
    span.lo = border(at, -2.0 * deepest);
    span.hi = border(at, 3.0 * deepest);
    return span;
}

Quat any_orientation(Random& random) {
    for (;;) {
        const Quat q(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        if (glm::dot(q, q) > 0.1) return glm::normalize(q);
    }
}

ToolShape any_shape(Random& random, double lo, double hi, int kind) {
    return std::visit(AnyOfKind{random, lo, hi}, shape_of_kind(kind, std::make_index_sequence<kDrawnKinds>()));
}

}  // namespace burin::compute::test

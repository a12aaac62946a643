// SPDX-License-Identifier: MIT
#include "haptics/contact/touching.hpp"

#include <algorithm>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

// Slack of the broad phase around a segment, as fractions of the ball's radius, of an edge and of the segment's length:
// enough that most ticks need one search.
constexpr double kBesideOfRadius = 0.001, kBesideOfEdge = 0.02, kBesideOfWay = 0.12;
// A motion deep into the material usually ends at its surface: the first broad phase covers at most this length, each
// later one twice as much.
constexpr double kFirstLookOfRadius = 2.0, kFirstLookOfEdge = 8.0;

// Whether the ball around the triangle's bounding box is farther than `reach` from the whole segment: a cheap test
// before the exact one.
bool beside(const geometry::Triangle& t, const Way& way, double reach) {
    const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
    const double limit = reach + 0.5 * glm::length(hi - lo) * (1.0 + 1e-9);
    return distance2(way, 0.5 * (lo + hi)) > limit * limit;
}

}  // namespace

bool ContactSearch::broad_phase(const Way& way) noexcept {
    const Vec3 motion = way.to - way.from;
    const double edge = surface_.mean_edge_m(), length = glm::length(motion);
    const double most = std::ldexp(kFirstLookOfRadius * radius_ + kFirstLookOfEdge * edge, looks_taken_++);
    double share = length > most ? most / length : 1.0;
    double slack = kBesideOfRadius * radius_ + kBesideOfEdge * edge + kBesideOfWay * share * length;
    for (int tries = 0; tries < 6; ++tries) {
        std::uint32_t looks = budget_.max_triangles_seen - work_.triangles_seen;
        const std::uint32_t before = looks;
        const auto found = candidates_.gather(surface_, {way.from, way.from + share * motion}, radius_, slack, looks);
        work_.triangles_seen += before - looks;
        for (std::uint32_t i = 0; i < candidates_.count(); ++i) touches_already_.put(i, false);
        if (found == Candidates::Gathered::all) return true;
        if (found == Candidates::Gathered::out_of_looks) return false;
        share *= 0.25;
        slack *= 0.25;
    }
    return false;
}

double ContactSearch::known_share(const Vec3& center, const Vec3& motion) const noexcept {
    double share = 1.0;  // the covered region is convex, so a covered end point covers the whole segment
    for (int halvings = 0; halvings < 20; ++halvings, share *= 0.5)
        if (knows(center + share * motion)) return share;
    return 0.0;
}

// Of triangles that share the nearest point, the one seen most squarely decides between inside and outside: at a sharp
// edge the other may be seen from its back although the point is outside.
void ContactSearch::keep_nearest(Nearest& best, const Nearest& other) const noexcept {
    const double tie = kTie * radius_;
    if (other.distance < best.distance - tie ||
        (other.distance <= best.distance + tie && std::abs(other.height) > std::abs(best.height)))
        best = other;
}

ContactSearch::Touching ContactSearch::touching(const Vec3& center, Touches& touches) noexcept {
    Touching result;
    for (std::uint32_t i = 0; i < touches.count;
         ++i)  // candidates of earlier broad phases too; clearing a flag twice does no harm
        if (const std::uint32_t candidate = touches.places[i].candidate; candidate < candidates_.count())
            touches_already_[candidate] = false;
    touches.count = 0;
    const double reach = radius_ * (1.0 + kTouch);
    result.complete = candidates_.for_each_at(center, reach, [&](std::uint32_t i) {
        if (!count_test()) return false;
        const geometry::Triangle& t = candidates_.triangle(i);
        const NearestOnTriangle on = nearest_on_triangle(center, t);
        const Vec3 off = center - on.point;
        if (glm::dot(off, off) > reach * reach) return true;
        const double distance = std::sqrt(glm::dot(off, off));
        const Vec3 normal = outward_normal(t);
        const double height = glm::dot(off, normal);
        keep_nearest(result.nearest, {distance, height, on.point, normal});
        if (height < 0.0) return true;
        if (touches.count == Touches::kMost) return false;
        const bool flat = on.on_face || distance < kTie * radius_;
        touches.planes.put(touches.count, {flat ? normal : off / distance,
                                           radius_ * (flat ? 1.0 : 1.0 - kTouch) - distance, candidates_.id(i)});
        touches.places.put(touches.count++, {on.point, i, flat});
        touches_already_[i] = true;
        return true;
    });
    return result;
}

ContactSearch::Sweep ContactSearch::sweep(const Vec3& center, const Vec3& motion) noexcept {
    Sweep result;
    const double radius = radius_ * (1.0 - 2.0 * kTouch);
    const Way way{center, center + motion};
    result.complete = candidates_.for_each_on_way(way, radius, [&](std::uint32_t i) {
        if (touches_already_[i]) return true;
        const geometry::Triangle& t = candidates_.triangle(i);
        if (!count_test()) return false;
        result.fraction = std::min(result.fraction, fraction_until_touch(center, motion, radius, t));
        return true;
    });
    return result;
}

Nearest ContactSearch::nearest(const Vec3& center, double most) noexcept {
    Nearest result;
    geometry::Near near{.lo = center, .hi = center, .by_way = true, .from = center, .to = center};
    const auto visit = [&](std::uint32_t, const geometry::Triangle& t) {
        if (beside(t, {center, center}, result.distance * (1.0 + kTie))) return true;
        if (!count_test()) return false;
        const NearestOnTriangle on = nearest_on_triangle(center, t);
        const Vec3 off = center - on.point, normal = outward_normal(t);
        keep_nearest(result, {std::sqrt(glm::dot(off, off)), glm::dot(off, normal), on.point, normal});
        near.reach_m = std::min(near.reach_m, result.distance * (1.0 + kTie));
        return true;
    };
    const Box all = geometry::bounds(surface_);
    const Vec3 span = glm::max(glm::abs(center - all.lo), glm::abs(center - all.hi));
    const double everything = std::min(most, std::max({span.x, span.y, span.z}));
    // Starts a little above the radius: after a cut the surface is just out of contact.
    for (double reach = std::max(1.1 * radius_, 2.0 * surface_.mean_edge_m());; reach *= 2.0) {
        near.reach_m = reach;
        const std::uint32_t looks = budget_.max_triangles_seen - work_.triangles_seen;
        near.looks_left = looks;
        const bool complete = geometry::for_each_triangle_near(surface_, near, visit);
        work_.triangles_seen += looks - near.looks_left;
        if (!complete) return {};
        if (result.distance <= reach || reach >= everything) return result;
    }
}

bool ContactSearch::sees_backs(const Vec3& center, double reach) noexcept {
    double sum = 0.0;
    geometry::Near near{.lo = center, .hi = center, .reach_m = reach, .by_way = true, .from = center, .to = center};
    const std::uint32_t looks = budget_.max_triangles_seen - work_.triangles_seen;
    near.looks_left = looks;
    const bool complete =
        geometry::for_each_triangle_near(surface_, near, [&](std::uint32_t, const geometry::Triangle& t) {
            sum += solid_angle_tangent(center, t);
            return true;
        });
    work_.triangles_seen += looks - near.looks_left;
    return complete && sum > 0.0;
}

}  // namespace burin::haptics

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

// Where the tick's work does not suffice the ball touches vertices of surfaces with edges longer by this factor, at
// each try: after five of them up to 0.43 of the radius, where it sinks in by 3 % on an even mesh. With a stride, which
// leaves vertices out, it sinks in farther: 10 % of the radius have been seen on a scan at 2 m/s.
constexpr double kCoarser = 1.2;
// Greatest stride among the vertices. Beyond it a look skips whole patches of a mesh without costing less. Unbounded,
// it would overflow to 0 after some ticks without enough budget, and a look with stride 0 never comes to an end.
constexpr std::uint32_t kMostStride = 1024;

// Whether the ball around the triangle's bounding box is farther than `reach` from the whole segment: a cheap test
// before the exact one.
bool beside(const geometry::Triangle& t, const Way& way, double reach) {
    const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
    const double limit = reach + 0.5 * glm::length(hi - lo) * (1.0 + 1e-9);
    return distance2(way, 0.5 * (lo + hi)) > limit * limit;
}

// How many times this cost can be paid.
std::uint32_t times(double allowed_ns, double cost_ns) {
    return static_cast<std::uint32_t>(std::clamp(allowed_ns / cost_ns, 0.0, 4e9));
}

}  // namespace

bool ContactSearch::broad_phase(const Way& way) noexcept {
    const Vec3 motion = way.to - way.from;
    const double edge = surface_.mean_edge_m(), length = glm::length(motion);
    const double most = std::ldexp(kFirstLookOfRadius * radius_ + kFirstLookOfEdge * edge, looks_taken_++);
    double share = length > most ? most / length : 1.0;
    double slack = kBesideOfRadius * radius_ + kBesideOfEdge * edge + kBesideOfWay * share * length;
    constexpr int kMostTries = 6;
    for (int tries = 1; tries <= kMostTries; ++tries) {
        // A part of what is left for each try, so that a lesser one is still possible. It goes into looks, triangles
        // and vertices, for half of it each: of the last try, too, all three together cost no more than is left.
        const double allowed_ns = (tries < kMostTries ? 0.4 : 0.6) * left_ns();
        const std::uint32_t most_looks = times(0.5 * allowed_ns, WorkCost::kLook_ns);
        std::uint32_t looks_left = most_looks;
        Candidates::Query query{{way.from, way.from + share * motion}, radius_, slack, fineness_};
        query.most_triangles = std::min(times(0.5 * allowed_ns, WorkCost::kGathered_ns), Candidates::kMost);
        query.most_points = std::min(times(0.5 * allowed_ns, WorkCost::kPoint_ns), Candidates::kMost);
        const auto found = candidates_.gather(surface_, query, looks_left);
        work_.triangles_seen += most_looks - looks_left;
        work_.gathered += candidates_.triangles();
        work_.points += candidates_.points();
        fours_before_ = work_.fours_measured;
        std::fill_n(touches_already_.begin(), candidates_.triangles(), false);
        std::fill_n(touches_already_.begin() + Candidates::kMost, candidates_.points(), false);
        was_coarse_ = was_coarse_ || found != Candidates::Gathered::all || fineness_.stride > 1;
        if (found == Candidates::Gathered::all) return true;
        // Over a shorter way, and more coarsely.
        share *= 0.25;
        slack *= 0.25;
        fineness_.longest_edge_m *= kCoarser;
        if (found != Candidates::Gathered::too_many_triangles)
            fineness_.stride = std::min(2 * fineness_.stride, kMostStride);
    }
    return false;
}

bool ContactSearch::count_fours_and_test() noexcept {
    count_fours();
    if (left_ns() < WorkCost::kTest_ns) return false;
    ++work_.triangles_tested;
    bound_fours();
    return true;
}

void ContactSearch::bound_fours() noexcept { candidates_.measure_at_most(times(left_ns(), WorkCost::kFour_ns)); }

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

void ContactSearch::add(Touches& touches, const HalfSpace& plane, const Touches::Place& place) noexcept {
    touches.planes.put(touches.count, plane);
    touches.places.put(touches.count++, place);
    touches_already_[place.candidate] = true;
}

bool ContactSearch::touch_triangle(std::uint32_t candidate, const Vec3& center, Touching& result,
                                   Touches& touches) noexcept {
    const double reach = radius_ * (1.0 + kTouch);
    const geometry::Triangle& t = candidates_.triangle(candidate);
    const NearestOnTriangle on = nearest_on_triangle(center, t);
    const Vec3 off = center - on.point;
    if (glm::dot(off, off) > reach * reach) return true;
    const double distance = std::sqrt(glm::dot(off, off));
    Vec3 normal = outward_normal(t);
    double height = glm::dot(off, normal);
    const bool from_back = height < 0.0 && candidates_.two_sided(candidate);
    if (from_back) normal = -normal, height = -height;
    keep_nearest(result.nearest, {distance, height, on.point, normal});
    if (height < 0.0) return true;
    const bool flat = on.on_face || distance < kTie * radius_;
    add(touches, {flat ? normal : off / distance, radius_ * (flat ? 1.0 : 1.0 - kTouch) - distance},
        {on.point, candidate, flat, from_back});
    return true;
}

bool ContactSearch::touch_point(std::uint32_t candidate, const Vec3& center, Touching& result,
                                Touches& touches) noexcept {
    const double reach = radius_ * (1.0 + kTouch);
    const geometry::SurfacePoint& point = candidates_.point(candidate);
    const Vec3 off = center - point.position, normal = point.normal();
    const double distance2 = glm::dot(off, off);
    if (distance2 > reach * reach || distance2 == 0.0) return true;
    const double distance = std::sqrt(distance2), height = glm::dot(off, normal);
    keep_nearest(result.nearest, {distance, height, point.position, normal});
    if (height < 0.0) return true;
    add(touches, {off / distance, radius_ * (1.0 - kTouch) - distance}, {point.position, candidate, false, false});
    return true;
}

ContactSearch::Touching ContactSearch::touching(const Vec3& center, Touches& touches) noexcept {
    Touching result;
    for (std::uint32_t i = 0; i < touches.count; ++i)  // those of earlier broad phases too; clearing twice does no harm
        touches_already_[touches.places[i].candidate] = false;
    touches.count = 0;
    bound_fours();
    result.complete = candidates_.for_each_at(center, radius_ * (1.0 + kTouch), [&](std::uint32_t candidate) {
        if (Candidates::is_point(candidate)) return touch_point(candidate, center, result, touches);
        return count_fours_and_test() && touch_triangle(candidate, center, result, touches);
    });
    count_fours();
    return result;
}

ContactSearch::Sweep ContactSearch::sweep(const Vec3& center, const Vec3& motion) noexcept {
    Sweep result;
    const double radius = radius_ * (1.0 - 2.0 * kTouch);
    const Way way{center, center + motion};
    bound_fours();
    result.complete = candidates_.for_each_on_way(way, radius, [&](std::uint32_t candidate) {
        if (touches_already_[candidate]) return true;
        double fraction = 0.0;
        if (Candidates::is_point(candidate)) {
            const geometry::SurfacePoint& point = candidates_.point(candidate);
            fraction = fraction_until_touch(center, motion, radius, point.position, point.normal());
        } else {
            if (!count_fours_and_test()) return false;
            const geometry::Triangle& t = candidates_.triangle(candidate);
            const bool from_back =
                candidates_.two_sided(candidate) && glm::dot(center - t.a, glm::cross(t.b - t.a, t.c - t.a)) < 0.0;
            fraction = fraction_until_touch(center, motion, radius, from_back ? geometry::Triangle{t.a, t.c, t.b} : t);
        }
        result.fraction = std::min(result.fraction, fraction);
        return true;
    });
    count_fours();
    return result;
}

std::uint32_t ContactSearch::triangle_at(const Vec3& vertex) const noexcept {
    std::uint32_t found = ProxyResult{}.active_triangle;
    geometry::for_each_triangle_around(surface_, vertex, [&](std::uint32_t id, const geometry::Triangle&) {
        found = id;
        return false;
    });
    return found;
}

Nearest ContactSearch::nearest(const Vec3& center, double most) noexcept {
    Nearest result;
    const Box all = geometry::bounds(surface_);
    const Vec3 span = glm::max(glm::abs(center - all.lo), glm::abs(center - all.hi));
    const double everything = std::min(most, std::max({span.x, span.y, span.z}));
    // Starts a little above the radius: after a cut the surface is just out of contact.
    for (double reach = std::max(1.1 * radius_, 2.0 * surface_.mean_edge_m());; reach *= 2.0) {
        if (!keep_nearest_within(result, center, reach)) return {};
        if (result.distance <= reach || reach >= everything) return result;
    }
}

// Returns false when the tick's work budget is used up.
bool ContactSearch::keep_nearest_within(Nearest& best, const Vec3& center, double reach) noexcept {
    geometry::Near near{.lo = center, .hi = center, .reach_m = reach, .by_way = true, .from = center, .to = center};
    SearchWork paid(left_ns(), UINT32_MAX, near.looks_left);
    const bool complete =
        geometry::for_each_triangle_near(surface_, near, [&](std::uint32_t id, const geometry::Triangle& t) {
            if (beside(t, {center, center}, best.distance * (1.0 + kTie))) return true;
            if (!paid.pay_test()) return false;
            const NearestOnTriangle on = nearest_on_triangle(center, t);
            const Vec3 off = center - on.point;
            Vec3 normal = outward_normal(t);
            if (glm::dot(off, normal) < 0.0 && surface_.two_sided(id)) normal = -normal;
            keep_nearest(best, {std::sqrt(glm::dot(off, off)), glm::dot(off, normal), on.point, normal});
            near.reach_m = std::min(near.reach_m, best.distance * (1.0 + kTie));
            return true;
        });
    work_.triangles_tested += paid.tests();
    work_.triangles_seen += paid.looks();
    return complete;
}

bool ContactSearch::sees_backs(const Vec3& center, double reach) noexcept {
    double sum = 0.0;
    geometry::Near near{.lo = center, .hi = center, .reach_m = reach, .by_way = true, .from = center, .to = center};
    const std::uint32_t most_looks = near.looks_left = times(left_ns(), WorkCost::kLook_ns);
    const bool complete =
        geometry::for_each_triangle_near(surface_, near, [&](std::uint32_t id, const geometry::Triangle& t) {
            if (!surface_.two_sided(id)) sum += solid_angle_tangent(center, t);
            return true;
        });
    work_.triangles_seen += most_looks - near.looks_left;
    return complete && sum > 0.0;
}

}  // namespace burin::haptics

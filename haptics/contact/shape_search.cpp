// SPDX-License-Identifier: MIT
#include "haptics/contact/shape_search.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

// Edges up to this share of the tool's width are touched by their vertices alone: between two of them a corner of the
// tool sinks in by about a third of the edge.
constexpr double kFineOfSize = 0.1;
constexpr double kCoarserLook = 1.5;
constexpr std::uint32_t kGreatestStride = 1024;
constexpr int kMostLooksAround = 6;
// Of the rounding: how exactly a gap is found, and by how much a face's own plane may lie nearer than the best one.
constexpr double kExact = 1e-3, kOwnPlane = 2e-3;
// A triangle faces the tool where its normal and the plane's have at least this cosine; edges lie square to the plane.
constexpr double kFaces = -0.02;
constexpr int kMostApproaches = 12;

std::uint32_t as_many(double allowed_ns, double each_ns) {
    return static_cast<std::uint32_t>(std::clamp(allowed_ns / each_ns, 0.0, 4e9));
}

}  // namespace

ShapeSearch::ShapeSearch(const ToolShape& shape, const geometry::PosedSurface& surface, const ProxyBudget& budget,
                         ContactWork& work) noexcept
    : shape_(shape),
      surface_(surface),
      budget_(budget),
      work_(work),
      rounding_(shape.rounding_m),
      fineness_{kFineOfSize * shape.size_m, 1} {}

void ShapeSearch::turn_to(const Quat& object_from_tool) noexcept {
    const glm::dmat3 before = turn_;
    turn_ = glm::mat3_cast(object_from_tool);
    gathered_at_ = (before * gathered_at_) * turn_;
    touched_at_ = (before * touched_at_) * turn_;
    for (std::uint32_t i = 0; i < count_; ++i) {
        Candidate& c = candidates_[i];
        const geometry::Triangle& t = in_object_[i];
        c.triangle = {t.a * turn_, t.b * turn_, t.c * turn_};
        c.face = faces_in_object_[i] * turn_;
        c.height = glm::dot(c.face, c.triangle.a);
        c.guess = (before * c.guess) * turn_;
        c.clear_until_m = -HUGE_VAL;
    }
}

void ShapeSearch::add(const geometry::Triangle& object, const Vec3& normal, std::uint32_t id, bool is_vertex) noexcept {
    Candidate c;
    c.triangle = {object.a * turn_, object.b * turn_, object.c * turn_};
    c.face = normal * turn_;
    c.height = glm::dot(c.face, c.triangle.a);
    c.is_vertex = is_vertex;
    c.two_sided = !is_vertex && surface_.two_sided(id);
    const Vec3 middle = (c.triangle.a + c.triangle.b + c.triangle.c) / 3.0;
    c.guess = gathered_at_ + shape_.inside_m - middle;
    c.clear_until_m = -HUGE_VAL;
    in_object_.put(count_, object);
    faces_in_object_.put(count_, normal);
    ids_[count_] = id;
    candidates_.put(count_++, c);
}

bool ShapeSearch::look(const Vec3& at, double slack) noexcept {
    count_ = plane_count_ = 0;
    gathered_at_ = at;
    const Vec3 extent = shape_.bounds.extent(), middle = at + shape_.bounds.center();
    const int longest = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    Vec3 half(0.0), across = 0.5 * extent;
    half[longest] = across[longest];
    across[longest] = 0.0;
    const double reach = glm::length(across) + slack;
    const Vec3 lo = at + shape_.bounds.lo - slack, hi = at + shape_.bounds.hi + slack;
    const Vec3 from = from_tool(middle - half), to = from_tool(middle + half);
    const auto left = [&] { return std::max(0.5 * left_ns(), 0.0); };
    geometry::Near near{
        glm::min(from, to), glm::max(from, to), reach, as_many(left(), WorkCost::kLook_ns), true, from, to};
    const std::uint32_t most_looks = near.looks_left;
    const std::uint32_t most = std::min(kMost, as_many(left(), WorkCost::kGathered_ns + 4.0 * WorkCost::kSupport_ns));
    const auto is_beside = [&](const Vec3& low, const Vec3& high) {
        return low.x > hi.x || low.y > hi.y || low.z > hi.z || high.x < lo.x || high.y < lo.y || high.z < lo.z;
    };
    const auto add_triangle = [&](std::uint32_t id, const geometry::Triangle& t) {
        const Vec3 a = to_tool(t.a), b = to_tool(t.b), c = to_tool(t.c);
        if (is_beside(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c))) return true;
        if (count_ == most) return false;
        add(t, outward_normal(t), id, false);
        return true;
    };
    const auto add_vertex = [&](const geometry::SurfacePoint& point) {
        const Vec3 p = to_tool(point.position);
        if (is_beside(p, p)) return true;
        if (count_ == most) return false;
        add({point.position, point.position, point.position}, point.normal(), kNoId, true);
        return true;
    };
    const bool complete =
        geometry::for_each_near(surface_, near, geometry::MixedVisitor{add_triangle, add_vertex, fineness_});
    work_.triangles_seen += most_looks - near.looks_left;
    work_.gathered += count_;
    return complete;
}

bool ShapeSearch::gather(const Vec3& at, double slack) noexcept {
    slack_ = 0.0;
    travel_ = 0.0;
    touched_at_ = at;
    for (int tries = 0; tries < kMostLooksAround; ++tries) {
        if (left_ns() <= 0.0) return false;
        if (look(at, rounding_ + slack)) {
            slack_ = slack;
            return true;
        }
        slack = std::max(0.5 * slack, 0.1 * rounding_);
        fineness_.longest_edge_m *= kCoarserLook;
        if (tries > 1) fineness_.stride = std::min(2 * fineness_.stride, kGreatestStride);
    }
    return false;
}

std::uint32_t ShapeSearch::triangle(std::uint32_t plane) const noexcept {
    std::uint32_t found = ids_[owners_[plane]];
    if (found != kNoId) return found;
    geometry::for_each_triangle_around(surface_, in_object_[owners_[plane]].a,
                                       [&](std::uint32_t id, const geometry::Triangle&) {
                                           found = id;
                                           return false;
                                       });
    return found;
}

// The nearest of the tool's pieces.
Separation ShapeSearch::from(Candidate& c, const Vec3& at, double matters_m) noexcept {
    Separation nearest;
    nearest.gap_m = HUGE_VAL;
    for (std::uint32_t i = 0; i < shape_.piece_count; ++i) {
        const Vec3 guess = glm::dot(c.guess, c.guess) > 0.0 ? c.guess : Vec3(0.0, 1.0, 0.0);
        const Separation found = separation(shape_, shape_.pieces[i], c.triangle,
                                            {at, guess, std::min(matters_m, nearest.gap_m), kExact * rounding_});
        work_.supports += found.supports;
        if (found.overlaps) return found;
        if (found.gap_m < nearest.gap_m) nearest = found;
    }
    if (shape_.piece_count == 1) c.guess = nearest.normal, c.guessed = true;
    return nearest;
}

// The tool's height above the triangle's plane.
double ShapeSearch::above(const Candidate& c, const Vec3& at) noexcept {
    double least = HUGE_VAL;
    for (std::uint32_t i = 0; i < shape_.piece_count; ++i)
        least = std::min(least, lowest(shape_, shape_.pieces[i], c.face));
    work_.supports += shape_.piece_count;
    return least + glm::dot(c.face, at) - c.height;
}

// The plane beyond which the tool is out of a triangle that overlaps its hull: along the direction in which the two
// were apart before, along the triangle's normal, or away from the tool's middle, whichever is the shortest way.
HalfSpace ShapeSearch::way_out(const Candidate& c, const Vec3& at) noexcept {
    const geometry::Triangle& t = c.triangle;
    HalfSpace least{Vec3(0.0, 1.0, 0.0), HUGE_VAL};
    for (const Vec3& along : {c.guess, c.face, at + shape_.inside_m - (t.a + t.b + t.c) / 3.0}) {
        const double length = glm::length(along);
        if (!(length > 0.0)) continue;
        const Vec3 n = along / length;
        double low = HUGE_VAL;
        for (std::uint32_t i = 0; i < shape_.piece_count; ++i) low = std::min(low, lowest(shape_, shape_.pieces[i], n));
        work_.supports += shape_.piece_count;
        const double top = std::max({glm::dot(n, t.a), glm::dot(n, t.b), glm::dot(n, t.c)});
        const double needed = top + rounding_ - low - glm::dot(n, at);
        if (needed < least.offset) least = {n, needed};
    }
    return least;
}

// By how much the tool is surely farther than the reach, by its bounds or by the triangle's own plane; 0: it may be
// nearer.
double ShapeSearch::surely_clear_m(Candidate& c, const Vec3& at, double reach) noexcept {
    const geometry::Triangle& t = c.triangle;
    const Vec3 low = glm::min(glm::min(t.a, t.b), t.c) - at, high = glm::max(glm::max(t.a, t.b), t.c) - at;
    const Vec3 off = glm::max(glm::max(low - shape_.bounds.hi, shape_.bounds.lo - high), Vec3(0.0));
    const double beside2 = glm::dot(off, off), beyond = reach - rounding_;  // the bounds are those of the rounded hulls
    if (beside2 > beyond * beyond) return std::sqrt(beside2) - beyond;
    if (c.is_vertex || c.two_sided) return 0.0;
    const double height = above(c, at);
    if (height > 0.0 && !c.guessed) c.guess = c.face;
    return std::max(height - reach, 0.0);
}

bool ShapeSearch::faces(const Candidate& c, const Vec3& normal) const noexcept {
    return c.two_sided || glm::dot(c.face, normal) >= kFaces || c.face == Vec3(0.0);
}

void ShapeSearch::put_plane(std::uint32_t candidate, const HalfSpace& plane, const Vec3& touched) noexcept {
    owners_[plane_count_] = candidate;
    touched_.put(plane_count_, touched);
    planes_.put(plane_count_++, plane);
    touches_[candidate] = true;
    sunk_m_ = std::max(sunk_m_, plane.offset);
}

bool ShapeSearch::touch(const Vec3& at) noexcept {
    travel_ += glm::length(at - touched_at_);
    touched_at_ = at;
    plane_count_ = 0;
    overlaps_ = false;
    sunk_m_ = 0.0;
    const double reach = rounding_ * (1.0 + kReached);
    for (std::uint32_t i = 0; i < count_; ++i) {
        Candidate& c = candidates_[i];
        touches_[i] = false;
        if (c.clear_until_m > travel_) continue;
        if (left_ns() <= 0.0) return false;
        if (const double clear_m = surely_clear_m(c, at, reach); clear_m > 0.0) {
            c.clear_until_m = travel_ + clear_m;
            continue;
        }
        ++work_.triangles_tested;
        const Separation s = from(c, at, reach);
        if (s.overlaps) {
            const HalfSpace out = way_out(c, at);
            overlaps_ = true;
            c.clear_until_m = -HUGE_VAL;
            put_plane(i, out, c.triangle.a);
            continue;
        }
        c.clear_until_m = travel_ + s.gap_m - reach;
        if (s.gap_m > reach || !faces(c, s.normal)) continue;
        c.clear_until_m = -HUGE_VAL;
        HalfSpace plane{s.normal, rounding_ * (1.0 - kEdge) - s.gap_m};
        if (!c.is_vertex && std::abs(glm::dot(c.face, s.normal)) > 0.99) {
            const double side = glm::dot(c.face, s.normal) < 0.0 ? -1.0 : 1.0;
            const double height = side > 0.0 ? above(c, at) : -HUGE_VAL;
            if (height >= s.gap_m - kOwnPlane * rounding_) plane = {c.face, rounding_ - height};
        }
        put_plane(i, plane, s.on_triangle);
    }
    return true;
}

// The share of the step after which this triangle is touched; beyond 1: it is not.
double ShapeSearch::until(Candidate& c, const Vec3& at, const Vec3& step) noexcept {
    const double stop = rounding_ * (1.0 - 2.0 * kEdge);
    if (!c.is_vertex && !c.two_sided) {
        const double height = above(c, at);
        if (height >= stop && height + glm::dot(c.face, step) >= stop) return kNoTouch;
    }
    double share = 0.0;
    for (int i = 0; i < kMostApproaches; ++i) {
        const Separation s = from(c, at + share * step, HUGE_VAL);
        if (s.overlaps) return share;
        if (!faces(c, s.normal)) return kNoTouch;
        const double nearer = -glm::dot(s.normal, step);
        if (!(nearer > 0.0)) return kNoTouch;
        if (s.gap_m <= rounding_) return share;
        share += (s.gap_m - stop) / nearer;
        if (share >= 1.0) return kNoTouch;
    }
    return share;
}

ShapeSearch::Sweep ShapeSearch::sweep(const Vec3& at, const Vec3& step) noexcept {
    Sweep result;
    const double length = glm::length(step);
    for (std::uint32_t i = 0; i < count_; ++i) {
        if (touches_[i]) continue;
        Candidate& c = candidates_[i];
        if (c.clear_until_m > travel_ + result.fraction * length) continue;
        if (left_ns() <= 0.0) return {0.0, false};
        ++work_.triangles_tested;
        result.fraction = std::min(result.fraction, until(c, at, result.fraction * step) * result.fraction);
    }
    return result;
}

}  // namespace burin::haptics

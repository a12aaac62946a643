// SPDX-License-Identifier: MIT
// The broad phase of a tool's shape: what it may touch near where it is.
#include <algorithm>
#include <cmath>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/shape_search.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

// Edges up to this share of the tool's width are touched by their vertices alone: between two of them a corner of the
// tool sinks in by about a third of the edge.
constexpr double kFineOfSize = 0.1;
constexpr double kCoarserLook = 1.5;
constexpr std::uint32_t kGreatestStride = 1024, kCoarserStride = 3;
constexpr int kMostLooksAround = 6;
// Faces are held beyond so many candidates; where vertices stand for triangles, at once.
constexpr std::uint32_t kHoldAt = 48, kHoldAtIfFine = 2;
// Of the work left: what a look for faces to be held may take, of looks and of tests.
constexpr double kOfWorkAround = 0.05;
// Cosine of normals that are alike.
constexpr double kAlikeNormals = 1.0 - 1e-8, kAlikeNormalsDiffer = 1.5e-4;
// Of the rounding: a gathering that covers less is of no use.
constexpr double kLeastSlack = 0.05;

}  // namespace

ShapeSearch::Candidate ShapeSearch::candidate_of(const geometry::Triangle& object, const Vec3& normal, std::uint32_t id,
                                                 bool is_vertex) const noexcept {
    Candidate c;
    c.triangle = {object.a * turn_, object.b * turn_, object.c * turn_};
    c.face = normal * turn_;
    c.height = glm::dot(c.face, c.triangle.a);
    c.is_vertex = is_vertex;
    c.two_sided = !is_vertex && surface_.two_sided(id);
    const Vec3 middle = (c.triangle.a + c.triangle.b + c.triangle.c) / 3.0;
    c.guess = gathered_at_ + shape_.inside_m - middle;
    c.clear_until_m = -HUGE_VAL;
    return c;
}

void ShapeSearch::add(const geometry::Triangle& object, const Vec3& normal, std::uint32_t id, bool is_vertex) noexcept {
    in_object_.put(count_, object);
    faces_in_object_.put(count_, normal);
    ids_[count_] = id;
    candidates_.put(count_++, candidate_of(object, normal, id, is_vertex));
}

bool ShapeSearch::is_behind_held(const geometry::Triangle& t) noexcept {
    const double allowed = kEdge * rounding_;
    for (std::uint32_t k = 0; k < held_count_; ++k) {
        const Vec3& n = faces_in_object_[k];
        if (std::max({glm::dot(n, t.a), glm::dot(n, t.b), glm::dot(n, t.c)}) <= held_tops_[k] + allowed) return true;
    }
    return false;
}

// Whether a box is farther than the reach from a tool that is turned about its axis. Box bounds of a cone are wide.
bool ShapeSearch::is_around(const Vec3& low, const Vec3& high, double reach) const noexcept {
    if (shape_.piece_count != 1 || !shape_.pieces[0].turned) return false;
    const double x = std::max({low.x, -high.x, 0.0}), z = std::max({low.z, -high.z, 0.0});
    const double from = low.y - reach, to = high.y + reach;
    // The outline is convex, so between two heights it is widest at one of its corners or at one of the two.
    double widest = 0.0;
    const std::span<const Vec3> outline = shape_.corners_of(shape_.pieces[0]);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3& a = outline[i];
        if (a.y >= from && a.y <= to) widest = std::max(widest, a.x);
        if (i + 1 == outline.size()) break;
        const Vec3& b = outline[i + 1];
        for (const double y : {from, to})
            if ((a.y - y) * (b.y - y) < 0.0) widest = std::max(widest, a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
    const double away = widest + reach;
    return x * x + z * z > away * away;
}

// Whether the tool is farther than the reach above the plane behind which the triangles lie.
bool ShapeSearch::is_above(const geometry::TriangleSlab& slab, const Vec3& at, double reach) noexcept {
    const Vec3 normal(slab.normal);
    if (normal == Vec3(0.0)) return false;
    // Neighbours on a flat surface have the same normal.
    if (!(glm::dot(normal, slab_normal_) > kAlikeNormals)) {
        slab_normal_ = normal;
        const Vec3 turned = to_tool(normal);
        slab_lowest_ = glm::dot(lowest_along(turned) + at, turned);
    }
    // Its heights differ by less than the rounding's hundredth where the normals differ by so little.
    return slab_lowest_ - slab.top_m > reach + kAlikeNormalsDiffer * shape_.reach_m;
}

// Whether a box in the tool's axes is farther than the slack from the rounded tool where that was gathered.
bool ShapeSearch::is_beside(const Vec3& low, const Vec3& high, double slack) const noexcept {
    const Vec3 lo = gathered_at_ + shape_.bounds.lo - slack, hi = gathered_at_ + shape_.bounds.hi + slack;
    return low.x > hi.x || low.y > hi.y || low.z > hi.z || high.x < lo.x || high.y < lo.y || high.z < lo.z ||
           is_around(low - gathered_at_, high - gathered_at_, rounding_ + slack);
}

// Whether nothing of a group of triangles can be touched: behind a face that is held, or too far.
bool ShapeSearch::is_left_out(const Box& box, const geometry::TriangleSlab& slab, double slack) noexcept {
    ++work_.triangles_seen;
    const double allowed = kEdge * rounding_;
    for (std::uint32_t k = 0; k < held_count_; ++k)
        if (highest(box, slab, faces_in_object_[k]) <= held_tops_[k] + allowed) return true;
    const Vec3 size = 0.5 * (box.hi - box.lo), middle = to_tool(0.5 * (box.lo + box.hi));
    const Vec3 half(glm::dot(glm::abs(turn_[0]), size), glm::dot(glm::abs(turn_[1]), size),
                    glm::dot(glm::abs(turn_[2]), size));
    return is_beside(middle - half, middle + half, slack) || is_above(slab, gathered_at_, rounding_ + slack);
}

// What is within the slack of the tool: around the segment along its longest side.
geometry::Near ShapeSearch::near_tool(const Vec3& at, double slack) const noexcept {
    const Vec3 extent = shape_.bounds.extent(), middle = at + shape_.bounds.center();
    const int longest = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    Vec3 half(0.0), across = 0.5 * extent;
    half[longest] = across[longest];
    across[longest] = 0.0;
    const Vec3 from = from_tool(middle - half), to = from_tool(middle + half);
    return {.lo = glm::min(from, to),
            .hi = glm::max(from, to),
            .reach_m = glm::length(across) + rounding_ + slack,
            .by_way = true,
            .from = from,
            .to = to};
}

bool ShapeSearch::look(const Vec3& at, double& slack) noexcept {
    count_ = plane_count_ = held_count_ = cover_count_ = looked_at_ = tried_count_ = 0;
    const bool is_fine = surface_.mean_edge_m() <= fineness_.longest_edge_m;
    hold_at_ = is_fine ? kHoldAtIfFine : kHoldAt;
    slab_normal_ = Vec3(0.0);
    gathered_at_ = at;
    geometry::Near near = near_tool(at, slack);
    const double around = near.reach_m - slack;
    const std::uint32_t most_looks = near.looks_left = affords(0.5, WorkCost::kLook_ns);
    const std::uint32_t most = std::min(kMost, affords(0.5, WorkCost::kGathered_ns + 4.0 * WorkCost::kSupport_ns));
    // What a coarser look needs is kept back.
    const double reserve_ns = 0.5 * left_ns();
    bool spent = false;
    const auto has_room = [&] {
        spent = spent || left_ns() < reserve_ns;
        if (spent) return false;
        if (count_ >= hold_at_) {
            hold_faces(at, rounding_ + slack);
            hold_at_ = std::max(kHoldAt, 4 * count_);
        }
        if (count_ < most) return true;
        const bool room = make_room(at, slack, most);
        near.reach_m = around + slack;
        return room;
    };
    const auto add_triangle = [&](std::uint32_t id, const geometry::Triangle& t) {
        if (is_behind_held(t)) return near.look();
        const Vec3 a = to_tool(t.a), b = to_tool(t.b), c = to_tool(t.c);
        if (is_beside(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), slack)) return true;
        if (!has_room()) return false;
        add(t, outward_normal(t), id, false);
        return true;
    };
    const auto add_vertex = [&](const geometry::SurfacePoint& point) {
        const geometry::Triangle t{point.position, point.position, point.position};
        if (is_behind_held(t)) return near.look();
        const Vec3 p = to_tool(point.position);
        if (is_beside(p, p, slack)) return true;
        if (!has_room()) return false;
        add(t, point.normal(), kNoId, true);
        return true;
    };
    const auto skips = [&](const Box& box, const geometry::TriangleSlab& slab) {
        spent = spent || left_ns() < reserve_ns;
        return spent || is_left_out(box, slab, slack);
    };
    const bool complete =
        geometry::for_each_near(surface_, near, geometry::SkippingVisitor{add_triangle, add_vertex, fineness_, skips});
    work_.triangles_seen += most_looks - near.looks_left;
    work_.gathered += count_;
    return complete && !spent;
}

template <typename Keeps>
void ShapeSearch::keep_candidates(Keeps&& keeps) noexcept {
    std::uint32_t kept = held_count_;
    for (std::uint32_t i = held_count_; i < count_; ++i)
        if (keeps(i)) swap_candidates(kept++, i);
    count_ = looked_at_ = kept;
}

void ShapeSearch::swap_candidates(std::uint32_t a, std::uint32_t b) noexcept {
    if (a == b) return;
    std::swap(candidates_[a], candidates_[b]);
    std::swap(in_object_[a], in_object_[b]);
    std::swap(faces_in_object_[a], faces_in_object_[b]);
    std::swap(ids_[a], ids_[b]);
}

Vec3 ShapeSearch::lowest_along(const Vec3& normal) noexcept {
    Vec3 place(0.0);
    double least = HUGE_VAL;
    for (std::uint32_t i = 0; i < shape_.piece_count; ++i) {
        const Vec3 of_piece = lowest_place(shape_, shape_.pieces[i], normal);
        if (const double height = glm::dot(normal, of_piece); height < least) least = height, place = of_piece;
    }
    work_.supports += shape_.piece_count;
    return place;
}

// Whether this place of the tool is its lowest above the triangle's plane, and is above the triangle itself, so that
// the face's own plane is what holds the tool off.
bool ShapeSearch::lies_on(const Candidate& c, const Vec3& at, const Vec3& place) noexcept {
    if (c.two_sided) return false;
    ++work_.triangles_tested;
    const double tie = kOwnPlane * rounding_, height = glm::dot(c.face, place) - c.height;
    if (!(height > 0.0)) return false;
    const Vec3 off = place - nearest_on_triangle(place, c.triangle).point;
    if (glm::dot(off, off) > (height + tie) * (height + tie)) return false;
    const double least = glm::dot(c.face, at + lowest_along(c.face)) - c.height;
    return least > 0.0 && height <= least + tie;
}

// Holds a face: its plane bounds the tool as long as what is gathered holds, and what is behind it is not gathered.
void ShapeSearch::hold(std::uint32_t candidate) noexcept {
    swap_candidates(held_count_, candidate);
    const Candidate& c = candidates_[held_count_];
    covers_[held_count_] = {c.face, c.height};
    held_tops_[held_count_] = glm::dot(faces_in_object_[held_count_], in_object_[held_count_].a);
    ++held_count_;
}

// Among many candidates, holds the faces that the tool lies on, and leaves out what is behind them. They are looked for
// where the hand presses the tool, and where the tool is lowest above each of a few candidates.
void ShapeSearch::hold_faces(const Vec3& at, double reach) noexcept {
    if (tried_count_ == 0) hold_faces_around(at + lowest_along(-pull_), at, reach);
    for (std::uint32_t i = std::max(looked_at_, held_count_); i < count_ && tried_count_ < kMostTried; ++i) {
        const Candidate& c = candidates_[i];
        if (is_behind_held(in_object_[i]) || was_tried(faces_in_object_[i])) continue;
        tried_[tried_count_++] = faces_in_object_[i];
        hold_faces_around(at + lowest_along(c.face), at, reach);
    }
    keep_candidates([&](std::uint32_t i) { return !is_behind_held(in_object_[i]); });
}

bool ShapeSearch::was_tried(const Vec3& normal) const noexcept {
    return std::any_of(tried_.begin(), tried_.begin() + tried_count_,
                       [&](const Vec3& tried) { return glm::dot(tried, normal) > kAlikeNormals; });
}

void ShapeSearch::hold_faces_around(const Vec3& place, const Vec3& at, double reach) noexcept {
    const Vec3 in_object = from_tool(place);
    geometry::Near near{.lo = in_object, .hi = in_object, .reach_m = reach};
    const std::uint32_t most_looks = near.looks_left = affords(kOfWorkAround, WorkCost::kLook_ns);
    std::uint32_t tests_left = affords(kOfWorkAround, WorkCost::kTest_ns + WorkCost::kSupport_ns);
    geometry::for_each_triangle_near(surface_, near, [&](std::uint32_t id, const geometry::Triangle& t) {
        if (count_ == kMost || held_count_ == kMostHeld || tests_left-- == 0) return false;
        if (is_behind_held(t)) return near.look();
        add(t, outward_normal(t), id, false);
        if (lies_on(candidates_[count_ - 1], at, place))
            hold(count_ - 1);
        else
            --count_;
        return true;
    });
    work_.triangles_seen += most_looks - near.looks_left;
}

// How far the tool's hulls are from a candidate at least.
double ShapeSearch::least_gap_m(const Candidate& c, const Vec3& at) noexcept {
    const geometry::Triangle& t = c.triangle;
    const Vec3 low = glm::min(glm::min(t.a, t.b), t.c) - at, high = glm::max(glm::max(t.a, t.b), t.c) - at;
    const Vec3 off = glm::max(glm::max(low - shape_.bounds.hi, shape_.bounds.lo - high), Vec3(0.0));
    const double beside = glm::length(off) > 0.0 ? rounding_ + glm::length(off) : 0.0;
    return c.is_vertex || c.two_sided ? beside : std::max(beside, above(c, at));
}

// Makes room for more candidates: lets the farthest go, and then covers less.
bool ShapeSearch::make_room(const Vec3& at, double& slack, std::uint32_t most) noexcept {
    hold_faces(at, rounding_ + slack);
    for (; count_ >= most; slack *= 0.5) {
        if (0.5 * slack < kLeastSlack * rounding_) return false;
        keep_candidates([&](std::uint32_t i) {
            Candidate& c = candidates_[i];
            if (!(c.least_gap_m >= 0.0)) c.least_gap_m = std::max(least_gap_m(c, at), 0.0);
            return c.least_gap_m <= rounding_ + 0.5 * slack;
        });
    }
    return true;
}

bool ShapeSearch::gather(const Vec3& at, double slack) noexcept {
    slack_ = 0.0;
    travel_ = 0.0;
    touched_at_ = at;
    fineness_ = {kFineOfSize * shape_.size_m, 1};
    for (int tries = 0; tries < kMostLooksAround; ++tries) {
        if (left_ns() <= 0.0) return false;
        if (look(at, slack)) {
            slack_ = slack;
            return true;
        }
        slack = std::max(0.5 * slack, kLeastSlack * rounding_);
        fineness_.longest_edge_m *= kCoarserLook;
        fineness_.stride = std::min(kCoarserStride * fineness_.stride, kGreatestStride);
    }
    return false;
}

double ShapeSearch::covered_share(const Vec3& at, const Vec3& step) const noexcept {
    if (covers(at + step)) return 1.0;
    // Where |at + share * step - gathered_at| is the slack.
    const Vec3 off = at - gathered_at_;
    const double a = glm::dot(step, step), b = glm::dot(step, off), c = glm::dot(off, off) - slack_ * slack_;
    const double root = std::sqrt(std::max(b * b - a * c, 0.0));
    return std::clamp((root - b) / a, 0.0, 1.0);
}

}  // namespace burin::haptics

// SPDX-License-Identifier: MIT
#include "haptics/contact/shape_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/tool_sides.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

// Of the rounding: how exactly a gap is found.
constexpr double kExact = 1e-3;
// A triangle faces the tool where its normal and the plane's have at least this cosine; edges lie square to the plane.
constexpr double kFaces = -0.02;
// A plane is that of the face itself where both are turned by less than this cosine.
constexpr double kAlongFace = 0.99;
// Places nearer to each other than this part of the rounding are the same.
constexpr double kSamePlace = 1e-4;
// A triangle rises before a direction where one of its sides has this sine towards it.
constexpr double kRises = 0.02;
constexpr int kMostApproaches = 12;
// Cosines between a step and a face: a face, or a smooth surface's vertex, that it leads away from.
constexpr double kGrazes = 1e-3, kLeavesVertex = 0.5;
// Up to these parts of the way what is so near is looked at, before what is farther.
constexpr std::array kSweptShares{0.0, 0.02, 0.1, 0.25, 0.5, 1.0};

}  // namespace

ShapeSearch::ShapeSearch(const ToolShape& shape, const geometry::PosedSurface& surface, const ProxyBudget& budget,
                         ContactWork& work) noexcept
    : shape_(shape), surface_(surface), budget_(budget), work_(work), rounding_(shape.rounding_m) {}

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
    for (std::uint32_t k = 0; k < held_count_; ++k) covers_[k] = {candidates_[k].face, candidates_[k].height};
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
    if (shape_.side_count > 0) {
        work_.triangles_seen += kLooksOfSides;
        const SideGap side = side_gap(shape_, t, at);
        if (side.plane_gap_m > 0.0 && !c.guessed) c.guess = -side.normal;
        if (side.gap_m > reach) return side.gap_m - reach;
    }
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

bool ShapeSearch::is_covered(const Candidate& c) const noexcept {
    const double allowed = kEdge * rounding_;
    for (std::uint32_t k = 0; k < cover_count_; ++k) {
        const auto [normal, top] = covers_[k];
        const geometry::Triangle& t = c.triangle;
        if (std::max({glm::dot(normal, t.a), glm::dot(normal, t.b), glm::dot(normal, t.c)}) <= top + allowed)
            return true;
    }
    return false;
}

void ShapeSearch::cover(const geometry::Triangle& t, const Vec3& normal) noexcept {
    if (cover_count_ == kMostCovers) return;
    covers_[cover_count_++] = {normal, std::max({glm::dot(normal, t.a), glm::dot(normal, t.b), glm::dot(normal, t.c)})};
}

// Whether a triangle that shares this place of an edge or corner rises before it, so that no direction that is held off
// there can be this one: over a flat or hollow edge, all but the faces' own.
bool ShapeSearch::is_hidden(const Vec3& place, const Vec3& normal) noexcept {
    const Vec3 at = from_tool(place), n = from_tool(normal);
    const double tie = kSamePlace * rounding_;
    geometry::Near near{.lo = at, .hi = at, .reach_m = tie, .looks_left = affords(1.0, WorkCost::kLook_ns)};
    const std::uint32_t most_looks = near.looks_left;
    bool hidden = false;
    geometry::for_each_triangle_near(surface_, near, [&](std::uint32_t, const geometry::Triangle& t) {
        const Vec3 off = nearest_on_triangle(at, t).point - at;
        if (glm::dot(off, off) > tie * tie) return true;
        for (const Vec3& corner : {t.a, t.b, t.c})
            hidden = hidden || glm::dot(n, corner - at) > kRises * glm::length(corner - at);
        return !hidden;
    });
    work_.triangles_seen += most_looks - near.looks_left;
    return hidden;
}

bool ShapeSearch::touch(const Vec3& at) noexcept {
    travel_ += glm::length(at - touched_at_);
    touched_at_ = at;
    plane_count_ = feature_count_ = 0;
    overlaps_ = false;
    sunk_m_ = 0.0;
    touch_held(at);
    const double reach = rounding_ * (1.0 + kReached);
    for (std::uint32_t i = held_count_; i < count_; ++i) {
        Candidate& c = candidates_[i];
        touches_[i] = false;
        if (c.clear_until_m > travel_) continue;
        if (left_ns() <= 0.0) return false;
        if (is_covered(c)) {
            touches_[i] = true;
            continue;
        }
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
            cover(c.triangle, out.normal);
            continue;
        }
        c.clear_until_m = travel_ + s.gap_m - reach;
        if (s.gap_m > reach || !faces(c, s.normal)) continue;
        c.clear_until_m = -HUGE_VAL;
        if (!touch_face(i, s, at)) features_.put(feature_count_++, {i, s.normal, s.on_triangle, s.gap_m});
    }
    touch_features(at);
    return true;
}

// Puts the planes of the faces that are held, whether or not the tool still lies on them.
void ShapeSearch::touch_held(const Vec3& at) noexcept {
    cover_count_ = held_count_;
    for (std::uint32_t k = 0; k < held_count_; ++k) {
        Candidate& c = candidates_[k];
        const double height = above(c, at);
        overlaps_ = overlaps_ || !(height > 0.0);
        put_plane(k, {c.face, rounding_ - height}, c.triangle.a);
    }
}

// Puts the plane of a face, or of a smooth surface's vertex, if that is what the tool touches.
bool ShapeSearch::touch_face(std::uint32_t candidate, const Separation& s, const Vec3& at) noexcept {
    const Candidate& c = candidates_[candidate];
    const double facing = glm::dot(c.face, s.normal);
    if (std::abs(facing) <= kAlongFace) return false;
    if (c.is_vertex) {
        put_plane(candidate, {s.normal, rounding_ * (1.0 - kEdge) - s.gap_m}, s.on_triangle);
    } else {
        const double height = facing > 0.0 ? above(c, at) : -HUGE_VAL;
        if (!(height >= s.gap_m - kOwnPlane * rounding_)) return false;
        put_plane(candidate, {c.face, rounding_ - height}, s.on_triangle);
    }
    cover(c.triangle, planes_[plane_count_ - 1].normal);
    return true;
}

// Puts the planes of the edges and corners that lie behind no face that is touched.
void ShapeSearch::touch_features(const Vec3& at) noexcept {
    for (std::uint32_t k = 0; k < feature_count_; ++k) {
        const Feature& f = features_[k];
        const Candidate& c = candidates_[f.candidate];
        touches_[f.candidate] = true;
        if (is_covered(c)) continue;
        HalfSpace plane{f.normal, rounding_ * (1.0 - kEdge) - f.gap_m};
        // What rises before it is nearer and pushes by itself: this face may only not be come nearer to.
        if (!c.two_sided && !c.is_vertex && is_hidden(f.place, f.normal) && above(c, at) > 0.0)
            plane = {c.face, std::min(plane.offset, 0.0)};
        put_plane(f.candidate, plane, f.place);
    }
}

// Whether a step leads away from this triangle's front. What a tool meets first of a closed surface has a face before
// it that does not: where all faces around a place lead away, so does each direction that is held off there.
bool ShapeSearch::leaves(const Candidate& c, const Vec3& step) noexcept {
    if (c.two_sided) return false;
    const double along = glm::dot(c.face, step), length = glm::length(step);
    return along >= (c.is_vertex ? kLeavesVertex : -kGrazes) * length;
}

// Whether one side of the tool tells it from this triangle on all of a straight way.
bool ShapeSearch::passes_a_side(const Candidate& c, const Vec3& at, const Vec3& step, double stop) noexcept {
    if (shape_.side_count == 0) return false;
    work_.triangles_seen += kLooksOfSides;
    const SideGap side = side_gap(shape_, c.triangle, at);
    return std::min(side.plane_gap_m, side.plane_gap_m - glm::dot(side.normal, step)) >= stop;
}

// The share of the step after which this triangle is touched; beyond 1: it is not.
double ShapeSearch::until(Candidate& c, const Vec3& at, const Vec3& step) noexcept {
    const double stop = rounding_ * (1.0 - 2.0 * kEdge);
    if (passes_a_side(c, at, step, stop)) return kNoTouch;
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

// The nearest first, so that a sweep whose work does not suffice still proves a part of the way: what was not looked at
// is farther off than that.
ShapeSearch::Sweep ShapeSearch::sweep(const Vec3& at, const Vec3& step) noexcept {
    Sweep result;
    const double length = glm::length(step);
    double from = -HUGE_VAL;
    for (const double share : kSweptShares) {
        const double to = share * length;
        for (std::uint32_t i = 0; i < count_ && result.complete; ++i) {
            if (touches_[i]) continue;
            Candidate& c = candidates_[i];
            const double clear_m = c.clear_until_m - travel_;
            if (clear_m <= from || clear_m > to || clear_m > result.fraction * length || leaves(c, step)) continue;
            if (is_covered(c)) continue;
            if (left_ns() <= 0.0) {
                result.complete = false;
            } else {
                ++work_.triangles_tested;
                result.fraction = std::min(result.fraction, until(c, at, result.fraction * step) * result.fraction);
            }
        }
        if (!result.complete) break;
        from = to;
    }
    if (!result.complete && length > 0.0)
        result.fraction = std::min(result.fraction, std::max(nearest_beyond(from), 0.0) / length);
    return result;
}

// How far the tool may go until it may meet what is clear by more than `from`.
double ShapeSearch::nearest_beyond(double from) const noexcept {
    double least = HUGE_VAL;
    for (std::uint32_t i = 0; i < count_; ++i) {
        const double clear_m = candidates_[i].clear_until_m - travel_;
        if (!touches_[i] && clear_m > from) least = std::min(least, clear_m);
    }
    return least;
}

}  // namespace burin::haptics

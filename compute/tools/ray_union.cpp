// SPDX-License-Identifier: MIT
#include "compute/tools/ray_union.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burin::compute {
namespace {

// Slope by which a plane is tilted. A slice a thousandth of the tool away along its axis then falls clear of it by
// many times the margin, and a circle that is turned into it rises by far less.
constexpr double kTilt = 0.02;

// A single move of no more pieces than this is not compared with: that would cost as much as the sections it saves.
constexpr std::size_t kFewPieces = 16;

// The parts of one ray, of any number.
struct RayParts {
    std::vector<shared::CoveredPart>& parts;
    int part_count = 0;

    using CoveredPart = shared::CoveredPart;
    [[nodiscard]] const CoveredPart& load_part(int i) const { return parts[static_cast<std::size_t>(i)]; }
    void store_part(int i, const CoveredPart& part) {
        if (static_cast<std::size_t>(i) == parts.size()) {
            parts.push_back(part);
        } else {
            parts[static_cast<std::size_t>(i)] = part;
        }
    }
    [[nodiscard]] static bool has_room_for_part() { return true; }
#include "shaders/shared/join_parts.h"
};

}  // namespace

void RayUnion::gather(int axis, double u, double v, std::span<const std::uint32_t> moves) {
    axis_ = axis;
    u_ = u;
    v_ = v;
    ++ray_;
    found_.clear();
    parts_.clear();
    if (bounds_.moves() == 1 && a_move_ <= kFewPieces) {
        for (std::uint32_t piece = 0; piece < pieces_.size() && !moves.empty(); ++piece) {
            if (bounds_.is_near(piece, axis_, u_, v_)) add_section(piece);
        }
        return;
    }
    try_last_ends(moves);
    for (std::size_t i = 0; i < moves.size();) {
        const std::size_t move = moves[i++];
        if (tried_on_[move] == ray_) continue;
        Room room;
        for (const Part& part : parts_) room = std::max(room, room_in(part, move));
        if (room.width > 0.0) {  // the moves that are no farther from this one than that stay within too
            while (i < moves.size() && bounds_.way(move, moves[i]) < room.width) ++i;
        } else {
            add_pieces(move, room.slice);
        }
    }
    if (parts_.empty()) return;
    at_ends_.clear();
    for (const Part& part : parts_) {
        at_ends_.push_back(part.lo.piece);
        if (part.hi.piece != part.lo.piece) at_ends_.push_back(part.hi.piece);
    }
    if (at_row_start_.empty()) at_row_start_ = at_ends_;
}

// Begins with the pieces at the ends on the ray before and with those beside them.
void RayUnion::try_last_ends(std::span<const std::uint32_t> moves) {
    const auto is_on_ray = [&](std::uint32_t piece) {
        return std::ranges::binary_search(moves, static_cast<std::uint32_t>(piece / a_move_));
    };
    for (const std::uint32_t piece : at_ends_) {
        if (is_on_ray(piece)) add(piece);
    }
    for (const std::uint32_t piece : at_ends_) {
        if (is_on_ray(piece)) add_pieces(piece / a_move_, piece % a_move_);
    }
}

void RayUnion::start_row() {
    if (!at_row_start_.empty()) at_ends_ = at_row_start_;
    at_row_start_.clear();
}

// Returns how far behind the plane at an end the move stays; below zero when it may leave it, and when the ray does not
// leave it beyond that end, so that the plane tells nothing.
double RayUnion::room_behind(const End& end, bool is_hi, std::size_t move) const {
    if (move == end.move) return -1.0;
    const Vec3 n = bounds_.in_move(move, end.plane);
    if (leaves(n, is_hi)) {
        const double room = bounds_.room(move, end.plane, n, end.place) - bounds_.margin();
        if (room > 0.0) return room;
    }
    return bounds_.clearance(move, end.place, axis_, is_hi) - bounds_.margin();
}

// Returns the room behind both planes of the part, and the slice to begin with where there is none.
RayUnion::Room RayUnion::room_in(const Part& part, std::size_t move) const {
    const double at_lo = room_behind(part.lo, false, move);
    if (!(at_lo > 0.0)) return {at_lo, part.lo.piece % a_move_};
    const double at_hi = room_behind(part.hi, true, move);
    return {std::min(at_lo, at_hi), part.hi.piece % a_move_};
}

// Adds the slices of the move that may leave all parts, from the given one outwards.
void RayUnion::add_pieces(std::size_t move, std::size_t from) {
    if (tried_on_[move] == ray_) return;
    tried_on_[move] = ray_;
    bool is_seen = false;
    const auto try_slice = [&](std::size_t slice) {
        const auto piece = static_cast<std::uint32_t>(move * a_move_ + slice);
        if (seen_on_[piece] == ray_ || !bounds_.is_near(piece, axis_, u_, v_)) return;
        if (a_move_ > 1) {
            if (!is_seen) see_parts(move);
            is_seen = true;
            if (is_within(move, slice)) return;
        }
        if (add(piece)) is_seen = false;
    };
    try_slice(from);
    for (std::size_t away = 1; away < a_move_; ++away) {
        if (away <= from) try_slice(from - away);
        if (from + away < a_move_) try_slice(from + away);
    }
}

void RayUnion::see_parts(std::size_t move) {
    seen_.clear();
    for (const Part& part : parts_) seen_.push_back({seen(part.lo, false, move), seen(part.hi, true, move)});
}

RayUnion::SeenEnd RayUnion::seen(const End& end, bool is_hi, std::size_t move) const {
    SeenEnd seen;
    seen.n = move == end.move ? end.plane.n : bounds_.in_move(move, end.plane);
    if (leaves(seen.n, is_hi)) seen.straight = bounds_.profile_space(move, end.plane, seen.n, end.place);
    return seen;
}

// Tells whether a slice lies behind the plane at an end. A slice above the one at the end touches the plane where the
// two meet, and falls clear of a plane that is tilted down; one below, of a plane that is tilted up.
bool RayUnion::is_behind(const End& end, SeenEnd& seen, bool is_hi, std::size_t move, std::size_t slice) const {
    if (bounds_.slice_within(seen.straight, slice)) return true;
    const bool is_above = slice > end.piece % a_move_;
    MoveBounds::ProfileSpace& tilted = seen.tilted[is_above];
    if (!seen.is_tilted[is_above]) {
        seen.is_tilted[is_above] = true;
        const Vec3 n = seen.n + (is_above ? -kTilt : kTilt) * bounds_.stacked_along(move);
        if (leaves(n, is_hi)) tilted = bounds_.profile_space(move, n, end.place);
    }
    return bounds_.slice_within(tilted, slice);
}

bool RayUnion::is_within(std::size_t move, std::size_t slice) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (is_behind(parts_[i].lo, seen_[i].lo, false, move, slice) &&
            is_behind(parts_[i].hi, seen_[i].hi, true, move, slice)) {
            return true;
        }
    }
    return false;
}

// Computes the section with a piece. Returns whether there is one.
bool RayUnion::add_section(std::uint32_t piece) {
    seen_on_[piece] = ray_;
    ++sections_;
    const SweepSpan span = span_of(pieces_[piece], axis_, u_, v_);
    if (is_empty(span)) return false;
    found_.push_back({span, piece});
    return true;
}

bool RayUnion::add(std::uint32_t piece) {
    if (!add_section(piece)) return false;
    include(found_.back().span, piece);
    return true;
}

// Joins the section with the parts that it overlaps.
void RayUnion::include(const SweepSpan& span, std::uint32_t piece) {
    const auto overlaps = [&](const Part& part) { return span.lo <= part.hi.depth && span.hi >= part.lo.depth; };
    const auto first = std::ranges::find_if(parts_, overlaps);
    if (first == parts_.end()) {
        parts_.push_back({end_at(span.lo, span.plane_lo, piece), end_at(span.hi, span.plane_hi, piece)});
        return;
    }
    if (span.lo < first->lo.depth) first->lo = end_at(span.lo, span.plane_lo, piece);
    if (span.hi > first->hi.depth) first->hi = end_at(span.hi, span.plane_hi, piece);
    for (auto other = first + 1; other != parts_.end();) {
        if (!overlaps(*other)) {
            ++other;
            continue;
        }
        if (other->lo.depth < first->lo.depth) first->lo = other->lo;
        if (other->hi.depth > first->hi.depth) first->hi = other->hi;
        other = parts_.erase(other);
    }
}

RayUnion::End RayUnion::end_at(double depth, const Vec3& plane, std::uint32_t piece) const {
    End end{depth, piece, piece / a_move_, Vec3(0.0), {}};
    end.place[axis_] = depth;
    end.place[(axis_ + 1) % 3] = u_;
    end.place[(axis_ + 2) % 3] = v_;
    const double length = std::sqrt(glm::dot(plane, plane));
    if (length > 0.0) end.plane = bounds_.tool_direction(end.move, plane / length);
    return end;
}

// Joins the sections of each move, and then the parts of the moves.
void RayUnion::join() {
    order_.resize(found_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, {}, [this](std::uint32_t i) { return found_[i].piece; });
    joined_.clear();
    RayParts ray{joined_};
    for (std::size_t i = 0; i < order_.size();) {
        const std::size_t move = found_[order_[i]].piece / a_move_;
        shared::CoveredPart of_move = shared::part_of(found_[order_[i++]].span);
        for (; i < order_.size() && found_[order_[i]].piece / a_move_ == move; ++i)
            of_move = shared::joined(of_move, shared::part_of(found_[order_[i]].span));
        ray.add_part(of_move);
    }
    joined_.resize(static_cast<std::size_t>(ray.part_count));
    std::ranges::sort(joined_, {}, &shared::CoveredPart::lo);
}

void RayUnion::append(int deepest, std::uint8_t material, std::vector<shared::DexelEnd>& ends) {
    join();
    for (const shared::CoveredPart& part : joined_) {
        const shared::CoveredSpan span = shared::span_of_part(part, axis_, deepest);
        if (span.lo >= span.hi) continue;
        ends.push_back(shared::make_end(span.lo, material, span.normal_lo));
        ends.push_back(shared::make_end(span.hi, material, span.normal_hi));
    }
}

}  // namespace burin::compute

// SPDX-License-Identifier: MIT
#include "compute/tools/move_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace burin::compute {
namespace {

// A section leaves the swept tool by less than 1e-6 units where the slack decides (convex_sweep.cpp), and by less than
// 1e-7 of the tool's and the motion's size where rounding does, which is worst near the tip of a flat slice. Both are
// nothing beside the distance of two moves, so that there is no need to be exact here.
constexpr double kLeastMargin = 1.0, kMarginOfSize = 1e-6;

double length_of(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

// Returns the distance of a point of one circle or box from the nearest of another, at most.
double farthest(const Vec3& base_a, const Vec3& along_a, const Vec3& base_b, const Vec3& along_b) {
    return std::max(length_of(base_b - base_a), length_of(base_b + along_b - base_a - along_a));
}

}  // namespace

MoveBounds::MoveBounds(std::span<const ConvexPiece> pieces, std::size_t pieces_a_move) {
    if (pieces.empty()) return;
    for (std::size_t i = 0; i < pieces.size(); i += pieces_a_move)
        std::visit([this](const auto& piece) { add(piece); }, pieces[i]);
    double size = 0.0;
    if (const auto* first = std::get_if<FrustumSweep>(&pieces.front())) {
        profile_.emplace_back(first->shape().tip_radius, 0.0);
        for (const ConvexPiece& piece : pieces.first(pieces_a_move)) {
            const Frustum& slice = std::get<FrustumSweep>(piece).shape();
            profile_.emplace_back(slice.top_radius, profile_.back().y + slice.length);
        }
        for (const Vec2& p : profile_) size = std::max(size, p.x + p.y);
        find_faces();
    }
    for (const Move& move : moves_) {
        margin_ = std::max(margin_, size + length_of(half_size_) + length_of(move.along));
    }
    margin_ = kLeastMargin + kMarginOfSize * margin_;
    for (const ConvexPiece& piece : pieces) {
        const Box box = bounds_of(piece);
        boxes_.push_back({box.lo - Vec3(margin_), box.hi + Vec3(margin_)});
    }
    measure_ways();
}

void MoveBounds::add(const FrustumSweep& first) {
    Move& move = moves_.emplace_back();
    move.base = first.tip();
    move.along = first.along();
    move.axis = first.axis();
    move.across = move.along - glm::dot(move.along, move.axis) * move.axis;
    const double square = glm::dot(move.along, move.along);
    move.stacked = square > 0.0 ? move.axis - move.along * (glm::dot(move.axis, move.along) / square) : move.axis;
    if (const double length2 = glm::dot(move.across, move.across); length2 > 0.0) move.per_across2 = 1.0 / length2;
}

void MoveBounds::find_faces() {
    faces_ = {{0.0, -1.0, 0.0}, {0.0, 1.0, profile_.back().y}};
    for (std::size_t i = 0; i + 1 < profile_.size(); ++i) {
        const Vec2 edge = profile_[i + 1] - profile_[i];
        const double length = std::sqrt(glm::dot(edge, edge)), across = edge.y / length, rise = -edge.x / length;
        faces_.push_back({across, rise, across * profile_[i].x + rise * profile_[i].y});
    }
}

void MoveBounds::add(const BoxSweep& box) {
    Move& move = moves_.emplace_back();
    move.base = box.start();
    move.along = box.along();
    for (int side = 0; side < 3; ++side) move.sides[side] = box.side(side);
    half_size_ = box.half_size();
}

void MoveBounds::measure_ways() {
    double wide = 0.0, high = 0.0;
    for (const Vec2& p : profile_) wide = std::max(wide, p.x), high = std::max(high, p.y);
    for (std::size_t i = 0; i + 1 < moves_.size(); ++i) {
        const Move& move = moves_[i];
        Move& next = moves_[i + 1];
        next.way = move.way + farthest(move.base, move.along, next.base, next.along) +
                   (wide + high) * length_of(next.axis - move.axis);
        for (int side = 0; side < 3; ++side)
            next.way += half_size_[side] * length_of(next.sides[side] - move.sides[side]);
    }
}

MoveBounds::ToolDirection MoveBounds::tool_direction(std::size_t i, const Vec3& n) const {
    const Move& move = moves_[i];
    ToolDirection direction;
    direction.n = n;
    if (profile_.empty()) {
        for (int side = 0; side < 3; ++side) {
            direction.along_sides[side] = glm::dot(n, move.sides[side]);
            direction.reach += std::abs(direction.along_sides[side]) * half_size_[side];
        }
        return direction;
    }
    direction.rise = glm::dot(n, move.axis);
    direction.across = std::sqrt(std::max(0.0, glm::dot(n, n) - direction.rise * direction.rise));
    if (moves_.size() == 1) return direction;  // there is no other move to compare with
    direction.reach = -std::numeric_limits<double>::infinity();
    for (const Vec2& p : profile_)
        direction.reach = std::max(direction.reach, direction.across * p.x + direction.rise * p.y);
    return direction;
}

Vec3 MoveBounds::in_move(std::size_t i, const ToolDirection& direction) const {
    const Move& move = moves_[i];
    if (profile_.empty()) {
        const Vec3& c = direction.along_sides;
        return c.x * move.sides[0] + c.y * move.sides[1] + c.z * move.sides[2];
    }
    const Vec3 away = direction.n - glm::dot(direction.n, move.axis) * move.axis;
    const double length = length_of(away);
    const Vec3 up = direction.rise * move.axis;
    return length > 0.0 ? up + (direction.across / length) * away : up;
}

double MoveBounds::clearance(std::size_t i, const Vec3& point, int axis, bool upwards) const {
    const Move& move = moves_[i];
    const Vec3 from_base = point - move.base;
    double most = -1.0;
    if (profile_.empty()) {
        const Vec3 from_middle = from_base - 0.5 * move.along;
        for (int side = 0; side < 3; ++side) {
            const Vec3 n = glm::dot(from_middle, move.sides[side]) < 0.0 ? -move.sides[side] : move.sides[side];
            if (upwards ? n[axis] > 0.0 : n[axis] < 0.0)
                most = std::max(most, swept_room(move, n, point) - half_size_[side]);
        }
        return most;
    }
    // Faces of a round tool are looked at on the side of the axis where the point is when the axis is nearest to it.
    const double height = glm::dot(from_base, move.axis), way_up = glm::dot(move.along, move.axis);
    const Vec3 beside = from_base - height * move.axis;
    const double nearest = std::clamp(glm::dot(beside, move.across) * move.per_across2, 0.0, 1.0);
    const Vec3 away = beside - nearest * move.across;
    const double length = length_of(away), per_length = length > 0.0 ? 1.0 / length : 0.0;
    const double distance = glm::dot(away, beside) * per_length, way_out = glm::dot(away, move.across) * per_length;
    const double sign = upwards ? 1.0 : -1.0;
    const double leaves_across = sign * away[axis] * per_length, leaves_rise = sign * move.axis[axis];
    for (const Face& face : faces_) {
        const double room = face.across * distance + face.rise * height - face.reach -
                            std::max(0.0, face.across * way_out + face.rise * way_up);
        if (face.across * leaves_across + face.rise * leaves_rise > 0.0) most = std::max(most, room);
    }
    return most;
}

MoveBounds::ProfileSpace MoveBounds::profile_space(std::size_t i, const Vec3& n, const Vec3& point) const {
    const Move& move = moves_[i];
    const double rise = glm::dot(n, move.axis), across = std::sqrt(std::max(0.0, glm::dot(n, n) - rise * rise));
    return {across, rise, swept_room(move, n, point)};
}

// Returns where the plane with normal `side` along u and `tilt` along v that touches the swept tool meets the row.
MoveBounds::Tilted MoveBounds::tilted(const Move& move, int axis, double side, double tilt, double v) const {
    const int along_u = (axis + 1) % 3, along_v = (axis + 2) % 3;
    Vec3 n(0.0);
    n[along_u] = side;
    n[along_v] = tilt;
    double reach = glm::dot(n, move.base), touches_v = move.base[along_v];
    if (const double ahead = glm::dot(n, move.along); ahead > 0.0) reach += ahead, touches_v += move.along[along_v];
    if (profile_.empty()) {
        for (int side_of_box = 0; side_of_box < 3; ++side_of_box) {
            const Vec3 half = half_size_[side_of_box] * move.sides[side_of_box];
            const double out = glm::dot(n, half);
            reach += std::abs(out);
            touches_v += out < 0.0 ? -half[along_v] : half[along_v];
        }
    } else {
        const double rise = glm::dot(n, move.axis), across = std::sqrt(std::max(0.0, glm::dot(n, n) - rise * rise));
        const Vec2* farthest = &profile_.front();
        double most = across * farthest->x + rise * farthest->y;
        for (const Vec2& p : profile_) {
            const double out = across * p.x + rise * p.y;
            if (out > most) most = out, farthest = &p;
        }
        reach += most;
        touches_v += farthest->y * move.axis[along_v];
        if (across > 0.0) touches_v += farthest->x * (tilt - rise * move.axis[along_v]) / across;
    }
    return {reach - tilt * v, touches_v};
}

// Returns an upper bound of side * u over the points of the row in what the move sweeps. Each tilt gives one; where the
// plane touches beyond the row, less tilt gives a better one, and where it touches before it, more.
double MoveBounds::bound_of_row(const Move& move, int axis, double side, double v, double& tilt) const {
    constexpr int kMostTilts = 8;
    constexpr double kNearRow = 16.0;  // units; a better tilt then hardly gives a better bound
    double best = std::numeric_limits<double>::infinity(), at = tilt, step = 0.125;
    double before = 0.0, before_off = 0.0, behind = 0.0, behind_off = 0.0;
    bool has_before = false, has_behind = false;
    for (int i = 0; i < kMostTilts; ++i) {
        const Tilted found = tilted(move, axis, side, at, v);
        if (found.meets < best) best = found.meets, tilt = at;
        const double off = found.touches_v - v;
        if (!(std::abs(off) > kNearRow)) break;
        if (off < 0.0) {
            before = at, before_off = off, has_before = true;
        } else {
            behind = at, behind_off = off, has_behind = true;
        }
        if (has_before && has_behind) {
            const double share = before_off / (before_off - behind_off);
            at = before + std::clamp(share, 0.1, 0.9) * (behind - before);
        } else {
            at += off < 0.0 ? step : -step;
            step *= 3.0;
        }
    }
    return best;
}

MoveBounds::RowPart MoveBounds::part_of_row(std::size_t i, int axis, double v, const RowPart& alike) const {
    RowPart part = alike.lo <= alike.hi ? alike : RowPart{};  // beside the tool tilts grow without end
    const Move& move = moves_[i];
    // A plane that is tilted by t keeps its margin along the row where it stands sqrt(1 + t^2) times as far off.
    const double hi = bound_of_row(move, axis, 1.0, v, part.tilt_hi);
    const double lo = bound_of_row(move, axis, -1.0, v, part.tilt_lo);
    part.hi = hi + margin_ * std::sqrt(1.0 + part.tilt_hi * part.tilt_hi);
    part.lo = -lo - margin_ * std::sqrt(1.0 + part.tilt_lo * part.tilt_lo);
    return part;
}

}  // namespace burin::compute

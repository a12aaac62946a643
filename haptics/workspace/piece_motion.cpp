// SPDX-License-Identifier: MIT
#include "haptics/workspace/piece_motion.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

// The time to a published mapping, over that between the last two.
constexpr double kSpread = 1.25;
// The time between two that are one motion; the usual one, at 60 pictures a second, is taken for the first.
constexpr double kShortest_s = 0.005, kLongest_s = 0.1, kUsual_s = 1.0 / 60.0;
// Below this a turn has no axis to be told.
constexpr double kNoTurn_rad = 1e-12;

struct Turn {
    Vec3 axis{0.0, 1.0, 0.0};
    double angle_rad = 0.0;  // 0 to pi
};

Turn turn_of(Quat q) {
    if (q.w < 0.0) q = -q;
    const Vec3 v(q.x, q.y, q.z);
    const double sine = std::sqrt(glm::dot(v, v));
    if (!(sine > 0.5 * kNoTurn_rad)) return {};
    return {v / sine, 2.0 * std::atan2(sine, q.w)};
}

double distance_device_m(const Similarity& a, const Similarity& b, const Vec3& position_device_m) {
    const Vec3 way = b * position_device_m - a * position_device_m;
    return std::sqrt(glm::dot(way, way)) / a.scale;
}

// A motion as a turn about a line, a way along it, and a growth.
struct Screw {
    Turn turn;
    Vec3 middle{0.0};  // a place on the line
    Vec3 along{0.0};   // all of the way, where nothing turns
    double grown = 1.0;
};

// Of the motion p -> grown * turn p + shift.
Screw screw_of(const Similarity& motion) {
    Screw screw{turn_of(motion.orientation), Vec3(0.0), motion.position_m, motion.scale};
    if (screw.turn.angle_rad == 0.0) return screw;
    const Vec3& axis = screw.turn.axis;
    screw.along = glm::dot(motion.position_m, axis) * axis;
    const Vec3 across = motion.position_m - screw.along;
    screw.middle = 0.5 * (across + glm::cross(axis, across) / std::tan(0.5 * screw.turn.angle_rad));
    return screw;
}

// The part `share` of the motion from one mapping to another: the same screw by a part of its angle, growing evenly.
Similarity part_of_way(const Similarity& from, const Similarity& to, double share) {
    const double grown = to.scale / from.scale;
    const Quat q = glm::normalize(to.orientation * glm::conjugate(from.orientation));
    const Screw screw = screw_of({to.position_m - grown * (q * from.position_m), q, grown});
    const double scale = 1.0 + share * (grown - 1.0);
    const Quat part = glm::angleAxis(share * screw.turn.angle_rad, screw.turn.axis);
    return {scale * (part * from.position_m) + screw.middle - part * screw.middle + share * screw.along,
            glm::normalize(part * from.orientation), scale * from.scale};
}

}  // namespace

bool is_motion(const FollowedPiece& state, const Similarity& published, const Vec3& position_device_m) noexcept {
    const Similarity& now = state.object_from_device;
    const double grown = published.scale / now.scale;
    const Turn turn = turn_of(published.orientation * glm::conjugate(now.orientation));
    return distance_device_m(now, published, position_device_m) <= kFarthestStep_m &&
           turn.angle_rad <= kFarthestTurn_rad && grown <= kMostGrowth && grown * kMostGrowth >= 1.0;
}

FollowedPiece led_to(FollowedPiece state, const Similarity& published, const Vec3& position_device_m) noexcept {
    const double apart_s = state.since_s <= kLongest_s ? std::max(state.since_s, kShortest_s) : kUsual_s;
    const double way_m = distance_device_m(state.object_from_device, published, position_device_m);
    state.left_s = std::max(kSpread * apart_s, way_m / kFastestPiece_m_per_s);
    state.since_s = 0.0;
    return state;
}

FollowedPiece followed(FollowedPiece state, const Similarity& published, double dt_s) noexcept {
    // Beyond kLongest_s it makes no difference, and the sum stays exact.
    if (state.since_s <= kLongest_s) state.since_s += dt_s;
    // The last tick takes what is left of a tick with it, so that none has but a splinter to go.
    const bool arrives = !(state.left_s > 1.5 * dt_s);
    state.object_from_device =
        arrives ? published : part_of_way(state.object_from_device, published, dt_s / state.left_s);
    state.left_s = arrives ? 0.0 : state.left_s - dt_s;
    return state;
}

PieceMotion motion_of_piece(const Similarity& before, const Similarity& now, double dt_s) noexcept {
    if (before == now || !(dt_s > 0.0)) return {};
    const Similarity moved = inverse(now) * before;  // where the device has what it had at a place a tick ago
    const Screw screw = screw_of(moved);
    const Vec3 turning = screw.turn.angle_rad / dt_s * screw.turn.axis;
    return {screw.along / dt_s - glm::cross(turning, screw.middle), turning, (moved.scale - 1.0) / dt_s};
}

}  // namespace burin::haptics

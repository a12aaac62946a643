// SPDX-License-Identifier: MIT
#include "scene/scene_motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geometry/contact/mesh_motion.hpp"

namespace burin::scene {
namespace {

// Poses that agree to this much are the same place: a tenth of a device's step, and of its angle at a lever of 0.1 m.
constexpr double kSamePlace_m = 5e-6, kSameTurn_rad = 5e-5;
// Beyond this turn between two keys the interpolated quaternion comes too near to 0.
constexpr double kMaxTurn_rad = 2.1;

// Returns the angle of the rotation that takes one orientation to the other.
double angle_between(const Quat& a, const Quat& b) {
    const Quat turn = b * glm::conjugate(a);
    return 2.0 * std::atan2(glm::length(Vec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

// Returns that one of q and -q, which are the same orientation, that is nearer to the other.
Quat nearer_sign(const Quat& q, const Quat& to) { return glm::dot(q, to) < 0.0 ? -q : q; }

// Stands for a key as the interpolation needs it.
struct Knot {
    double time_s;
    Vec3 position_m;
    Quat orientation;
};

// Returns key i; of a path that repeats, those before the first and behind the last are those of the other rounds.
Knot knot_at(const PathMotion& path, std::ptrdiff_t i) {
    const auto last = static_cast<std::ptrdiff_t>(path.keys.size()) - 1;
    const double round_s = path.keys.back().time_s;
    double shift_s = 0.0;
    if (path.repeats && i < 0) i += last, shift_s = -round_s;
    if (path.repeats && i > last) i -= last, shift_s = round_s;
    const PathKey& key = path.keys[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    return {key.time_s + shift_s, key.pose.position_m, key.pose.orientation};
}

// A cubic Hermite curve from `from` to `to`, at the share s of `span_s`; tangents are per second.
template <typename V>
V hermite(const V& from, const V& to, const V& tangent_from, const V& tangent_to, double s, double span_s) {
    const double s2 = s * s, s3 = s2 * s;
    return (2.0 * s3 - 3.0 * s2 + 1.0) * from + ((s3 - 2.0 * s2 + s) * span_s) * tangent_from +
           (3.0 * s2 - 2.0 * s3) * to + ((s3 - s2) * span_s) * tangent_to;
}

// The tangents of a path that stays at its ends are 0 there: it begins and ends at rest.
bool rests_at(const PathMotion& path, std::ptrdiff_t i) {
    return !path.repeats && (i <= 0 || i + 1 >= static_cast<std::ptrdiff_t>(path.keys.size()));
}

Vec3 linear_tangent(const PathMotion& path, std::ptrdiff_t i) {
    if (rests_at(path, i)) return Vec3(0.0);
    const Knot before = knot_at(path, i - 1), after = knot_at(path, i + 1);
    return (after.position_m - before.position_m) / (after.time_s - before.time_s);
}

Quat angular_tangent(const PathMotion& path, std::ptrdiff_t i, const Quat& here) {
    if (rests_at(path, i)) return {0.0, 0.0, 0.0, 0.0};
    const Knot before = knot_at(path, i - 1), after = knot_at(path, i + 1);
    const Quat from = nearer_sign(before.orientation, here), to = nearer_sign(after.orientation, here);
    return (to - from) * (1.0 / (after.time_s - before.time_s));
}

std::string key_name(std::size_t i) { return "path[" + std::to_string(i) + "]"; }

void check_key(std::vector<Problem>& found, const PathMotion& path, std::size_t i) {
    const PathKey& key = path.keys[i];
    if (!std::isfinite(key.time_s) || !finite(key.pose.position_m) || !geometry::is_unit(key.pose.orientation)) {
        found.push_back({key_name(i), "has a time or pose that is not finite", "give plain numbers"});
        return;
    }
    if (i == 0) {
        if (key.time_s != 0.0) found.push_back({key_name(i), "does not begin at time 0", "give it time = 0"});
        return;
    }
    const PathKey& before = path.keys[i - 1];
    const double span_s = key.time_s - before.time_s;
    if (!(span_s > 0.0)) {
        found.push_back({key_name(i),
                         formatted("is at %g s, not behind the one before at %g s", key.time_s, before.time_s),
                         "let times rise"});
        return;
    }
    const double way_m = glm::length(key.pose.position_m - before.pose.position_m);
    if (way_m > kMaxPathSpeed_m_per_s * span_s)
        found.push_back({key_name(i), formatted("jumps: %g m in %g s", way_m, span_s),
                         formatted("give it at least %.3g s, for at most %g m/s", way_m / kMaxPathSpeed_m_per_s,
                                   kMaxPathSpeed_m_per_s)});
    const double turn_rad = angle_between(before.pose.orientation, key.pose.orientation);
    if (turn_rad > kMaxTurn_rad)
        found.push_back({key_name(i), formatted("turns by %.0f degrees at once", glm::degrees(turn_rad)),
                         "add poses between, of at most 120 degrees each"});
    else if (turn_rad > kMaxPathTurn_rad_per_s * span_s)
        found.push_back({key_name(i),
                         formatted("jumps: it turns by %.0f degrees in %g s", glm::degrees(turn_rad), span_s),
                         formatted("give it at least %.3g s", turn_rad / kMaxPathTurn_rad_per_s)});
}

}  // namespace

std::vector<Problem> problems(const PathMotion& path) {
    if (path.keys.size() < 2) return {{"path", "has fewer than two poses", "give at least two, or none"}};
    if (path.keys.size() > kMaxPathKeys)
        return {{"path", formatted("has %zu poses", path.keys.size()), formatted("give at most %zu", kMaxPathKeys)}};
    std::vector<Problem> found;
    for (std::size_t i = 0; i < path.keys.size(); ++i) check_key(found, path, i);
    const Pose &first = path.keys.front().pose, &last = path.keys.back().pose;
    const bool returns = glm::length(last.position_m - first.position_m) <= kSamePlace_m &&
                         angle_between(first.orientation, last.orientation) <= kSameTurn_rad;
    if (found.empty() && path.repeats && !returns)
        found.push_back({key_name(path.keys.size() - 1), "jumps: it is not where the path begins again",
                         "end with the first pose, or write repeat = false"});
    return found;
}

namespace {

// Between the keys as they stand in the path.
Pose between_keys(const PathMotion& path, double time_s) {
    const double round_s = path.keys.back().time_s;
    if (!(time_s > 0.0)) return path.keys.front().pose;
    if (time_s >= round_s) {
        if (!path.repeats) return path.keys.back().pose;
        time_s = std::fmod(time_s, round_s);
    }
    const auto behind = std::ranges::upper_bound(path.keys, time_s, {}, &PathKey::time_s);
    const std::ptrdiff_t to =
        std::clamp<std::ptrdiff_t>(behind - path.keys.begin(), 1, static_cast<std::ptrdiff_t>(path.keys.size()) - 1);
    const Knot a = knot_at(path, to - 1), b = knot_at(path, to);
    const double span_s = b.time_s - a.time_s, s = (time_s - a.time_s) / span_s;
    const Quat turn_to = nearer_sign(b.orientation, a.orientation);
    return {hermite(a.position_m, b.position_m, linear_tangent(path, to - 1), linear_tangent(path, to), s, span_s),
            glm::normalize(hermite(a.orientation, turn_to, angular_tangent(path, to - 1, a.orientation),
                                   angular_tangent(path, to, turn_to), s, span_s))};
}

}  // namespace

Pose pose_on(const PathMotion& path, double time_s) {
    const Pose pose = between_keys(path, time_s);
    return {pose.position_m + (path.about_m - pose.orientation * path.about_m), pose.orientation};
}

HandPose grip_frame(std::span<const HandPose> parts) {
    BURIN_CHECK(!parts.empty());
    HandPose frame = parts.front();
    if (parts.size() == 1) return frame;
    Pose& pose = frame.scene_from_hand;
    const Quat first = pose.orientation;
    for (const HandPose& part : parts.subspan(1)) {
        pose.position_m += part.scene_from_hand.position_m;
        const Quat& turn = part.scene_from_hand.orientation;
        pose.orientation = pose.orientation + (glm::dot(turn, first) < 0.0 ? -turn : turn);
        frame.velocity_m_per_s += part.velocity_m_per_s;
        frame.angular_velocity_rad_per_s += part.angular_velocity_rad_per_s;
    }
    const auto count = static_cast<double>(parts.size());
    pose.position_m /= count;
    constexpr double kLeastSum = 1e-6;
    pose.orientation = glm::length(pose.orientation) > kLeastSum ? glm::normalize(pose.orientation) : first;
    frame.velocity_m_per_s /= count;
    frame.angular_velocity_rad_per_s /= count;
    return frame;
}

Velocities velocities_between(const Pose& from, const Pose& to, double time_s) {
    Velocities v;
    v.linear_m_per_s = (to.position_m - from.position_m) / time_s;
    Quat turn = to.orientation * glm::conjugate(from.orientation);
    if (turn.w < 0.0) turn = -turn;
    const Vec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    if (sine > 0.0) v.angular_rad_per_s = (2.0 * std::atan2(sine, turn.w) / (sine * time_s)) * axis;
    return v;
}

}  // namespace burin::scene

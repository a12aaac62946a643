// SPDX-License-Identifier: MIT
// How an object of a scene moves: not at all, along a path, or as a hand holds it.
//
// A path is a list of poses at times, relative to the pose that the object has without it. Between them positions and
// orientations follow cubic Hermite curves whose tangents are the differences of the neighbours (Catmull and Rom, "A
// class of local interpolating splines", 1974, for uneven times), so that the velocity is continuous: a body that is
// published a hundred times a second is then where its last velocity has taken it, to within acceleration times squared
// period. Orientations are interpolated as unit quaternions, componentwise, and normalised.
// Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "scene/haptic_material.hpp"

namespace burin::scene {

[[nodiscard]] inline Pose composed(const Pose& c_from_b, const Pose& b_from_a) {
    return {c_from_b * b_from_a.position_m, c_from_b.orientation * b_from_a.orientation};
}
[[nodiscard]] inline Pose inverse(const Pose& to_from_from) {
    const Quat back = glm::conjugate(to_from_from.orientation);
    return {-(back * to_from_from.position_m), back};
}

struct FixedMotion {
    bool operator==(const FixedMotion&) const = default;
};

struct PathKey {
    double time_s = 0.0;
    Pose pose;  // relative to the object's own

    bool operator==(const PathKey&) const = default;
};
struct PathMotion {
    std::vector<PathKey> keys;  // at least two; the first at 0 s, times rise
    bool repeats = true;  // begins again behind the last key, which then has the first one's pose; else stays there

    bool operator==(const PathMotion&) const = default;
};

struct HeldMotion {
    std::size_t hand = 0;
    Pose hand_from_object;

    bool operator==(const HeldMotion&) const = default;
};

using ObjectMotion = std::variant<FixedMotion, PathMotion, HeldMotion>;

// A body faster than this is not announced well enough to push a hand (haptics/contact/moving_bodies.hpp); a path that
// asks for more jumps.
inline constexpr double kMaxPathSpeed_m_per_s = 2.0, kMaxPathTurn_rad_per_s = 12.0;
inline constexpr std::size_t kMaxPathKeys = 10'000;

// Returns all that is wrong with a path. The keys of the problems are `path`, and `path[i]` for its i-th pose.
[[nodiscard]] std::vector<Problem> problems(const PathMotion& path);

// Returns the pose on a sound path, so long after its beginning; before it, that of the first key.
[[nodiscard]] Pose pose_on(const PathMotion& path, double time_s);

// The velocities that take one pose to another in a time above 0: of the origin, and of the shorter turn.
struct Velocities {
    Vec3 linear_m_per_s{0.0};
    Vec3 angular_rad_per_s{0.0};
};
[[nodiscard]] Velocities velocities_between(const Pose& from, const Pose& to, double time_s);

}  // namespace burin::scene

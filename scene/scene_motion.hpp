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
#include <span>
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
    Pose pose;  // relative to the object's own, which is turned about PathMotion::about_m

    bool operator==(const PathKey&) const = default;
};
struct PathMotion {
    std::vector<PathKey> keys;  // at least two; the first at 0 s, times rise
    bool repeats = true;  // begins again behind the last key, which then has the first one's pose; else stays there
    Vec3 about_m{0.0};    // what the keys turn the object about, in its own frame, scaled

    bool operator==(const PathMotion&) const = default;
};

// Held by parts of hands, by their numbers in the scene, and moved with the frame of them all (grip_frame()). A single
// part is a hand with a tool.
struct HeldMotion {
    std::vector<std::size_t> parts;  // at least one
    Pose hand_from_object;
    bool felt = false;  // by the parts that hold it, as fingertips feel what is between them; false: it would push them

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

// Where a hand is, for what it holds.
struct HandPose {
    Pose scene_from_hand;  // at its HIP
    Vec3 velocity_m_per_s{0.0};
    Vec3 angular_velocity_rad_per_s{0.0};
    Nanoseconds time_ns = 0;
};

// Returns the frame that moves with several parts of hands: in the middle of their places, turned by the normalised sum
// of their unit quaternions, each taken with the sign that is nearer to the first's (Markley et al., "Averaging
// quaternions", 2007, to first order), with the mean of their velocities and the time of the first. Of one part it is
// the part itself, to the bit. Requires at least one. Where the turns cancel each other it is turned as the first.
[[nodiscard]] HandPose grip_frame(std::span<const HandPose> parts);

// The velocities that take one pose to another in a time above 0: of the origin, and of the shorter turn.
struct Velocities {
    Vec3 linear_m_per_s{0.0};
    Vec3 angular_rad_per_s{0.0};
};
[[nodiscard]] Velocities velocities_between(const Pose& from, const Pose& to, double time_s);

}  // namespace burin::scene

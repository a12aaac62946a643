// SPDX-License-Identifier: MIT
// The rigid motion of a touched mesh: its pose and its velocity at a time, and where that takes it at another time.
//
// Frame: *mesh* is the frame in which the mesh was created; its origin is the point that moves with velocity_m_per_s
// and about which the mesh turns. A body in flight turns about its centre of mass, so its mesh should be created around
// that; a drum's around its axis. Positions in the object frame. Pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin::geometry {

struct MeshMotion {
    // The body's name, the same in each publication; each moving mesh of a surface has its own. 0: the mesh rests
    // where its pose has it, and neither velocities nor time are read.
    std::uint64_t body = 0;
    Pose object_from_mesh;
    Vec3 velocity_object_m_per_s{0.0};            // of the mesh frame's origin
    Vec3 angular_velocity_object_rad_per_s{0.0};  // axis times speed
    Nanoseconds time_ns = 0;                      // when all of this holds
};

[[nodiscard]] inline bool is_unit(const Quat& q) noexcept {
    // NaN fails this comparison.
    return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-6;
}

// Whether the motion can be computed with. A mesh whose motion cannot is not touched.
[[nodiscard]] inline bool is_sensible(const MeshMotion& motion) noexcept {
    return finite(motion.object_from_mesh.position_m) && is_unit(motion.object_from_mesh.orientation) &&
           finite(motion.velocity_object_m_per_s) && finite(motion.angular_velocity_object_rad_per_s);
}

// Moves a pose on at constant velocities.
[[nodiscard]] inline Pose moved_on(const Pose& pose, const Vec3& velocity_m_per_s, const Vec3& angular_rad_per_s,
                                   double time_s) noexcept {
    Pose moved = pose;
    moved.position_m += time_s * velocity_m_per_s;
    const double speed = std::sqrt(glm::dot(angular_rad_per_s, angular_rad_per_s));
    if (speed == 0.0) return moved;
    const double half = 0.5 * speed * time_s;
    const Vec3 axis = (std::sin(half) / speed) * angular_rad_per_s;
    moved.orientation = glm::normalize(Quat(std::cos(half), axis.x, axis.y, axis.z) * pose.orientation);
    return moved;
}

// The time for which the motion is followed to reach `now_ns`: at most longest_s either way. Then the mesh stands.
[[nodiscard]] inline double followed_s(const MeshMotion& motion, Nanoseconds now_ns, double longest_s) noexcept {
    return std::clamp(seconds(now_ns - motion.time_ns), -longest_s, longest_s);
}

}  // namespace burin::geometry

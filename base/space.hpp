// SPDX-License-Identifier: MIT
// Vectors, rotations, poses and the frames they live in.
//
// Units are SI. All frames are right-handed with +Y up. Frames (a name carries its frame: tip_world, head_wall):
//   world      the wall's own: origin at the middle of the wall's lower edge on the floor line, +X right, +Y up,
//              +Z towards the viewer
//   object     the workpiece's own, in the units and with the origin of its file (metres)
//   device     the haptic device's own: origin at the middle of its workspace, +Z towards the user
//   eye, clip  renderer only
// A transform is named right to left: p_world = world_from_object * p_object.
#pragma once

#define GLM_FORCE_SILENT_WARNINGS
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace burin {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec3f = glm::vec3;
using Mat4 = glm::dmat4;
using Quat = glm::dquat;  // glm stores w, x, y, z; files list x, y, z, w

// A rigid transform: rotate, then translate.
struct Pose {
    Vec3 position_m{0.0};
    Quat orientation{1.0, 0.0, 0.0, 0.0};

    bool operator==(const Pose&) const = default;
};

[[nodiscard]] inline Vec3 operator*(const Pose& to_from_from, const Vec3& p) {
    return to_from_from.orientation * p + to_from_from.position_m;
}

// Rotation, uniform scale and translation: to = position + scale * (orientation * from).
// The scale is dimensionless and positive.
struct Similarity {
    Vec3 position_m{0.0};
    Quat orientation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;

    bool operator==(const Similarity&) const = default;
};

[[nodiscard]] inline Vec3 operator*(const Similarity& s, const Vec3& p) {
    return s.position_m + s.scale * (s.orientation * p);
}

// Transforms differences (velocities, directions): rotation and scale, no translation.
[[nodiscard]] inline Vec3 apply_to_vector(const Similarity& s, const Vec3& v) { return s.scale * (s.orientation * v); }

[[nodiscard]] inline Similarity inverse(const Similarity& s) {
    const Quat back = glm::conjugate(s.orientation);
    return {-(back * s.position_m) / s.scale, back, 1.0 / s.scale};
}

[[nodiscard]] inline Similarity operator*(const Similarity& c_from_b, const Similarity& b_from_a) {
    return {c_from_b * b_from_a.position_m, c_from_b.orientation * b_from_a.orientation,
            c_from_b.scale * b_from_a.scale};
}

[[nodiscard]] inline Mat4 matrix(const Similarity& s) {
    Mat4 m = glm::mat4_cast(s.orientation) * s.scale;
    m[3] = glm::dvec4(s.position_m, 1.0);
    return m;
}

// An axis-aligned box; empty when any lo > hi.
struct Box {
    Vec3 lo{1.0};
    Vec3 hi{-1.0};

    bool operator==(const Box&) const = default;
    [[nodiscard]] bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
    [[nodiscard]] Vec3 extent() const { return hi - lo; }
    [[nodiscard]] Vec3 center() const { return 0.5 * (lo + hi); }
    void include(const Vec3& p) {
        if (empty()) {
            lo = hi = p;
        } else {
            lo = glm::min(lo, p);
            hi = glm::max(hi, p);
        }
    }
};

// Check whether numbers from outside are fit for computation.
[[nodiscard]] inline bool finite(const Vec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

[[nodiscard]] inline bool not_negative(double x) noexcept { return std::isfinite(x) && x >= 0.0; }

[[nodiscard]] inline bool not_negative(const Vec3& v) noexcept {
    return not_negative(v.x) && not_negative(v.y) && not_negative(v.z);
}

}  // namespace burin

// SPDX-License-Identifier: MIT
#include "base/pose_motion.hpp"

namespace burin {

Vec3 rotation_vector(const Quat& q) {
    const Quat p = q.w < 0.0 ? -q : q;  // the shorter way round
    const Vec3 v{p.x, p.y, p.z};
    const double sine = glm::length(v);
    return sine < 1e-12 ? 2.0 * v : v * (2.0 * std::atan2(sine, p.w) / sine);
}

Quat rotation_by(const Vec3& vector_rad) {
    const double angle = glm::length(vector_rad);
    return angle < 1e-12 ? Quat{1.0, 0.0, 0.0, 0.0} : glm::angleAxis(angle, vector_rad / angle);
}

Vec3 rotation_vector_between(const Quat& from, const Quat& to) { return rotation_vector(to * glm::conjugate(from)); }

Vec3 at_most(const Vec3& v, double length) {
    const double l = glm::length(v);
    return l <= length ? v : v * (length / l);
}

PoseVelocity velocity_of(const VelocityWindow& window, std::span<const TimedPose> samples) {
    if (samples.empty()) return {};
    const TimedPose& newest = samples.back();
    double n = 0.0, sum_t = 0.0, sum_tt = 0.0;
    Vec3 sum_p(0.0), sum_tp(0.0), sum_r(0.0), sum_tr(0.0);
    for (std::size_t i = samples.size(); i-- > 0;) {
        const TimedPose& sample = samples[i];
        const Nanoseconds age_ns = newest.time_ns - sample.time_ns;
        if (age_ns > window.window_ns && (n >= 2.0 || age_ns > window.oldest_ns)) break;
        const double t = -seconds(age_ns);
        const Vec3 p = sample.pose.position_m - newest.pose.position_m;
        const Vec3 r = rotation_vector_between(newest.pose.orientation, sample.pose.orientation);
        n += 1.0, sum_t += t, sum_tt += t * t;
        sum_p += p, sum_tp += t * p, sum_r += r, sum_tr += t * r;
    }
    const double spread = n * sum_tt - sum_t * sum_t;
    if (n < 2.0 || !(spread > 0.0)) return {};
    return {true, at_most((n * sum_tp - sum_t * sum_p) / spread, window.max_speed_m_per_s),
            at_most((n * sum_tr - sum_t * sum_r) / spread, window.max_turn_rad_per_s)};
}

Pose moved(const Pose& pose, const PoseVelocity& velocity, double ahead_s) {
    return {pose.position_m + velocity.m_per_s * ahead_s,
            glm::normalize(rotation_by(velocity.rad_per_s * ahead_s) * pose.orientation)};
}

}  // namespace burin

// SPDX-License-Identifier: MIT
#include "devices/hand/simulated_hand.hpp"

#include <algorithm>
#include <cmath>

#include "base/space.hpp"
#include "base/try.hpp"
#include "devices/hand/quaternion_path.hpp"

namespace burin::devices {
namespace {

// Fritsch and Carlson, in the weighted harmonic form of Fritsch and Butland 1984: zero at an extremum, else between
// the neighbouring secants so that no piece overshoots.
double monotone_slope(double secant_before, double secant_after, double dt_before, double dt_after) {
    if (secant_before * secant_after <= 0.0) return 0.0;
    const double w1 = 2.0 * dt_after + dt_before;
    const double w2 = dt_after + 2.0 * dt_before;
    return (w1 + w2) / (w1 / secant_before + w2 / secant_after);
}

std::vector<Vec3> monotone_slopes(const std::vector<HandPose>& script) {
    std::vector<Vec3> slopes(script.size(), Vec3(0.0));  // the ends start and stop at rest
    for (std::size_t i = 1; i + 1 < script.size(); ++i) {
        const double before = script[i].time_s - script[i - 1].time_s;
        const double after = script[i + 1].time_s - script[i].time_s;
        const Vec3 s0 = (script[i].position_device_m - script[i - 1].position_device_m) / before;
        const Vec3 s1 = (script[i + 1].position_device_m - script[i].position_device_m) / after;
        for (int axis = 0; axis < 3; ++axis) slopes[i][axis] = monotone_slope(s0[axis], s1[axis], before, after);
    }
    return slopes;
}

std::string at_pose(std::size_t i) { return "hand script, pose " + std::to_string(i + 1); }

Result<void> check(const std::vector<HandPose>& script) {
    if (script.empty()) return fail("hand script", "there is no pose", "give at least one");
    for (std::size_t i = 0; i < script.size(); ++i) {
        const HandPose& pose = script[i];
        if (!std::isfinite(pose.time_s) || !finite(pose.position_device_m))
            return fail(at_pose(i), "a number is not finite", "correct it");
        const double l2 = length2(pose.orientation_device);
        if (!(l2 > 1e-12) || !std::isfinite(l2))
            return fail(at_pose(i), "the orientation is no rotation", "use a quaternion whose length is not 0");
        if (i > 0 && !(pose.time_s > script[i - 1].time_s))
            return fail(at_pose(i), "its time does not come after the one before", "sort the poses by time");
    }
    return {};
}

}  // namespace

Result<SimulatedHand> SimulatedHand::create(std::vector<HandPose> script, HandPath path, HandGrip grip) {
    BURIN_TRY_DO(check(script));
    if (!is_sensible(grip))
        return fail("hand grip", "mass, stiffness and damping must be finite and not negative", "correct them");
    for (HandPose& pose : script)
        pose.orientation_device = scaled(pose.orientation_device, 1.0 / std::sqrt(length2(pose.orientation_device)));
    SimulatedHand hand;
    if (path == HandPath::monotone_cubic) hand.slopes_m_per_s_ = monotone_slopes(script);
    hand.script_ = std::move(script);
    hand.path_ = path;
    hand.grip_ = grip;
    return hand;
}

HandTarget SimulatedHand::target(double time_s) const noexcept {
    const auto after = std::upper_bound(script_.begin(), script_.end(), time_s,
                                        [](double t, const HandPose& pose) { return t < pose.time_s; });
    if (after == script_.begin() || after == script_.end()) {
        const HandPose& end = after == script_.begin() ? script_.front() : script_.back();
        return {end.position_device_m, Vec3(0.0), end.orientation_device, end.buttons};
    }
    const HandPose& a = *(after - 1);
    const HandPose& b = *after;
    const double dt = b.time_s - a.time_s;
    const double u = (time_s - a.time_s) / dt;
    const Vec3 step = b.position_device_m - a.position_device_m;
    HandTarget target{a.position_device_m + u * step, step / dt,
                      normalised_lerp(a.orientation_device, b.orientation_device, u), a.buttons};
    if (path_ == HandPath::monotone_cubic) {
        const auto i = static_cast<std::size_t>(after - script_.begin()) - 1;
        const Vec3 m0 = slopes_m_per_s_[i] * dt, m1 = slopes_m_per_s_[i + 1] * dt;
        // p(u) = p0 + u m0 + u^2 (3 step - 2 m0 - m1) + u^3 (m0 + m1 - 2 step)
        const Vec3 c2 = 3.0 * step - 2.0 * m0 - m1, c3 = m0 + m1 - 2.0 * step;
        target.position_device_m = a.position_device_m + u * (m0 + u * (c2 + u * c3));
        target.velocity_device_m_per_s = (m0 + u * (2.0 * c2 + u * (3.0 * c3))) / dt;
    }
    return target;
}

}  // namespace burin::devices

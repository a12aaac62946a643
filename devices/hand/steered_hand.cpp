// SPDX-License-Identifier: MIT
#include "devices/hand/steered_hand.hpp"

#include <algorithm>
#include <cmath>

#include "base/space.hpp"
#include "devices/hand/quaternion_path.hpp"

namespace burin::devices {
namespace {

constexpr double kStep_s = 50e-6;
static_assert(SteeredHand::kStep_ns == 50'000);

double length(const Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

Vec3 shortened(const Vec3& v, double longest) {
    const double l = length(v);
    return l > longest ? v * (longest / l) : v;
}

bool is_pose(const Vec3& position, const Quat& orientation) {
    const double l2 = length2(orientation);
    return finite(position) && std::isfinite(l2) && l2 > 1e-12;
}

bool positive(double x) { return std::isfinite(x) && x > 0.0; }

}  // namespace

Result<SteeredHand> SteeredHand::create(HandSteering* channel, const HandTarget& start, const SteeringLimits& limits,
                                        HandGrip grip) {
    if (channel == nullptr) return fail("steered hand", "there is no channel for its targets", "give it one");
    if (!is_pose(start.position_device_m, start.orientation_device))
        return fail("steered hand", "its start is no pose",
                    "use finite numbers and a quaternion whose length is not 0");
    if (!positive(limits.speed_m_per_s) || !positive(limits.acceleration_m_per_s2) || !positive(limits.lag_s))
        return fail("steered hand", "speed, acceleration and lag must be finite and positive", "correct them");
    if (limits.lag_s < kStep_s) return fail("steered hand", "its lag is shorter than its step", "use at least 50 us");
    if (!not_negative(grip.mass_kg) || !not_negative(grip.stiffness_N_per_m) || !not_negative(grip.damping_Ns_per_m))
        return fail("hand grip", "mass, stiffness and damping must be finite and not negative", "correct them");
    SteeredHand hand;
    hand.channel_ = channel;
    hand.limits_ = limits;
    hand.grip_ = grip;
    hand.hand_ = start;
    hand.hand_.velocity_device_m_per_s = Vec3(0.0);
    hand.hand_.orientation_device = normalised(start.orientation_device);
    hand.from_ = hand.to_ = {start.position_device_m, hand.hand_.orientation_device};
    hand.buttons_at_goal_ = start.buttons;
    return hand;
}

HandTarget SteeredHand::target(double time_s) noexcept {
    const Nanoseconds asked_ns = nanoseconds(time_s);
    take_newest();
    if (asked_ns - time_ns_ > kMostCatchUp_ns) {  // after a pause the goal has waited as the hand did
        const Nanoseconds lost_ns = asked_ns - time_ns_ - kMostCatchUp_ns;
        time_ns_ += lost_ns;
        set_out_ns_ += lost_ns;
    }
    while (time_ns_ + kStep_ns <= asked_ns) step();
    return hand_;
}

void SteeredHand::take_newest() noexcept {
    const SteeredTarget& newest = channel_->newest();
    if (newest.sequence == sequence_) return;
    const bool first = sequence_ == 0;
    sequence_ = newest.sequence;
    if (!is_pose(newest.position_device_m, newest.orientation_device)) {
        ++refused_;
        return;
    }
    from_ = goal();
    to_ = {newest.position_device_m, normalised(newest.orientation_device)};
    set_out_ns_ = time_ns_;
    interval_ns_ =
        first ? kLeastInterval_ns : std::clamp(newest.time_ns - stamp_ns_, kLeastInterval_ns, kMostInterval_ns);
    stamp_ns_ = newest.time_ns;
    hand_.buttons = buttons_at_goal_;  // the last target's buttons take effect even if its goal was cut short
    buttons_at_goal_ = newest.buttons;
}

SteeredHand::Goal SteeredHand::goal() const noexcept {
    const Nanoseconds gone_ns = time_ns_ - set_out_ns_;
    if (gone_ns >= interval_ns_) return to_;
    const double u = static_cast<double>(gone_ns) / static_cast<double>(interval_ns_);
    return {from_.position_m + u * (to_.position_m - from_.position_m),
            normalised_lerp(from_.orientation, to_.orientation, u)};
}

void SteeredHand::step() noexcept {
    time_ns_ += kStep_ns;
    const Goal now = goal();
    const Vec3 way = now.position_m - hand_.position_device_m;
    const double distance = length(way);
    Vec3 wanted(0.0);
    if (distance > 0.0) {
        const double a = limits_.acceleration_m_per_s2;
        const double speed = std::min({limits_.speed_m_per_s, distance / limits_.lag_s, std::sqrt(a * distance)});
        wanted = way * (speed / distance);
    }
    Vec3& v = hand_.velocity_device_m_per_s;
    v += shortened(wanted - v, kStep_s * limits_.acceleration_m_per_s2);
    hand_.position_device_m += kStep_s * v;
    hand_.orientation_device = now.orientation;  // the wrist is free and has no mass to limit
    if (time_ns_ - set_out_ns_ >= interval_ns_) hand_.buttons = buttons_at_goal_;
}

}  // namespace burin::devices

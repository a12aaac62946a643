// SPDX-License-Identifier: MIT
#include "bodies/body_frame.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/gloves/glove_hand.hpp"

namespace burin::bodies {
namespace {

// The palm as a fingertip's tick tells it; of a part that is no finger of a glove the part itself.
Pose scene_from_palm(std::size_t finger, const haptics::TickRecord& tick) {
    const Similarity& map = tick.motion.object_from_device;
    const auto& sample = tick.sample;
    Pose palm{sample.position_device_m, sample.orientation_device};
    if (finger < devices::kGloveFingers) {
        devices::FingerAngles bend{};
        std::copy_n(sample.joints.begin(), bend.size(), bend.begin());
        const Pose tip = devices::place_of(devices::usual_hand()[finger], bend).hand_from_tip;
        palm.orientation = glm::normalize(sample.orientation_device * glm::conjugate(tip.orientation));
        palm.position_m = sample.position_device_m - palm.orientation * tip.position_m;
    }
    return {map * palm.position_m, glm::normalize(map.orientation * palm.orientation)};
}

}  // namespace

void BodyFrame::take_tick(std::size_t hand, const haptics::TickRecord& newest) {
    const Known known{scene_from_palm(hand, newest), newest.time_ns};
    if (finite(known.scene_from_palm.position_m)) hands_[hand] = known;
}

std::optional<BodyFrame::Known> BodyFrame::palm_of(std::span<const std::size_t> hands) const {
    std::vector<scene::HandPose> poses;
    for (const std::size_t hand : hands) {
        const auto known = hands_.find(hand);
        if (known == hands_.end()) return std::nullopt;
        poses.push_back({.scene_from_hand = known->second.scene_from_palm, .time_ns = known->second.time_ns});
    }
    if (poses.empty()) return std::nullopt;
    const scene::HandPose palm = scene::grip_frame(poses);
    return Known{palm.scene_from_hand, palm.time_ns};
}

void BodyFrame::take_hold(std::span<const std::size_t> hands, const std::optional<Vec3>& seat_palm_m) {
    const auto palm = palm_of(hands);
    if (!palm) return;
    held_by_.assign(hands.begin(), hands.end());
    palm_from_body_ = scene::composed(scene::inverse(palm->scene_from_palm), pose_);
    seat_palm_m_ = seat_palm_m;
    flying_.reset();
    been_.clear();
}

void BodyFrame::let_go() {
    if (!is_held()) return;
    held_by_.clear();
    velocities_ = {};
    FlyingBall ball{pose_.position_m, Vec3(0.0), {}};
    if (been_.size() > 1 && flown_to_ns_ - been_.back().time_ns <= kThrow_ns) {
        const double over_s = seconds(been_.back().time_ns - been_.front().time_ns);
        ball.velocity_m_per_s = scene::velocities_between(been_.front().pose, been_.back().pose, over_s).linear_m_per_s;
    }
    fly(ball, flown_to_ns_);
}

void BodyFrame::fly(const FlyingBall& ball, Nanoseconds at_ns, bool is_pushed) {
    if (!room_) return put(ball.place_m);
    held_by_.clear();
    flying_ = ball;
    is_pushed_ = is_pushed;
    flown_to_ns_ = at_ns;
    pose_.position_m = ball.place_m;
    velocities_ = {ball.velocity_m_per_s, Vec3(0.0)};
}

void BodyFrame::put(const Vec3& place_m) {
    held_by_.clear();
    flying_.reset();
    pose_.position_m = place_m;
    velocities_ = {};
}

void BodyFrame::use(std::optional<FlightRoom> room) {
    room_ = std::move(room);
    if (!flying_) return;
    flying_->support.reset();  // a number among the obstacles before
    if (!room_) put(flying_->place_m);
}

// Goes in steps of a quarter of its radius, each out of what it has come into: so it passes through nothing, however
// thin.
Vec3 BodyFrame::led_to(const Vec3& place_m) const {
    if (!room_ || room_->obstacles.empty()) return place_m;
    constexpr double kMostSteps = 256.0;
    const Vec3 way_m = place_m - pose_.position_m;
    const double steps = std::clamp(std::ceil(4.0 * glm::length(way_m) / room_->radius_m), 1.0, kMostSteps);
    Vec3 at_m = pose_.position_m;
    bool is_free = true;
    for (double step = 0.0; step < steps; ++step) {
        const Vec3 next_m = at_m + way_m / steps;
        at_m = outside(*room_, next_m);
        is_free = is_free && at_m == next_m;
    }
    return is_free ? place_m : at_m;
}

void BodyFrame::follow_hand() {
    const auto palm = palm_of(held_by_);
    if (!palm) return;
    if (seat_palm_m_ && !been_.empty()) {
        const Vec3 way_m = *seat_palm_m_ - palm_from_body_.position_m;
        const double far_m = glm::length(way_m);
        const double step_m = kSeats_m_per_s * std::max(seconds(palm->time_ns - been_.back().time_ns), 0.0);
        palm_from_body_.position_m += far_m > step_m ? step_m / far_m * way_m : way_m;
    }
    Pose wanted = scene::composed(palm->scene_from_palm, palm_from_body_);
    wanted.position_m = led_to(wanted.position_m);
    pose_ = {wanted.position_m, glm::normalize(wanted.orientation)};
    if (!been_.empty() && palm->time_ns <= been_.back().time_ns) {
        velocities_ = {};  // no news: it stands still
        return;
    }
    velocities_ = been_.empty() ? scene::Velocities{}
                                : scene::velocities_between(been_.back().pose, pose_,
                                                            seconds(palm->time_ns - been_.back().time_ns));
    been_.push_back({pose_, palm->time_ns});
    // The older of the two newest poses gives the velocity, even where updates come late.
    const auto is_old = [&](const Been& been) {
        const bool is_needed = &been + 2 >= been_.data() + been_.size();
        return palm->time_ns - been.time_ns > (is_needed ? kLate_ns : kThrow_ns);
    };
    been_.erase(been_.begin(), std::ranges::find_if_not(been_, is_old));
}

// What pushes it changes the velocity first, as a step of its solver does.
void BodyFrame::fly_on(Nanoseconds now_ns, const Vec3& push_m_per_s2) {
    if (now_ns <= flown_to_ns_) return;
    const double time_s = seconds(now_ns - flown_to_ns_);
    if (is_pushed_ && push_m_per_s2 != Vec3(0.0)) {
        flying_->velocity_m_per_s += std::min(time_s, kMostPush_s) * push_m_per_s2;
        flying_->support.reset();
    }
    flying_ = flight_of(*flying_, *room_, time_s).ball;
    pose_.position_m = flying_->place_m;
    velocities_ = {flying_->velocity_m_per_s, Vec3(0.0)};
}

void BodyFrame::land() {
    if (!flying_ || !flying_->rests()) return;
    flying_.reset();
    velocities_ = {};
}

void BodyFrame::update(Nanoseconds now_ns, const Vec3& push_m_per_s2) {
    if (is_held()) follow_hand();
    if (flying_) fly_on(now_ns, push_m_per_s2);
    if (!flying_ || now_ns > flown_to_ns_) flown_to_ns_ = now_ns;
    land();
}

}  // namespace burin::bodies

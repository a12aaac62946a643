// SPDX-License-Identifier: MIT
// Where a body as a whole is: at its place, in a hand, or in flight. The body's solver works in this frame.
//
//   stands  at its place, and whatever presses it is held by springs there
//   held    with the palm of the hand that holds it, as it lay in it when it was taken; what it falls among stops it,
//           so that it slides along there and comes back into the palm when the way is free
//   flies   a ball in closed form (bodies/flight/ball_flight.hpp), pushed by what touches it; where it comes to rest,
//           it stands
// A change from one to another leaves place and velocity as they are, so the force on a finger goes on without a step.
// The palm is the one of the glove that the fingertips' joints tell (devices/gloves/glove_hand.hpp): fingertips that
// close on a body move against it, and the body does not go with them. A part without joints carries the body itself.
// Frame: the scene's. Deterministic; one thread, the scene's. Allocates in flight.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "bodies/flight/ball_flight.hpp"
#include "haptics/tick_record.hpp"
#include "scene/scene_motion.hpp"

namespace burin::bodies {

class BodyFrame {
public:
    // A ball that is let go of flies with the mean velocity of this time, or of that between its last two updates where
    // these are up to kLate_ns apart; without one where the hand has told nothing for kThrow_ns.
    static constexpr Nanoseconds kThrow_ns = 20'000'000, kLate_ns = 100'000'000;
    static constexpr double kSeats_m_per_s = 0.15;
    // A push counts for so long at most, however late an update comes: it is known as of the update before.
    static constexpr double kMostPush_s = 0.016;

    // room: what it falls among; none: it stays where a hand has left it.
    BodyFrame(const Pose& stands, std::optional<FlightRoom> room) : pose_(stands), room_(std::move(room)) {}

    void take_tick(std::size_t hand, const haptics::TickRecord& newest);
    // Has it move with parts of one hand from where they and it are then; or leaves it, with the velocity that it has.
    // With no part that is known it stays as it is. seat_palm_m: where its middle comes to lie in the palm, at
    // kSeats_m_per_s, as fingers draw in what they close on; none: where it was.
    void take_hold(std::span<const std::size_t> hands, const std::optional<Vec3>& seat_palm_m = std::nullopt);
    void let_go();
    // Puts it into flight as of a time. is_pushed: what touches it in flight turns its way.
    void fly(const FlyingBall& ball, Nanoseconds at_ns, bool is_pushed = true);
    // Puts it to a place, where it stands.
    void put(const Vec3& place_m);
    // What it falls among from now on. What rolls has to find anew what bears it.
    void use(std::optional<FlightRoom> room);

    // Brings it to a time. push_m_per_s2: the acceleration by what touched it since the last update; only what flies
    // follows it.
    void update(Nanoseconds now_ns, const Vec3& push_m_per_s2);

    [[nodiscard]] const Pose& pose() const { return pose_; }
    [[nodiscard]] Vec3 velocity_at(const Vec3& place_scene_m) const {
        return velocities_.linear_m_per_s + glm::cross(velocities_.angular_rad_per_s, place_scene_m - pose_.position_m);
    }
    [[nodiscard]] bool stands() const { return held_by_.empty() && !flying_; }
    [[nodiscard]] bool is_held() const { return !held_by_.empty(); }
    [[nodiscard]] bool flies() const { return flying_.has_value(); }
    // Returns how it lies in the palm that holds it; nothing where none does.
    [[nodiscard]] std::optional<Pose> palm_from_body() const {
        return is_held() ? std::optional(palm_from_body_) : std::nullopt;
    }

private:
    struct Known {
        Pose scene_from_palm;
        Nanoseconds time_ns = 0;
    };
    struct Been {
        Pose pose;
        Nanoseconds time_ns = 0;
    };
    [[nodiscard]] std::optional<Known> palm_of(std::span<const std::size_t> hands) const;
    void follow_hand();
    // Returns where it comes from its place on the way to another, as far as what it falls among lets it.
    [[nodiscard]] Vec3 led_to(const Vec3& place_m) const;
    void fly_on(Nanoseconds now_ns, const Vec3& push_m_per_s2);
    void land();

    Pose pose_;
    scene::Velocities velocities_;
    std::optional<FlightRoom> room_;
    std::map<std::size_t, Known> hands_;
    std::vector<std::size_t> held_by_;
    Pose palm_from_body_;
    std::optional<Vec3> seat_palm_m_;
    std::vector<Been> been_;  // while it is held, the newest last: those of the last kThrow_ns, two at least
    std::optional<FlyingBall> flying_;
    bool is_pushed_ = true;        // in flight
    Nanoseconds flown_to_ns_ = 0;  // or to when it has come otherwise
};

}  // namespace burin::bodies

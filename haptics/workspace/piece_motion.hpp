// SPDX-License-Identifier: MIT
// The motion of the piece under a hand: a mapping that is published once a picture, followed from tick to tick.
//
// The contact is felt in the piece's own frame, so a piece that somebody turns or carries is a mapping object_from_device
// that changes, some sixty times a second. Each change used to start contact afresh, so that a turned piece was felt
// with less than half of its force. Now the tick leads the mapping to the one published last, along the screw between
// both, at a constant velocity, and the piece is a body that moves with this velocity (docs/decisions/021-moving-bodies.md).
//
// It is interpolated, not foretold: a piece that stops has never been felt beyond where it stopped. The way to a
// published mapping takes kSpread times as long as the last two were apart, so that one which is a little late finds
// the piece still moving; a steady motion is felt at its own velocity after three of them, and late by as much.
//
// Not followed, but set at once (WorkspaceStep::jumped), is what somebody placed otherwise (WorkspaceSettings::placed),
// and what would go too far at once (kFarthestStep_m, kFarthestTurn_rad, kMostGrowth).
// Frames: object and device. Pure; no clock, heap, lock or throw; a few dozen operations.
#pragma once

#include "base/space.hpp"

namespace burin::haptics {

// What is followed in one change, at the hand: as far as a body that moves may be from where it was expected
// (kElsewhere_m, haptics/contact/moving_bodies.hpp), as far as a fast wrist turns in two pictures, and a tenth larger.
inline constexpr double kFarthestStep_m = 0.02, kFarthestTurn_rad = 0.35, kMostGrowth = 1.1;
// Faster than this, at the hand, no mapping is followed: it comes later then.
inline constexpr double kFastestPiece_m_per_s = 1.0;

// The velocity of the piece's points as they pass the device, by their place there.
struct PieceMotion {
    Vec3 velocity_device_m_per_s{0.0};  // at the device's origin
    Vec3 angular_velocity_device_rad_per_s{0.0};
    double growth_per_s = 0.0;

    [[nodiscard]] Vec3 at(const Vec3& place_device_m) const noexcept {
        return velocity_device_m_per_s + glm::cross(angular_velocity_device_rad_per_s, place_device_m) +
               growth_per_s * place_device_m;
    }
};

// A mapping on its way to the one that was published last.
struct FollowedPiece {
    Similarity object_from_device;  // now
    double left_s = 0.0;            // until it is there; 0: it is
    double since_s = 1.0;           // since the last one was published
};

// Tells whether the mapping may go from where it is to `published` as a motion, with the hand at this place.
[[nodiscard]] bool is_motion(const FollowedPiece& state, const Similarity& published,
                             const Vec3& position_device_m) noexcept;
// Has it begin to go there.
[[nodiscard]] FollowedPiece led_to(FollowedPiece state, const Similarity& published,
                                   const Vec3& position_device_m) noexcept;
// Goes on for a tick; exactly `published` at its end.
[[nodiscard]] FollowedPiece followed(FollowedPiece state, const Similarity& published, double dt_s) noexcept;

// The velocity of a piece whose mapping was `before` a tick ago.
[[nodiscard]] PieceMotion motion_of_piece(const Similarity& before, const Similarity& now, double dt_s) noexcept;

}  // namespace burin::haptics

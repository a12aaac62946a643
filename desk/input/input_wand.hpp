// SPDX-License-Identifier: MIT
// Moves, turns and scales the scene by hand: pure functions on world_from_scene, and what two tracked wands do with
// them.
//
//   one wand holds          the scene moves with it as if fastened to it; its stick forwards enlarges it and backwards
//                           shrinks it, about the wand
//   two wands hold          the points grabbed stay in both hands: the scene moves, turns and scales with them
//   stick, nothing held     forwards flies where the wand points (its -Z), sideways turns the scene about the viewer
//   reset button            the scene returns to its start
// A hold is lost with the tracker and taken up again where the wand reappears, so the scene never jumps. Frames: world;
// metres, radians.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/space.hpp"
#include "session/input/input_event.hpp"

namespace burin::session {

// Moves the scene in the world.
[[nodiscard]] Similarity moved_by(const Similarity& world_from_scene, const Vec3& by_world_m);
// Turns or scales the scene about a point that stays where it is in the world. turn is a unit quaternion; factor > 0.
[[nodiscard]] Similarity turned_about(const Similarity& world_from_scene, const Vec3& point_world, const Quat& turn);
[[nodiscard]] Similarity scaled_about(const Similarity& world_from_scene, const Vec3& point_world, double factor);

// A scene held by one wand. What was at the wand stays at it; a wand that does not move gives exactly the same scene.
struct WandGrab {
    Pose world_from_wand;
    Similarity world_from_scene;
};
[[nodiscard]] Similarity carried(const WandGrab& grab, const Pose& world_from_wand_now);

// A scene held by two wands: the points at both stay there while the scale is within its limits; beyond them only the
// middle between the two does. Hands less than 2 cm apart only move the scene.
struct TwoWandGrab {
    std::array<Vec3, 2> wands_world{};
    Similarity world_from_scene;
};
[[nodiscard]] Similarity carried(const TwoWandGrab& grab, const std::array<Vec3, 2>& wands_world_now,
                                 double least_scale, double most_scale);

struct WandSettings {
    std::uint32_t grab_button = 0, reset_button = 3;
    double stick_dead_zone = 0.15;  // of 1; beyond it the effect grows from 0
    double fly_speed_m_per_s = 1.0;
    double turn_speed_rad_per_s = 0.8;
    double scale_rate_per_s = 0.7;  // of the natural logarithm: doubles in a second
    double least_scale = 0.01, most_scale = 100.0;
    double farthest_m = 25.0;  // from the world's origin: a wand farther away counts as not tracked
    Similarity home_world_from_scene;
};

struct WandNow {
    Pose pose_world;
    bool tracked = false;
    double too_far_m = 0.0;  // how far away its tracker has it, where that cannot be; 0: it can
    std::uint32_t buttons = 0;
    Vec2 stick{0.0};
};
struct WandState {
    std::array<WandNow, 2> wands;
    std::array<bool, 2> holding{};
    std::optional<WandGrab> one;  // hold of one wand alone
    std::optional<TwoWandGrab> both;
};

struct WandStep {
    WandState state;
    Similarity world_from_scene;
};
// Applies one step's events of wands 0 and 1. dt_s: time since the step before, not negative.
[[nodiscard]] WandStep step_wands(WandState state, std::span<const InputEvent> events, double dt_s,
                                  const Similarity& world_from_scene, const Pose& head_world,
                                  const WandSettings& settings = {});

}  // namespace burin::session

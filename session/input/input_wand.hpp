// SPDX-License-Identifier: MIT
// Moving, turning and scaling the scene by hand: pure functions on world_from_scene, and what two tracked wands do with them.
//
//   one wand holds          the scene moves with it as if fastened to it; its stick forwards enlarges, backwards shrinks it about
//                           the wand
//   two wands hold          the places grabbed stay in both hands: the scene moves, turns and scales with them
//   stick, nothing held     forwards flies where the wand points (its own -Z), sideways turns the scene about the viewer
//   reset button            the scene is as at the start
// A hold is lost with the tracker and taken up again where the wand reappears, so nothing leaps. Frames: world; metres, radians.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "app/session/input_event.hpp"
#include "base/space.hpp"

namespace burin {

[[nodiscard]] Similarity moved_by(const Similarity& world_from_scene, const Vec3& by_world_m);
// The point stays where it is in the world. turn is a unit quaternion; factor > 0.
[[nodiscard]] Similarity turned_about(const Similarity& world_from_scene, const Vec3& point_world, const Quat& turn);
[[nodiscard]] Similarity scaled_about(const Similarity& world_from_scene, const Vec3& point_world, double factor);

// A scene held by one wand. What was under the wand stays under it; no motion gives exactly the scene as it was.
struct WandGrab {
    Pose world_from_wand;
    Similarity world_from_scene;
};
[[nodiscard]] Similarity carried(const WandGrab& grab, const Pose& world_from_wand_now);

// A scene held by two: the points under both stay there while the scale is within its limits; then the middle between them does.
// Hands less than 2 cm apart only move it.
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
    Similarity home_world_from_scene;
};

struct WandNow {
    Pose pose_world;
    bool tracked = false;
    std::uint32_t buttons = 0;
    Vec2 stick{0.0};
};
struct WandState {
    std::array<WandNow, 2> wands;
    std::array<bool, 2> holding{};
    std::optional<WandGrab> one;  // of the wand that holds alone
    std::optional<TwoWandGrab> both;
};

struct WandStep {
    WandState state;
    Similarity world_from_scene;
};
// Wands 0 and 1 of the events count. dt_s: since the step before, not negative.
[[nodiscard]] WandStep step_wands(WandState state, std::span<const InputEvent> events, double dt_s,
                                  const Similarity& world_from_scene, const Pose& head_world,
                                  const WandSettings& settings = {});

}  // namespace burin

// SPDX-License-Identifier: MIT
#include "bench/workspace/workspace_strategy.hpp"

#include <algorithm>
#include <cmath>

namespace burin::bench {
namespace {

constexpr double kUsed = 0.95;      // share of the workspace's half extents: the hand stays off the hard stops
constexpr double kNear_m = 0.012;   // a border counts as reached: the precision of a swift movement
constexpr double kSeen_m = 0.0015;  // a smaller error is not seen from 2 m away (2.6 minutes of arc)
constexpr double kThere_m = 0.010;  // within this distance the hand moves the tool itself, and the workspace no more
constexpr double kBetweenTaps_s = 0.1;  // 0.3 s a tap including press and release: a slow double click
constexpr double kSteer_s = 0.1;        // interval between corrections of a rate
constexpr double kArrive_s = 0.5;       // time that a chosen rate should take for the remaining distance
constexpr double kCreep_m = 0.003;      // beyond the bubble: 2.7 mm/s
constexpr double kStir_m = 0.025;       // half of the stroke to and fro

}  // namespace

std::vector<Approach> all_approaches() {
    using enum haptics::WorkspaceTechnique;
    return {{"fixed", fixed},         {"scaling", scaling},           {"clutching", clutching},
            {"moving, taps", moving}, {"moving, drag", moving, true}, {"bubble", bubble},
            {"drift", drift}};
}

Strategist::Strategist(const Approach& approach, const haptics::WorkspaceSettings& settings)
    : approach_(approach), settings_(settings), half_m_(0.5 * settings.workspace_device_m) {
    Similarity map = settings.object_from_device;
    if (approach.technique == haptics::WorkspaceTechnique::scaling) map.scale *= settings.scaling_gain;
    device_from_object_ = inverse(map);
}

Vec3 Strategist::in_device(const Vec3& difference_object_m) const {
    return apply_to_vector(device_from_object_, difference_object_m);
}

bool Strategist::within_box(const Vec3& p, double share) const {
    return glm::all(glm::lessThanEqual(glm::abs(p), share * half_m_));
}

// Returns where the line from the middle to p leaves the used part of the box.
Vec3 Strategist::border_towards(const Vec3& p) const {
    const Vec3 share = glm::abs(p) / half_m_;
    const double most = std::max({share.x, share.y, share.z});
    return most > kUsed ? p * (kUsed / most) : p;
}

Decision Strategist::decide(const View& view) {
    // The hand's position at which the tool would be on the target.
    const Vec3 needed = view.hand_device_m + in_device(view.target_object - view.tool_object);
    const bool in_reach = within_box(needed, kUsed) || glm::length(view.target_object - view.tool_object) < kThere_m;
    switch (approach_.technique) {
        case haptics::WorkspaceTechnique::bubble: return glide(view);
        case haptics::WorkspaceTechnique::clutching:
            if (view.button || !in_reach) return clutch(view);
            break;
        case haptics::WorkspaceTechnique::moving:
            if (view.button && approach_.drags) return drag(view);
            if (view.button || taps_ > 0 || !in_reach) return tap(view);
            break;
        case haptics::WorkspaceTechnique::drift:
            if (!in_reach) return stir(view);
            break;
        default: break;
    }
    return reach_directly(view, needed);
}

Decision Strategist::reach_directly(const View& view, const Vec3& needed) const {
    Decision decision;
    if (glm::length(view.target_object - view.tool_object) > kSeen_m) {
        decision.goal_device_m = needed;
        decision.rest_s = view.vision_s;
    } else {
        decision.rest_s = kSteer_s;
    }
    return decision;
}

Decision Strategist::tap(const View& view) {
    Decision decision;
    if (view.button) {
        decision.button = false;
        decision.rest_s = --taps_ > 0 ? kBetweenTaps_s : view.vision_s;
        return decision;
    }
    if (taps_ == 0) {
        const Vec3 needed = view.hand_device_m + in_device(view.target_object - view.tool_object);
        const Vec3 border = border_towards(needed);
        if (glm::length(border - view.hand_device_m) > kNear_m) {
            decision.goal_device_m = border;  // without rest: the border is felt, not seen
            return decision;
        }
        const Vec3 share = glm::abs(needed) / half_m_;
        const double boxes = std::max({share.x, share.y, share.z});
        taps_ = approach_.drags ? 1 : std::max(1, static_cast<int>(std::ceil((boxes - 0.9) / kUsed)));
    }
    decision.button = true;
    return decision;
}

Decision Strategist::drag(const View& view) {
    Decision decision;
    decision.rest_s = 0.5 * kSteer_s;
    decision.keeps_moving = true;
    const Vec3 speed_object = (view.tool_object - view.tool_before_object) / 0.05;
    const Vec3 then = view.tool_object + speed_object * (view.vision_s + view.finger_s);
    const Vec3 ahead = in_device(view.target_object - then);  // relative to the box's middle
    if (within_box(ahead, 0.7)) {
        decision.button = false;
        decision.rest_s = view.vision_s;
        decision.keeps_moving = false;
        taps_ = 0;
        return decision;
    }
    const Vec3 border = border_towards(ahead * 1e3);
    if (glm::length(border - view.goal_device_m) > kNear_m) decision.goal_device_m = border;
    return decision;
}

Decision Strategist::clutch(const View& view) {
    Decision decision;
    const Vec3 way = in_device(view.target_object - view.tool_object);
    if (view.button) {
        if (returned_) {
            decision.button = false;
            return decision;
        }
        returned_ = true;
        decision.goal_device_m = border_towards(-way * 1e3);
        return decision;
    }
    double most = 1.0;  // share of the way until the box ends
    for (int axis = 0; axis < 3; ++axis) {
        const double room = kUsed * half_m_[axis] - (way[axis] > 0.0 ? 1.0 : -1.0) * view.hand_device_m[axis];
        if (std::abs(way[axis]) > 0.0) most = std::min(most, std::max(room, 0.0) / std::abs(way[axis]));
    }
    if (most * glm::length(way) > kNear_m) {
        decision.goal_device_m = view.hand_device_m + most * way;
        decision.rest_s = view.vision_s;
        return decision;
    }
    returned_ = false;
    decision.button = true;
    return decision;
}

// Controls the rate until the target lies in the inner half of the ball; the last part is by position.
Decision Strategist::glide(const View& view) const {
    const haptics::WorkspaceSettings& s = settings_;
    const double beyond = std::max(0.0, glm::length(view.felt_device_m) - s.bubble_radius_m);
    const double rate = std::min(s.max_speed_m_per_s, s.bubble_rate_per_m2s * beyond * beyond * beyond);
    const Vec3 gliding = beyond > 0.0 ? glm::normalize(view.felt_device_m) * rate : Vec3(0.0);
    const Vec3 needed = view.felt_device_m + in_device(view.target_object - view.tool_object) - gliding * view.vision_s;
    const double distance = glm::length(needed);
    // Just outside the ball the drift is too slow to matter.
    if (distance < s.bubble_radius_m + kCreep_m) return reach_directly(view, needed);
    const double wanted = std::min(s.max_speed_m_per_s, (distance - 0.5 * s.bubble_radius_m) / kArrive_s);
    const double reach = s.bubble_radius_m + std::cbrt(wanted / s.bubble_rate_per_m2s);
    Decision decision{{}, {}, kSteer_s, true};
    const Vec3 goal = border_towards(needed * (reach / distance));
    if (glm::length(goal - view.goal_device_m) > 0.002) decision.goal_device_m = goal;
    return decision;
}

// The mapping drifts along the hand's position in half extents, so that vector must point at the target.
Decision Strategist::stir(const View& view) {
    const Vec3 way = glm::normalize(in_device(view.target_object - view.tool_object));
    const Vec3 border = half_m_ * way * kUsed;
    const Vec3 across = glm::normalize(glm::cross(way, Vec3(0, 0, 1)));
    side_ = -side_;
    Decision decision;
    decision.goal_device_m = border + side_ * kStir_m * across;
    return decision;
}

}  // namespace burin::bench

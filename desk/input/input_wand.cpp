// SPDX-License-Identifier: MIT
#include "desk/input/input_wand.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace burin::session {
namespace {

constexpr double kLeastApart_m = 0.02;

// Returns the smallest turn from one direction to another (both of unit length): the half-way quaternion (1 + a.b, a x
// b).
Quat turn_between(const Vec3& a, const Vec3& b) {
    const double w = 1.0 + glm::dot(a, b);
    // Opposite directions: half a turn about any axis perpendicular to them.
    if (w < 1e-9) {
        const Vec3 other = std::abs(a.x) < 0.9 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
        return Quat(0.0, glm::normalize(glm::cross(a, other)));
    }
    return glm::normalize(Quat(w, glm::cross(a, b)));
}

// Returns the scene turned by q, scaled by factor, and moved so that `from` comes to lie on `to`.
Similarity brought(const Similarity& s, const Vec3& from, const Vec3& to, const Quat& q, double factor) {
    return {to + factor * (q * (s.position_m - from)), glm::normalize(q * s.orientation), factor * s.scale};
}

bool same(const Pose& a, const Pose& b) { return a.position_m == b.position_m && a.orientation == b.orientation; }

double within(double scale, double factor, double least, double most) {
    return std::clamp(scale * factor, least, most) / scale;
}

// Maps a stick to -1 to 1: 0 within the dead zone, growing with the square beyond, fine near the middle.
double deflection(double stick, double dead_zone) {
    const double beyond = (std::abs(stick) - dead_zone) / (1.0 - dead_zone);
    return beyond > 0.0 ? std::copysign(beyond * beyond, stick) : 0.0;
}

struct Events {
    WandState& state;
    const WandSettings& settings;
    bool reset = false;

    void operator()(const WandInput& in) {
        if (in.wand >= state.wands.size()) return;
        WandNow& wand = state.wands[in.wand];
        const double away_m = glm::length(in.pose_world.position_m);
        wand.too_far_m = in.tracked && away_m > settings.farthest_m ? away_m : 0.0;
        wand.tracked = in.tracked && wand.too_far_m == 0.0;
        if (wand.tracked) wand.pose_world = in.pose_world;
    }
    void operator()(const WandClick& in) {
        if (in.wand >= state.wands.size() || in.button >= kMostWandButtons) return;
        const std::uint32_t bit = 1u << in.button;
        std::uint32_t& buttons = state.wands[in.wand].buttons;
        buttons = in.pressed ? buttons | bit : buttons & ~bit;
        if (in.pressed && in.button == settings.reset_button) reset = true;
    }
    void operator()(const WandStick& in) {
        if (in.wand < state.wands.size()) state.wands[in.wand].stick = in.position;
    }
    template <typename Other>
    void operator()(const Other&) {}
};

std::array<Vec3, 2> places(const WandState& state) {
    return {state.wands[0].pose_world.position_m, state.wands[1].pose_world.position_m};
}

// Starts a hold with these wands, or none, from the current pose of the scene.
void take_hold(WandState& state, const std::array<bool, 2>& holding, const Similarity& world_from_scene) {
    state.holding = holding;
    state.one.reset();
    state.both.reset();
    if (holding[0] && holding[1])
        state.both = TwoWandGrab{places(state), world_from_scene};
    else if (holding[0] || holding[1])
        state.one = WandGrab{state.wands[holding[0] ? 0 : 1].pose_world, world_from_scene};
}

Similarity carried_by_hold(const WandState& state, const Similarity& scene, const WandSettings& settings) {
    if (state.both) return carried(*state.both, places(state), settings.least_scale, settings.most_scale);
    if (state.one) return carried(*state.one, state.wands[state.holding[0] ? 0 : 1].pose_world);
    return scene;
}

Similarity moved_by_stick(const WandNow& wand, bool holds, const Similarity& scene, const Pose& head_world, double dt_s,
                          const WandSettings& settings) {
    const double ahead = deflection(wand.stick.y, settings.stick_dead_zone) * dt_s;
    const double aside = deflection(wand.stick.x, settings.stick_dead_zone) * dt_s;
    if (!wand.tracked || (ahead == 0.0 && aside == 0.0)) return scene;
    if (holds) {
        const double factor =
            within(scene.scale, std::exp(settings.scale_rate_per_s * ahead), settings.least_scale, settings.most_scale);
        return scaled_about(scene, wand.pose_world.position_m, factor);
    }
    const Vec3 pointing = wand.pose_world.orientation * Vec3(0.0, 0.0, -1.0);
    const Similarity flown = moved_by(scene, -settings.fly_speed_m_per_s * ahead * pointing);
    // To turn the viewer to the right the scene turns to the left, counter-clockwise as seen from above.
    return turned_about(flown, head_world.position_m,
                        glm::angleAxis(settings.turn_speed_rad_per_s * aside, Vec3(0.0, 1.0, 0.0)));
}

}  // namespace

Similarity moved_by(const Similarity& s, const Vec3& by_world_m) {
    return {s.position_m + by_world_m, s.orientation, s.scale};
}

Similarity turned_about(const Similarity& s, const Vec3& point_world, const Quat& turn) {
    return brought(s, point_world, point_world, turn, 1.0);
}

Similarity scaled_about(const Similarity& s, const Vec3& point_world, double factor) {
    BURIN_CHECK(factor > 0.0);
    return {point_world + factor * (s.position_m - point_world), s.orientation, factor * s.scale};
}

Similarity carried(const WandGrab& grab, const Pose& now) {
    if (same(now, grab.world_from_wand)) return grab.world_from_scene;  // exactly, to the last bit
    const Quat turn = glm::normalize(now.orientation * glm::conjugate(grab.world_from_wand.orientation));
    return brought(grab.world_from_scene, grab.world_from_wand.position_m, now.position_m, turn, 1.0);
}

Similarity carried(const TwoWandGrab& grab, const std::array<Vec3, 2>& now, double least_scale, double most_scale) {
    if (now == grab.wands_world) return grab.world_from_scene;
    const auto& then = grab.wands_world;
    const Vec3 from = 0.5 * (then[0] + then[1]), to = 0.5 * (now[0] + now[1]);
    const Vec3 apart_then = then[1] - then[0], apart_now = now[1] - now[0];
    const double l0 = glm::length(apart_then), l1 = glm::length(apart_now);
    if (l0 < kLeastApart_m || l1 < kLeastApart_m) return moved_by(grab.world_from_scene, to - from);
    const double factor = within(grab.world_from_scene.scale, l1 / l0, least_scale, most_scale);
    return brought(grab.world_from_scene, from, to, turn_between(apart_then / l0, apart_now / l1), factor);
}

WandStep step_wands(WandState state, std::span<const InputEvent> events, double dt_s,
                    const Similarity& world_from_scene, const Pose& head_world, const WandSettings& settings) {
    BURIN_CHECK(dt_s >= 0.0 && world_from_scene.scale > 0.0);
    Events apply{state, settings};
    for (const InputEvent& event : events) std::visit(apply, event.input);
    std::array<bool, 2> holding{};
    for (std::size_t i = 0; i < 2; ++i)
        holding[i] = state.wands[i].tracked && (state.wands[i].buttons >> settings.grab_button & 1u) != 0;
    Similarity scene = world_from_scene;
    if (apply.reset) scene = settings.home_world_from_scene;
    if (holding != state.holding || apply.reset)
        take_hold(state, holding, scene);
    else
        scene = carried_by_hold(state, scene, settings);
    const Similarity before_sticks = scene;
    for (std::size_t i = 0; i < 2; ++i)
        scene = moved_by_stick(state.wands[i], holding[i], scene, head_world, dt_s, settings);
    const bool stirred = scene.position_m != before_sticks.position_m || scene.scale != before_sticks.scale ||
                         scene.orientation != before_sticks.orientation;
    if (stirred) take_hold(state, holding, scene);  // holds start from the current scene
    return {std::move(state), scene};
}

}  // namespace burin::session

// SPDX-License-Identifier: MIT
#include "haptics/workspace/technique.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/workspace/turn.hpp"

namespace burin {
namespace {

// No device reaches so far and no hand is so fast: beyond it squares and sums stay finite, whatever comes in.
constexpr double kFarthest_m = 10.0, kFastest_m_per_s = 100.0, kLongestStep_s = 0.1;

// Zero for what is no number.
double within(double x, double largest) { return std::isnan(x) ? 0.0 : std::clamp(x, -largest, largest); }

Vec3 within(const Vec3& v, double largest) {
    return {within(v.x, largest), within(v.y, largest), within(v.z, largest)};
}

WorkspaceInput safe(WorkspaceInput input) {
    input.position_device_m = within(input.position_device_m, kFarthest_m);
    input.velocity_device_m_per_s = within(input.velocity_device_m_per_s, kFastest_m_per_s);
    input.dt_s = std::max(within(input.dt_s, kLongestStep_s), 0.0);
    return input;
}

bool same(const Similarity& a, const Similarity& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.scale == b.scale;
}

bool goes_on(const WorkspaceState& state, const WorkspaceSettings& settings) {
    return state.begun && state.technique == settings.technique &&
           same(state.settings_map, settings.object_from_device) && state.scaling_gain == settings.scaling_gain;
}

WorkspaceState begin(const WorkspaceSettings& settings, bool pressed) {
    WorkspaceState state;
    state.begun = true;
    state.technique = settings.technique;
    state.settings_map = state.object_from_device = settings.object_from_device;
    state.scaling_gain = settings.scaling_gain;
    if (settings.technique == WorkspaceTechnique::scaling) state.object_from_device.scale *= settings.scaling_gain;
    state.pressed = pressed;  // that press is not for this technique
    return state;
}

// The reach may have changed since the step before.
void keep_within_reach(WorkspaceTurn& turn) {
    if (turn.settings.technique == WorkspaceTechnique::fixed) return;
    const Similarity kept = moved_to(turn.map(), turn.map().position_m, turn.settings);
    if (!same(kept, turn.map())) turn.step.jumped = true;
    turn.map() = kept;
}

void note_button(WorkspaceTurn& turn) {
    WorkspaceState& state = turn.state();
    const bool pressed = (turn.input.buttons & turn.settings.button_mask) != 0;
    turn.went_down = pressed && !state.pressed;
    turn.went_up = !pressed && state.pressed;
    state.pressed = pressed;
    state.phase_s += turn.input.dt_s;
    if (turn.went_down) ++state.presses;
}

void take_step(WorkspaceTurn& turn) {
    switch (turn.settings.technique) {
        case WorkspaceTechnique::fixed:
        case WorkspaceTechnique::scaling: break;  // the mapping stands
        case WorkspaceTechnique::moving: step_moving(turn); break;
        case WorkspaceTechnique::clutching: step_clutching(turn); break;
        case WorkspaceTechnique::bubble: step_bubble(turn); break;
        case WorkspaceTechnique::drift: step_drift(turn); break;
    }
}

// Beyond it a number is nonsense, and products of a few of them are no longer finite.
constexpr double kLargest = 1e9;

bool ordinary(double x) { return x >= -kLargest && x <= kLargest; }

bool ordinary(const Vec3& v) { return ordinary(v.x) && ordinary(v.y) && ordinary(v.z); }

bool not_negative(double x) { return ordinary(x) && x >= 0.0; }

bool not_negative(const Vec3& v) { return not_negative(v.x) && not_negative(v.y) && not_negative(v.z); }

bool above_zero(double x) { return ordinary(x) && x > 0.0; }

bool sensible(const Similarity& map) {
    const Quat& q = map.orientation;
    const double length2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return ordinary(map.position_m) && std::abs(length2 - 1.0) <= 2e-6 && above_zero(map.scale);
}

bool sensible(const Box& reach) { return reach.empty() || (ordinary(reach.lo) && ordinary(reach.hi)); }

}  // namespace

const char* text(WorkspaceTechnique technique) noexcept {
    switch (technique) {
        case WorkspaceTechnique::fixed: return "fixed";
        case WorkspaceTechnique::moving: return "moving";
        case WorkspaceTechnique::scaling: return "scaling";
        case WorkspaceTechnique::clutching: return "clutching";
        case WorkspaceTechnique::bubble: return "bubble";
        case WorkspaceTechnique::drift: return "drift";
    }
    return "unknown";
}

const char* text(WorkspacePhase phase) noexcept {
    switch (phase) {
        case WorkspacePhase::editing: return "editing";
        case WorkspacePhase::paused: return "paused: the box shows where the workspace will be";
        case WorkspacePhase::dragging: return "dragging the workspace";
        case WorkspacePhase::jumping: return "the workspace has jumped; editing resumes without another press";
        case WorkspacePhase::clutched: return "clutched: the tool stays while the hand returns";
        case WorkspacePhase::gliding: return "gliding beyond the bubble";
    }
    return "unknown";
}

WorkspaceStep step_workspace(const WorkspaceState& state, const WorkspaceSettings& settings,
                             const WorkspaceInput& input) noexcept {
    WorkspaceTurn turn{settings, safe(input), false, false, {}};
    turn.step.jumped = !goes_on(state, settings);
    turn.state() = turn.step.jumped ? begin(settings, (input.buttons & settings.button_mask) != 0) : state;
    keep_within_reach(turn);
    note_button(turn);
    take_step(turn);
    turn.step.object_from_device = turn.step.picture.object_from_device = turn.map();
    turn.step.picture.phase = turn.state().phase;
    return turn.step;
}

bool settings_are_sensible(const WorkspaceSettings& s) noexcept {
    const bool known = s.technique <= WorkspaceTechnique::drift;
    const bool place = sensible(s.object_from_device) && not_negative(s.workspace_device_m) && sensible(s.reach_object);
    const bool moving = not_negative(s.tap_s) && not_negative(s.series_s) && not_negative(s.drag_rate_per_s);
    const bool bubble = not_negative(s.bubble_radius_m) && not_negative(s.bubble_stiffness_N_per_m) &&
                        not_negative(s.bubble_rate_per_m2s);
    const bool drift = not_negative(s.drift_ratio) && s.drift_ratio < 1.0;
    const bool limits = not_negative(s.max_speed_m_per_s) && not_negative(s.max_speed_in_contact_m_per_s) &&
                        not_negative(s.max_acceleration_m_per_s2);
    return known && place && moving && above_zero(s.scaling_gain) && bubble && drift && limits;
}

}  // namespace burin

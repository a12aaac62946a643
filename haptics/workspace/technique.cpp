// SPDX-License-Identifier: MIT
#include "haptics/workspace/technique.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

// The state of one step in progress.
struct WorkspaceTurn {
    const WorkspaceSettings& settings;
    WorkspaceInput input;  // clamped to finite, plausible values
    bool went_down = false, went_up = false, piece_moves = false;
    WorkspaceStep step;  // step.next is changed in place

    [[nodiscard]] WorkspaceState& state() { return step.next; }
    [[nodiscard]] Similarity& map() { return step.next.object_from_device; }
    [[nodiscard]] Vec3 tool_object_m() { return map() * input.position_device_m; }
};

// Half the extents of the turned and scaled workspace along the object's axes.
Vec3 half_extent_object(const Similarity& map, const Vec3& workspace_device_m) {
    const glm::dmat3 turn = glm::mat3_cast(map.orientation);
    Vec3 half(0.0);
    for (int axis = 0; axis < 3; ++axis) half += glm::abs(turn[axis]) * (0.5 * map.scale * workspace_device_m[axis]);
    return half;
}

Vec3 shortened(const Vec3& v, double longest) {
    const double length = std::sqrt(glm::dot(v, v));
    return length > longest ? v * (longest / length) : v;
}

// The mapping with its middle as close to `middle_object_m` as the reach allows.
Similarity moved_to(const Similarity& map, const Vec3& middle_object_m, const WorkspaceSettings& settings) {
    Similarity moved = map;
    moved.position_m = middle_object_m;
    const Box& reach = settings.reach_object;
    if (reach.empty()) return moved;
    const Vec3 half = half_extent_object(map, settings.workspace_device_m);
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = reach.lo[axis] + half[axis], hi = reach.hi[axis] - half[axis];
        moved.position_m[axis] = lo <= hi ? std::clamp(middle_object_m[axis], lo, hi) : reach.center()[axis];
    }
    return moved;
}

// Moves the mapping at the desired velocity, limited by contact, top speed, acceleration and reach.
void glide(WorkspaceTurn& turn, const Vec3& wanted_device_m_per_s) {
    const WorkspaceSettings& s = turn.settings;
    Vec3& now = turn.state().glide_device_m_per_s;
    const double top = turn.input.in_contact ? s.max_speed_in_contact_m_per_s : s.max_speed_m_per_s;
    const double soon = std::sqrt(glm::dot(now, now)) + s.max_acceleration_m_per_s2 * turn.input.dt_s;
    now = shortened(wanted_device_m_per_s, std::min(top, soon));
    const Vec3 on_object_m = apply_to_vector(turn.map(), now * turn.input.dt_s);
    turn.map() = moved_to(turn.map(), turn.map().position_m + on_object_m, s);
}

void enter(WorkspaceTurn& turn, WorkspacePhase phase) {
    turn.state().phase = phase;
    turn.state().phase_s = 0.0;
}

// ---- The moving algorithm; technique.hpp has its table of transitions

void recentre(WorkspaceTurn& turn) {
    turn.map() = moved_to(turn.map(), turn.tool_object_m(), turn.settings);
    turn.step.jumped = true;
    enter(turn, WorkspacePhase::jumping);
}

// The tool's offset from the workspace's middle corresponds to the hand's offset from the device's origin.
void drag(WorkspaceTurn& turn) { glide(turn, turn.settings.drag_rate_per_s * turn.input.position_device_m); }

void change_phase(WorkspaceTurn& turn) {
    const WorkspaceState& state = turn.state();
    switch (state.phase) {
        case WorkspacePhase::paused:
            if (turn.went_up) {
                recentre(turn);
            } else if (state.phase_s >= turn.settings.tap_s) {
                enter(turn, WorkspacePhase::dragging);
            }
            break;
        case WorkspacePhase::dragging:
            if (turn.went_up) recentre(turn);
            break;
        case WorkspacePhase::jumping:
            if (turn.went_down) {
                enter(turn, WorkspacePhase::paused);
            } else if (state.phase_s >= turn.settings.series_s) {
                enter(turn, WorkspacePhase::editing);
            }
            break;
        default:
            if (turn.went_down) enter(turn, WorkspacePhase::paused);
            break;
    }
}

void step_moving(WorkspaceTurn& turn) {
    change_phase(turn);
    const WorkspacePhase phase = turn.state().phase;
    if (phase == WorkspacePhase::dragging) {
        drag(turn);
    } else {
        turn.state().glide_device_m_per_s = Vec3(0.0);
    }
    turn.step.paused = phase != WorkspacePhase::editing;
    WorkspacePicture& picture = turn.step.picture;
    picture.proposed_visible = phase == WorkspacePhase::paused || phase == WorkspacePhase::dragging;
    picture.proposed_center_object_m = moved_to(turn.map(), turn.tool_object_m(), turn.settings).position_m;
}

// ---- Clutching

void step_clutching(WorkspaceTurn& turn) {
    WorkspaceState& state = turn.state();
    if (turn.went_down) {
        enter(turn, WorkspacePhase::clutched);
        state.anchor_object_m = turn.tool_object_m();
    }
    if (turn.went_up) enter(turn, WorkspacePhase::editing);
    if (state.phase != WorkspacePhase::clutched) return;
    // At the border of the reach the workspace stops and the tool follows the hand, so that the mapping stays
    // continuous.
    const Vec3 arm_object_m = apply_to_vector(turn.map(), turn.input.position_device_m);
    turn.map() = moved_to(turn.map(), state.anchor_object_m - arm_object_m, turn.settings);
    turn.step.paused = true;
}

// ---- Bubble and drift, in which the mapping moves by itself

// Dominjon et al. 2005: V = k (|d| - R)^3 d/|d|, F = -s (|d| - R) d/|d|.
void step_bubble(WorkspaceTurn& turn) {
    const WorkspaceSettings& s = turn.settings;
    const Vec3& d = turn.input.position_device_m;
    const double distance = std::sqrt(glm::dot(d, d));
    const double beyond = distance - s.bubble_radius_m;
    turn.step.picture.bubble_radius_object_m = s.bubble_radius_m * turn.map().scale;
    const WorkspacePhase phase = beyond > 0.0 ? WorkspacePhase::gliding : WorkspacePhase::editing;
    if (phase != turn.state().phase) enter(turn, phase);
    const Vec3 outwards = beyond > 0.0 ? d / distance : Vec3(0.0);
    glide(turn, outwards * (s.bubble_rate_per_m2s * beyond * beyond * beyond));
    turn.step.force_device_N = -s.bubble_stiffness_N_per_m * std::max(beyond, 0.0) * outwards;
}

// Conti and Khatib 2005: speed proportional to the hand's speed and to its distance from the middle.
void step_drift(WorkspaceTurn& turn) {
    const WorkspaceSettings& s = turn.settings;
    Vec3 outwards(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * s.workspace_device_m[axis];
        if (half > 0.0) outwards[axis] = std::clamp(turn.input.position_device_m[axis] / half, -1.0, 1.0);
    }
    const double length = std::sqrt(glm::dot(outwards, outwards));
    if (length > 1.0) outwards /= length;
    const Vec3& v = turn.input.velocity_device_m_per_s;
    glide(turn, outwards * (s.drift_ratio * std::sqrt(glm::dot(v, v))));
}

// ---- What all techniques share

// Bounds beyond any device's reach and any hand's speed; within them squares and sums stay finite for any input.
constexpr double kFarthest_m = 10.0, kFastest_m_per_s = 100.0, kLongestStep_s = 0.1;

// Clamps x; NaN becomes zero.
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

bool goes_on(const WorkspaceState& state, const WorkspaceSettings& settings, const WorkspaceInput& input) {
    if (!state.begun || state.technique != settings.technique || state.scaling_gain != settings.scaling_gain ||
        state.placed != settings.placed)
        return false;
    return same(state.settings_map, settings.object_from_device) ||
           (settings.placed > 0 && is_motion(state.piece, settings.object_from_device, input.position_device_m));
}

WorkspaceState begin(const WorkspaceSettings& settings, bool pressed) {
    WorkspaceState state;
    state.begun = true;
    state.technique = settings.technique;
    state.settings_map = state.object_from_device = state.piece.object_from_device = settings.object_from_device;
    state.scaling_gain = settings.scaling_gain;
    state.placed = settings.placed;
    if (settings.technique == WorkspaceTechnique::scaling) state.object_from_device.scale *= settings.scaling_gain;
    state.pressed = pressed;  // a press that began before the technique does not count
    return state;
}

// Has the mapping follow the piece. What the technique has moved it by stays what it is as seen from the device.
void follow_piece(WorkspaceTurn& turn) {
    WorkspaceState& state = turn.state();
    const Similarity& published = turn.settings.object_from_device;
    if (!same(state.settings_map, published)) {
        state.piece = led_to(state.piece, published, turn.input.position_device_m);
        state.settings_map = published;
    }
    const Similarity before = state.piece.object_from_device;
    state.piece = followed(state.piece, published, turn.input.dt_s);
    if (same(state.piece.object_from_device, before)) return;
    if (same(turn.map(), before)) {
        turn.map() = state.piece.object_from_device;
    } else {
        const Similarity moved = state.piece.object_from_device * inverse(before);
        turn.map() = moved * turn.map();
        turn.map().orientation = glm::normalize(turn.map().orientation);
        state.anchor_object_m = moved * state.anchor_object_m;
    }
    turn.piece_moves = true;
}

// Clamps the mapping to the reach, which may have changed since the last step. Where a piece that turns takes its reach
// along, the mapping goes with it from tick to tick.
void keep_within_reach(WorkspaceTurn& turn) {
    if (turn.settings.technique == WorkspaceTechnique::fixed) return;
    const Similarity kept = moved_to(turn.map(), turn.map().position_m, turn.settings);
    if (!same(kept, turn.map()) && !turn.piece_moves) turn.step.jumped = true;
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
        case WorkspaceTechnique::scaling: break;  // the mapping does not move
        case WorkspaceTechnique::moving: step_moving(turn); break;
        case WorkspaceTechnique::clutching: step_clutching(turn); break;
        case WorkspaceTechnique::bubble: step_bubble(turn); break;
        case WorkspaceTechnique::drift: step_drift(turn); break;
    }
}

// Bound on sensible settings; beyond it products of a few of them are no longer finite.
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
    WorkspaceTurn turn{settings, safe(input), false, false, false, {}};
    turn.step.jumped = !goes_on(state, settings, turn.input);
    turn.state() = turn.step.jumped ? begin(settings, (input.buttons & settings.button_mask) != 0) : state;
    follow_piece(turn);
    keep_within_reach(turn);
    if (turn.piece_moves) turn.step.piece = motion_of_piece(state.object_from_device, turn.map(), turn.input.dt_s);
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

}  // namespace burin::haptics

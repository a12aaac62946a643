// SPDX-License-Identifier: MIT
#include "desk/input/desk_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "desk/input/input_wand.hpp"
#include "wall/seen_place.hpp"
#include "workpiece/carve_order.hpp"

namespace burin::session {
namespace {

constexpr std::uint32_t kCarve = 1u << 0, kMoveWorkspace = 1u << 1;

// A click that moves no farther is no drag.
constexpr double kClick_px = 4.0;
// By so much a step of the wheel makes a stroke deeper.
constexpr double kStrengthPerWheelStep = 1.1;

std::optional<Gesture> gesture_of(MouseMode mode, MouseUse use, const Modifiers& held) {
    for (const MouseGesture& g : mouse_gestures(mode))
        if (g.use == use && g.modifiers.shift == held.shift && g.modifiers.ctrl == held.ctrl) return g.gesture;
    return std::nullopt;
}

// Applies the events of one step, one after the other.
struct Steps {
    const DeskView& view;
    const DeskSettings& settings;
    DeskState state;
    std::uint32_t clicked = 0;  // buttons pressed in this step, even if released again
    Similarity change;
    std::vector<Action> actions;
    bool missed = false;
    std::vector<Gesture> strokes = {};
    std::optional<Vec3> approach_device_m = std::nullopt;  // where the tool is to begin to work, above where it then is

    [[nodiscard]] MouseMode mode() const { return view.surface ? MouseMode::surface : MouseMode::free; }
    [[nodiscard]] std::optional<Gesture> gesture_of(MouseUse use, const Modifiers& held) const {
        return session::gesture_of(mode(), use, held);
    }

    void operator()(const KeyInput& in) {
        const auto key = static_cast<std::size_t>(in.key);
        const bool down = in.motion != KeyMotion::release;
        if (in.key == Key::shift) state.modifiers.shift = down;
        if (in.key == Key::ctrl) state.modifiers.ctrl = down;
        if (in.key == Key::alt) state.modifiers.alt = down;
        if (in.key == Key::super) state.modifiers.super = down;
        if (!down) {
            state.keys.reset(key);
            return;
        }
        if (view.keyboard_captured) return;
        // With Ctrl, Alt or Super a key is only a short cut: Ctrl+S must not fly backwards.
        if (!in.modifiers.ctrl && !in.modifiers.alt && !in.modifiers.super) state.keys.set(key);
        for (const ShortCut& s : short_cuts())
            if (s.key == in.key && s.modifiers == in.modifiers && (s.repeats || in.motion == KeyMotion::press) &&
                (!s.only || *s.only == mode()))
                act(s.action);
    }

    void act(Action action) {
        actions.push_back(action);
        if (action != Action::reset_view) return;
        state.head_world = settings.home_head_world;
        state.flight_m_per_s = Vec3(0.0);
        state.target_turn_device = Quat(1.0, 0.0, 0.0, 0.0);
    }

    void operator()(const MouseMove& in) {
        const std::optional<Vec2> before = std::exchange(state.mouse_px, in.position_px);
        if (!state.drag && !view.surface && !moves_in_depth() && stay_under_cursor()) return;
        if (!before || wall::in_right_window(*before) != wall::in_right_window(in.position_px)) return;
        const Vec2 moved =
            view.picture_px_per_px * Vec2(in.position_px.x - before->x, before->y - in.position_px.y);  // y up
        if (state.drag)
            drag(moved);
        else if (view.surface)
            follow_surface();
        else if (!view.mouse_captured || state.buttons != 0)
            move_stylus(moved);
    }

    // Returns where the workpiece is after what this step has changed.
    [[nodiscard]] Similarity object_from_world() const {
        return view.surface->cursor.object_from_world * inverse(change);
    }
    [[nodiscard]] std::optional<Ray> ray_object() const {
        if (!state.mouse_px) return std::nullopt;
        CursorView cursor = view.surface->cursor;
        cursor.object_from_world = object_from_world();
        return cursor.ray_object(*state.mouse_px);
    }

    // Brings the tool to where the cursor points. Returns whether that is on the surface.
    bool follow_surface() {
        if (!view.surface || state.drag || (view.mouse_captured && !state.on_surface.pressed)) return false;
        const std::optional<Ray> ray = ray_object();
        if (!ray) return false;
        const DeskSurface& on = *view.surface;
        ToolOnSurface tool = on.tool;
        tool.depth_m *= state.strength;
        tool.roll_rad += state.roll_rad;
        const Quat object_from_screen =
            glm::normalize(object_from_world().orientation * inverse(on.cursor.object_from_world).orientation) *
            on.object_from_screen;
        PointedAt pointed =
            pointed_at(std::move(state.on_surface), *ray, *on.seen, tool, object_from_screen, on.middle_object);
        state.on_surface = std::move(pointed.hand);
        const bool begins = pointed.tool.works && !state.in_work;
        state.in_work = pointed.tool.works;
        state.in_air = pointed.tool.in_air;
        state.works = pointed.tool.works || !state.on_surface.pressed;
        const Similarity device_from_object = inverse(on.object_from_device);
        const Vec3 half = 0.5 * settings.workspace_m;
        const Vec3 wanted_m = device_from_object * pointed.tool.object_from_tool.position_m;
        state.target_device_m = glm::clamp(wanted_m, -half, half);
        state.beyond_reach = !state.on_surface.pressed && state.target_device_m != wanted_m;
        state.led_device = glm::normalize(device_from_object.orientation * pointed.tool.object_from_tool.orientation);
        // Its button goes down before it touches, so that it comes upon the surface from outside.
        if (begins) {
            const Vec3 up_device = state.led_device * Vec3(0.0, 1.0, 0.0);
            approach_device_m = glm::clamp(
                state.target_device_m + device_from_object.scale * pointed.tool.sunk_m * up_device, -half, half);
        }
        return pointed.on_surface;
    }

    [[nodiscard]] bool moves_in_depth() const {
        return gesture_of(MouseUse::move, {.shift = state.modifiers.shift}) == Gesture::move_stylus_in_depth;
    }

    void move_stylus(const Vec2& moved_px) {
        const Vec3 on_screen =
            moves_in_depth() ? Vec3(moved_px.x, 0.0, -moved_px.y) : Vec3(moved_px.x, moved_px.y, 0.0);
        reach(view.device_from_screen * (view.device_m_per_px * on_screen));
    }

    // Returns whether the target is led so.
    bool stay_under_cursor() {
        if (!view.cursor || !state.mouse_px || (view.mouse_captured && state.buttons == 0)) return false;
        const std::optional<Ray> ray = view.cursor->ray_object(*state.mouse_px);
        const Vec3 out = view.device_from_screen * Vec3(0.0, 0.0, 1.0);
        const double away = ray ? glm::dot(ray->direction, out) : 0.0;
        if (!(away < 0.0)) return false;
        const double along = glm::dot(state.target_device_m - ray->origin, out) / away;
        reach(ray->origin + along * ray->direction - state.target_device_m);
        return true;
    }

    void reach(const Vec3& by_device_m) {
        const Vec3 half = 0.5 * settings.workspace_m;
        state.target_device_m = glm::clamp(state.target_device_m + by_device_m, -half, half);
    }

    void drag(const Vec2& moved_px) {
        state.dragged_px += glm::length(moved_px);
        const Quat& q = view.world_from_screen;
        if (state.drag == Gesture::turn_stylus || state.drag == Gesture::roll_stylus) {
            turn_stylus(settings.turn_rad_per_px * moved_px);
        } else if (state.drag == Gesture::pan_scene) {
            change = moved_by(change, q * Vec3(view.world_m_per_px * moved_px, 0.0));
        } else {
            const Vec2 angle = settings.turn_rad_per_px * moved_px;
            change = turned_about(change, view.pivot_world, glm::angleAxis(angle.x, q * Vec3(0.0, 1.0, 0.0)));
            change = turned_about(change, view.pivot_world, glm::angleAxis(-angle.y, q * Vec3(1.0, 0.0, 0.0)));
        }
    }

    // Turns the stylus about its tip as if it were held at its far end, or about its own shaft; a wand to the side.
    void turn_stylus(const Vec2& by_rad) {
        const Quat& screen = view.device_from_screen;
        const Vec3 shaft = state.target_turn_device * settings.rest_device * Vec3(0.0, 1.0, 0.0);
        const Vec3 roll_axis = settings.leans_sideways ? screen * Vec3(0.0, 0.0, -1.0) : shaft;
        const Quat turn = state.drag == Gesture::roll_stylus
                              ? glm::angleAxis(by_rad.x, roll_axis)
                              : glm::angleAxis(by_rad.x, screen * Vec3(0.0, 1.0, 0.0)) *
                                    glm::angleAxis(-by_rad.y, screen * Vec3(1.0, 0.0, 0.0));
        state.target_turn_device = glm::normalize(turn * state.target_turn_device);
    }
    [[nodiscard]] Quat orientation_device() const {
        return view.surface ? state.led_device : state.target_turn_device * settings.rest_device;
    }
    [[nodiscard]] std::uint32_t buttons() const {
        const std::uint32_t pressed = state.buttons | clicked;
        if (view.surface && !state.works) return pressed & ~kCarve;
        return view.surface && state.in_air && (pressed & kCarve) != 0 ? pressed | workpiece::kOverAir : pressed;
    }

    // Modifiers come with the event or as keys of their own.
    [[nodiscard]] Modifiers held_with(const Modifiers& told) const {
        return {told.shift || state.modifiers.shift, told.ctrl || state.modifiers.ctrl, false, false};
    }

    void operator()(const MouseClick& in) {
        if (view.surface) return click_on_surface(in);
        if (in.button == MouseButton::middle)
            state.drag = in.pressed && !view.mouse_captured ? gesture_of(MouseUse::middle_drag, held_with(in.modifiers))
                                                            : std::nullopt;
        press_stylus(in, MouseButton::left, MouseUse::left_button);
        press_stylus(in, MouseButton::right, MouseUse::right_button);
    }

    // Has a button turn or move the scene while it is down.
    void begin_drag(MouseButton button, std::optional<Gesture> gesture) {
        if (!gesture || state.drag || state.on_surface.pressed) return;
        state.drag = gesture;
        state.dragged_by = button;
        state.dragged_px = 0.0;
    }

    void click_on_surface(const MouseClick& in) {
        const bool is_left = in.button == MouseButton::left;
        if (!in.pressed) {
            if (state.drag && state.dragged_by == in.button) {
                state.drag.reset();
                missed = missed || (is_left && state.dragged_px <= kClick_px);
                follow_surface();
            } else if (is_left && state.on_surface.pressed) {
                state.on_surface.pressed = false;
                state.on_surface.as_it_was = {};
                state.buttons &= ~kCarve;  // where it has worked: on its way up it would add material
            }
            return;
        }
        if (view.mouse_captured) return;
        if (in.button == MouseButton::right)
            begin_drag(in.button, gesture_of(MouseUse::right_button, held_with(in.modifiers)));
        if (in.button == MouseButton::middle)
            begin_drag(in.button, gesture_of(MouseUse::middle_drag, held_with(in.modifiers)));
        const auto stroke = gesture_of(MouseUse::left_button, held_with(in.modifiers));
        if (!is_left || state.drag || !stroke) return;
        if (!follow_surface()) return begin_drag(in.button, Gesture::turn_scene);
        strokes.push_back(*stroke);
        state.on_surface.pressed = true;
        state.on_surface.as_it_was = *view.surface->seen;
        state.buttons |= kCarve;
        clicked |= kCarve;
        follow_surface();
    }

    void press_stylus(const MouseClick& in, MouseButton button, MouseUse use) {
        if (in.button != button) return;
        const std::uint32_t bit = use == MouseUse::left_button ? kCarve : kMoveWorkspace;
        if (!in.pressed) {
            state.buttons &= ~bit;
        } else if (!view.mouse_captured && gesture_of(use, held_with(in.modifiers))) {
            state.buttons |= bit;
            clicked |= bit;
        }
    }

    void operator()(const Scroll& in) {
        if (view.mouse_captured) return;
        const auto gesture = gesture_of(MouseUse::wheel, held_with(in.modifiers));
        // With Shift some window systems swap the wheel's axes.
        const double steps = in.steps.y != 0.0 ? in.steps.y : held_with(in.modifiers).shift ? in.steps.x : 0.0;
        if (gesture == Gesture::zoom_to_cursor && state.on_surface.pressed) {
            state.strength =
                std::clamp(state.strength * std::pow(kStrengthPerWheelStep, std::clamp(steps, -50.0, 50.0)),
                           kLeastStrength, kMostStrength);
            follow_surface();
        } else if (gesture == Gesture::zoom_to_cursor) {
            zoom(std::pow(settings.scale_per_wheel_step, std::clamp(steps, -50.0, 50.0)));
        }
        if (gesture == Gesture::stylus_depth) {
            reach(view.device_from_screen * Vec3(0.0, 0.0, -settings.depth_per_wheel_step_m * steps));
            stay_under_cursor();
        }
        if (gesture == Gesture::scale_scene)
            scale(std::pow(settings.scale_per_wheel_step, std::clamp(steps, -50.0, 50.0)));
    }

    void scale(double factor) { scale_about(view.pivot_world, factor); }
    void scale_about(const Vec3& place_world, double factor) {
        const double now = view.scene_scale * change.scale;
        const double allowed = std::clamp(now * factor, settings.least_scale, settings.most_scale) / now;
        change = scaled_about(change, place_world, allowed);
    }
    // Keeps what is under the cursor there; beside the workpiece, what is as far as the tool.
    void zoom(double factor) {
        const std::optional<Ray> ray = ray_object();
        if (!ray) return scale(factor);
        Vec3 place_object = state.on_surface.last ? state.on_surface.last->place_object_m : view.surface->middle_object;
        place_object = ray->origin + glm::dot(place_object - ray->origin, ray->direction) * ray->direction;
        if (const auto hit = view.surface->seen->first_hit(*ray)) place_object = hit->place_object_m;
        scale_about(inverse(object_from_world()) * place_object, factor);
    }

    void operator()(const WindowFocus& in) {
        if (in.gained) return;
        state.keys.reset();
        state.modifiers = {};
        state.buttons = 0;
        state.drag.reset();
        state.on_surface.pressed = false;
        state.on_surface.as_it_was = {};
        state.mouse_px.reset();  // its return elsewhere is not a motion
    }

    template <typename Other>
    void operator()(const Other&) {}
};

Vec3 direction_of(const std::bitset<kKeyCount>& keys) {
    constexpr std::array<Vec3, 6> kDirections = {Vec3(0.0, 0.0, -1.0), Vec3(0.0, 0.0, 1.0), Vec3(-1.0, 0.0, 0.0),
                                                 Vec3(1.0, 0.0, 0.0),  Vec3(0.0, 1.0, 0.0), Vec3(0.0, -1.0, 0.0)};
    std::array<bool, kDirections.size()> held{};  // two keys of one direction count once
    for (const FlightKey& key : flight_keys())
        if (keys.test(static_cast<std::size_t>(key.key))) held.at(static_cast<std::size_t>(key.flight)) = true;
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < held.size(); ++i)
        if (held[i]) sum += kDirections[i];
    const double l = glm::length(sum);
    return l > 0.0 ? sum / l : sum;
}

void fly(DeskState& state, double dt_s, bool keys_fly, const DeskSettings& settings) {
    const Vec3 asked = keys_fly ? direction_of(state.keys) : Vec3(0.0);
    const Vec3 wanted = settings.flight_speed_m_per_s * (state.head_world.orientation * asked);
    // v' = (wanted - v) / lag, one implicit Euler step: stable for any dt.
    state.flight_m_per_s =
        (settings.flight_lag_s * state.flight_m_per_s + dt_s * wanted) / (settings.flight_lag_s + dt_s);
    if (glm::length(state.flight_m_per_s) < 1e-4 && wanted == Vec3(0.0)) state.flight_m_per_s = Vec3(0.0);  // at rest
    Vec3& p = state.head_world.position_m;
    p += dt_s * state.flight_m_per_s;
    if (settings.head_world.empty()) return;
    p = glm::clamp(p, settings.head_world.lo, settings.head_world.hi);
}

}  // namespace

DeskState desk_at_home(const DeskSettings& settings) {
    DeskState state;
    state.head_world = settings.home_head_world;
    state.led_device = settings.rest_device;
    return state;
}

DeskStep step_desk(DeskState state, std::span<const InputEvent> events, double dt_s, const DeskView& view,
                   const DeskSettings& settings) {
    BURIN_CHECK(dt_s >= 0.0 && view.scene_scale > 0.0 && settings.flight_lag_s > 0.0);
    Steps steps{view, settings, std::move(state), 0, {}, {}};
    DeskStep step;
    for (const InputEvent& event : events) {
        const Vec3 before_m = steps.state.target_device_m;
        const Quat before_turn = steps.orientation_device();
        const std::uint32_t before = steps.state.buttons;
        std::visit(steps, event.input);
        const bool moved = std::holds_alternative<MouseMove>(event.input) || steps.state.target_device_m != before_m ||
                           steps.orientation_device() != before_turn || steps.state.buttons != before;
        if (const auto above_m = std::exchange(steps.approach_device_m, std::nullopt))
            step.way.push_back({event.time_ns, *above_m, steps.orientation_device(), steps.buttons()});
        if (moved)
            step.way.push_back(
                {event.time_ns, steps.state.target_device_m, steps.orientation_device(), steps.buttons()});
    }
    steps.follow_surface();  // what is under a resting cursor may have changed
    fly(steps.state, dt_s, !view.surface, settings);
    step.target.position_device_m = steps.state.target_device_m;
    step.target.orientation_device = steps.orientation_device();
    step.target.buttons = steps.buttons();
    step.head_world = steps.state.head_world;
    step.scene_change = steps.change;
    step.actions = std::move(steps.actions);
    step.missed = steps.missed;
    step.strokes = std::move(steps.strokes);
    step.state = std::move(steps.state);
    return step;
}

double device_m_per_px(double screen_m_per_px, double eye_to_screen_m, double eye_to_tool_m, double world_per_device) {
    BURIN_CHECK(eye_to_screen_m > 0.0 && eye_to_tool_m > 0.0 && world_per_device > 0.0);
    return screen_m_per_px * (eye_to_tool_m / eye_to_screen_m) / world_per_device;
}

}  // namespace burin::session

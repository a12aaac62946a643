// SPDX-License-Identifier: MIT
#include "desk/panel/panel_pointer.hpp"

#include <cmath>
#include <utility>

namespace burin::session {
namespace {

constexpr std::uint32_t kPointingWand = 0, kPressButton = 0;
// Deflection of a stick from which it scrolls the panel by a step.
constexpr double kStickScrolls = 0.3;

// Returns a pose that looks along its -Z from one point to another.
Pose looking(const Vec3& from, const Vec3& to) {
    const Vec3 back = glm::normalize(from - to);
    const Vec3 aside = std::abs(back.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0);
    const Vec3 right = glm::normalize(glm::cross(aside, back));
    return {from, glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)))};
}

// Position beside the panel, so that nothing on it stays highlighted.
constexpr Vec2 kBeside_px{-1.0, -1.0};

// Tracks where the mouse is and where its button went down.
void follow(PanelPointer& pointer, const Input& input) {
    if (const auto* move = std::get_if<MouseMove>(&input)) pointer.mouse_px = move->position_px;
    if (const auto* click = std::get_if<MouseClick>(&input); click != nullptr && click->button == MouseButton::left)
        pointer.held_px = click->pressed ? std::optional(pointer.mouse_px) : std::nullopt;
    if (const auto* focus = std::get_if<WindowFocus>(&input); focus != nullptr && !focus->gained)
        pointer.held_px.reset();  // its release would go unreported
}

struct Pointing {
    const picture::PanelStand& stand;
    ImageSize panel;
    const MouseView& mouse;
    Pointed pointed;

    void point(Nanoseconds time_ns, const std::optional<Pose>& along) {
        const auto at = along ? picture::panel_ray(stand, panel, *along) : std::nullopt;
        const bool was_over = pointed.pointer.over;
        pointed.pointer.over = at.has_value();
        if (at) pointed.panel.push_back({time_ns, MouseMove{*at}});
        // A drag stays where it left the panel until it is released.
        if (!at && was_over && !pointed.pointer.pressed) pointed.panel.push_back({time_ns, MouseMove{kBeside_px}});
    }

    // Presses or releases on the panel; returns whether the panel takes the event.
    bool press(Nanoseconds time_ns, bool down) {
        PanelPointer& p = pointed.pointer;
        if (down ? !p.over : !p.pressed) return false;
        p.pressed = down;
        if (!p.over) pointed.panel.push_back({time_ns, MouseMove{kBeside_px}});
        pointed.panel.push_back({time_ns, MouseClick{MouseButton::left, down, {}}});
        return true;
    }

    bool scroll(Nanoseconds time_ns, double steps) {
        if (!pointed.pointer.over) return false;
        pointed.panel.push_back({time_ns, Scroll{{0.0, steps}, {}}});
        return true;
    }

    // Returns the ray through the mouse from the eye that sees it on its picture; from between the eyes where both do.
    [[nodiscard]] std::optional<Pose> along_mouse() const {
        const PanelPointer& p = pointed.pointer;
        const auto seen = seen_at(mouse.output, mouse.place, p.mouse_px, p.held_px);
        if (!seen) return std::nullopt;
        const Vec2 uv = seen->picture_uv;
        const wall::Screen& s = mouse.screen;
        const Vec3 on_screen = s.lower_left_world + uv.x * (s.lower_right_world - s.lower_left_world) +
                               (1.0 - uv.y) * (s.upper_left_world - s.lower_left_world);
        const wall::Eyes& eyes = mouse.eyes_world;
        if (!seen->eye) return looking(middle_of(eyes), on_screen);
        return looking(*seen->eye == wall::Eye::left ? eyes.left_world : eyes.right_world, on_screen);
    }

    // Applies an event; returns whether it is for the panel alone.
    bool take(const InputEvent& event) {
        const Nanoseconds t = event.time_ns;
        follow(pointed.pointer, event.input);
        if (const auto* e = std::get_if<WandInput>(&event.input)) {
            if (e->wand == kPointingWand && e->tracked) point(t, e->pose_world);
            return false;  // what the wand carries moves on
        }
        if (const auto* e = std::get_if<WandClick>(&event.input))
            return e->wand == kPointingWand && e->button == kPressButton && press(t, e->pressed);
        if (const auto* e = std::get_if<WandStick>(&event.input)) {
            const double bent = std::abs(e->position.y) < kStickScrolls ? 0.0 : e->position.y;
            return e->wand == kPointingWand && bent != 0.0 && scroll(t, bent > 0.0 ? 1.0 : -1.0);
        }
        if (std::holds_alternative<MouseMove>(event.input)) {
            if (mouse.place.size.width > 0 && mouse.place.size.height > 0) point(t, along_mouse());
            return false;
        }
        if (const auto* e = std::get_if<MouseClick>(&event.input))
            return e->button == MouseButton::left && press(t, e->pressed);
        if (const auto* e = std::get_if<Scroll>(&event.input)) return scroll(t, e->steps.y);
        if (std::holds_alternative<KeyInput>(event.input) || std::holds_alternative<TextInput>(event.input))
            // For text fields; the panel says whether it captured the event.
            pointed.panel.push_back(event);
        return false;
    }
};

}  // namespace

Pointed point_at_panel(PanelPointer pointer, std::span<const InputEvent> events, const picture::PanelStand& stand,
                       ImageSize panel, const MouseView& mouse) {
    Pointing pointing{stand, panel, mouse, {pointer, {}, {}}};
    for (const InputEvent& event : events)
        if (!pointing.take(event)) pointing.pointed.rest.push_back(event);
    return std::move(pointing.pointed);
}

InWindows divide_by_window(bool& mouse_on_panel, std::span<const InputEvent> events) {
    InWindows to;
    for (const InputEvent& event : events) {
        if (const auto* move = std::get_if<MouseMove>(&event.input)) {
            const bool was_on = std::exchange(mouse_on_panel, move->position_px.x >= 0.75 * kPanelWindow_px);
            if (!mouse_on_panel) {
                to.rest.push_back(event);
                if (was_on) to.panel.push_back({event.time_ns, MouseMove{kBeside_px}});
                continue;
            }
            to.panel.push_back({event.time_ns, MouseMove{move->position_px - Vec2(kPanelWindow_px, 0.0)}});
            continue;
        }
        const bool is_mouse =
            std::holds_alternative<MouseClick>(event.input) || std::holds_alternative<Scroll>(event.input);
        const bool is_key =
            std::holds_alternative<KeyInput>(event.input) || std::holds_alternative<TextInput>(event.input);
        if (is_key || (is_mouse && mouse_on_panel)) to.panel.push_back(event);
        if (is_key || !is_mouse || !mouse_on_panel) to.rest.push_back(event);
    }
    return to;
}

OnPicture mouse_on_picture(PanelPointer pointer, std::span<const InputEvent> events, const wall::OutputSettings& output,
                           const wall::OutputPlace& place) {
    OnPicture on{pointer, {events.begin(), events.end()}};
    const ImageSize eye = wall::eye_size(output.mode, place.size);
    for (InputEvent& event : on.events) {
        follow(on.pointer, event.input);
        auto* move = std::get_if<MouseMove>(&event.input);
        if (move == nullptr) continue;
        const auto seen = seen_at(output, place, move->position_px, on.pointer.held_px);
        move->position_px = seen ? seen->picture_uv * Vec2(eye.width, eye.height) : kBeside_px;
    }
    return on;
}

}  // namespace burin::session

// SPDX-License-Identifier: MIT
#include "app/session/panel_pointer.hpp"

#include <cmath>

namespace burin {
namespace {

constexpr std::uint32_t kPointingWand = 0, kPressButton = 0;
constexpr double kStickScrolls = 0.3;  // how far a stick is bent to turn the panel's page by a step

// A pose that looks along its -Z from one point to another.
Pose looking(const Vec3& from, const Vec3& to) {
    const Vec3 back = glm::normalize(from - to);
    const Vec3 aside = std::abs(back.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0);
    const Vec3 right = glm::normalize(glm::cross(aside, back));
    return {from, glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)))};
}

// Beside the panel, so that nothing on it stays lit.
constexpr Vec2 kBeside_px{-1.0, -1.0};

// Where the mouse is and where its button went down.
void follow(PanelPointer& pointer, const Input& input) {
    if (const auto* move = std::get_if<MouseMove>(&input)) pointer.mouse_px = move->position_px;
    if (const auto* click = std::get_if<MouseClick>(&input); click != nullptr && click->button == MouseButton::left)
        pointer.held_px = click->pressed ? std::optional(pointer.mouse_px) : std::nullopt;
    if (const auto* focus = std::get_if<WindowFocus>(&input); focus != nullptr && !focus->gained)
        pointer.held_px.reset();  // nobody will tell of the release
}

struct Pointing {
    const PanelStand& stand;
    ImageSize panel;
    const MouseView& mouse;
    Pointed pointed;

    void point(Nanoseconds time_ns, const std::optional<Pose>& along) {
        const auto at = along ? panel_ray(stand, panel, *along) : std::nullopt;
        const bool was_over = pointed.pointer.over;
        pointed.pointer.over = at.has_value();
        if (at) pointed.panel.push_back({time_ns, MouseMove{*at}});
        // What is dragged stays where it left the panel until it is let go.
        if (!at && was_over && !pointed.pointer.pressed) pointed.panel.push_back({time_ns, MouseMove{kBeside_px}});
    }

    // Whether the panel has it.
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

    // From the eye that sees the mouse on its picture; from between the eyes where both do.
    [[nodiscard]] std::optional<Pose> along_mouse() const {
        const PanelPointer& p = pointed.pointer;
        const auto seen = seen_at(mouse.output, mouse.place, p.mouse_px, p.held_px);
        if (!seen) return std::nullopt;
        const Vec2 uv = seen->picture_uv;
        const Screen& s = mouse.screen;
        const Vec3 on_screen = s.lower_left_world + uv.x * (s.lower_right_world - s.lower_left_world) +
                               (1.0 - uv.y) * (s.upper_left_world - s.lower_left_world);
        const Eyes& eyes = mouse.eyes_world;
        if (!seen->eye) return looking(middle_of(eyes), on_screen);
        return looking(*seen->eye == Eye::left ? eyes.left_world : eyes.right_world, on_screen);
    }

    // Whether the panel alone has the event.
    bool take(const InputEvent& event) {
        const Nanoseconds t = event.time_ns;
        follow(pointed.pointer, event.input);
        if (const auto* e = std::get_if<WandInput>(&event.input)) {
            if (e->wand == kPointingWand && e->tracked) point(t, e->pose_world);
            return false;  // what it carries moves on
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
            pointed.panel.push_back(event);  // fields that are being written in; the panel says whether it kept them
        return false;
    }
};

}  // namespace

Pointed point_at_panel(PanelPointer pointer, std::span<const InputEvent> events, const PanelStand& stand,
                       ImageSize panel, const MouseView& mouse) {
    Pointing pointing{stand, panel, mouse, {pointer, {}, {}}};
    for (const InputEvent& event : events)
        if (!pointing.take(event)) pointing.pointed.rest.push_back(event);
    return std::move(pointing.pointed);
}

OnPicture mouse_on_picture(PanelPointer pointer, std::span<const InputEvent> events, const OutputSettings& output,
                           const OutputPlace& place) {
    OnPicture on{pointer, {events.begin(), events.end()}};
    const ImageSize eye = eye_size(output.mode, place.size);
    for (InputEvent& event : on.events) {
        follow(on.pointer, event.input);
        auto* move = std::get_if<MouseMove>(&event.input);
        if (move == nullptr) continue;
        const auto seen = seen_at(output, place, move->position_px, on.pointer.held_px);
        move->position_px = seen ? seen->picture_uv * Vec2(eye.width, eye.height) : kBeside_px;
    }
    return on;
}

}  // namespace burin

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

struct Pointing {
    const PanelStand& stand;
    ImageSize panel;
    const MouseView& mouse;
    Pointed pointed;

    void point(Nanoseconds time_ns, const Pose& along) {
        const auto at = panel_ray(stand, panel, along);
        const bool was_over = pointed.pointer.over;
        pointed.pointer.over = at.has_value();
        if (at) pointed.panel.push_back({time_ns, MouseMove{*at}});
        // Beside the panel, so that nothing on it stays lit.
        if (!at && was_over) pointed.panel.push_back({time_ns, MouseMove{{-1.0, -1.0}}});
    }

    // Whether the panel has it.
    bool press(Nanoseconds time_ns, bool down) {
        PanelPointer& p = pointed.pointer;
        if (down ? !p.over : !p.pressed) return false;
        p.pressed = down;
        pointed.panel.push_back({time_ns, MouseClick{MouseButton::left, down, {}}});
        return true;
    }

    bool scroll(Nanoseconds time_ns, double steps) {
        if (!pointed.pointer.over) return false;
        pointed.panel.push_back({time_ns, Scroll{{0.0, steps}, {}}});
        return true;
    }

    [[nodiscard]] Pose along_mouse(const Vec2& px) const {
        const Vec2 uv = px / mouse.size_px;
        const Screen& s = mouse.screen;
        const Vec3 on_screen = s.lower_left_world + uv.x * (s.lower_right_world - s.lower_left_world) +
                               (1.0 - uv.y) * (s.upper_left_world - s.lower_left_world);
        return looking(mouse.eye_world, on_screen);
    }

    // Whether the panel alone has the event.
    bool take(const InputEvent& event) {
        const Nanoseconds t = event.time_ns;
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
        if (const auto* e = std::get_if<MouseMove>(&event.input)) {
            if (mouse.size_px.x > 0.0 && mouse.size_px.y > 0.0) point(t, along_mouse(e->position_px));
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

}  // namespace burin

// SPDX-License-Identifier: MIT
// Working a panel that stands in the scene: the first wand's ray, or the eyes' line through the mouse, is its pointer. Pure; any thread.
#pragma once

#include <span>
#include <vector>

#include "app/session/input_event.hpp"
#include "renderer/panel/panel_stand.hpp"
#include "renderer/scene.hpp"

namespace burin {

struct PanelPointer {
    bool over = false;     // it points at the panel
    bool pressed = false;  // it was pressed there, and is not released yet
};

// How the mouse's pixels lie on the screen that it moves on, and from where it is looked at.
struct MouseView {
    Screen screen;
    Vec3 eye_world{0.0};  // between the eyes
    Vec2 size_px{1.0};    // of the picture, 0 where there is no mouse
};

// What the panel is told, in its own pixels; what is left for the scene: presses and turns of the wheel or stick that met the panel are not.
struct Pointed {
    PanelPointer pointer;
    std::vector<InputEvent> panel, rest;
};
[[nodiscard]] Pointed point_at_panel(PanelPointer pointer, std::span<const InputEvent> events, const PanelStand& stand,
                                     ImageSize panel, const MouseView& mouse);

}  // namespace burin

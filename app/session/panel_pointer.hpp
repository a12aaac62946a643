// SPDX-License-Identifier: MIT
// Working the panel: where it stands in the scene the first wand's ray, or an eye's line through the mouse, is its pointer; where it lies
// over the eyes' pictures, the mouse as it is seen on them. Pure; any thread.
#pragma once

#include <span>
#include <vector>

#include "app/session/input_event.hpp"
#include "app/session/seen_place.hpp"
#include "renderer/panel/panel_stand.hpp"
#include "renderer/scene.hpp"

namespace burin {

struct PanelPointer {
    bool over = false;                           // it points at the panel
    bool pressed = false;                        // it was pressed there, and is not released yet
    Vec2 mouse_px{0.0};                          // of the output, where the mouse was last
    std::optional<Vec2> held_px = std::nullopt;  // where its left button was pressed that is still down
};

// The screen that the mouse moves on, who looks at it, and how it shows the eyes' pictures.
struct MouseView {
    Screen screen;
    Eyes eyes_world{};
    OutputSettings output;
    OutputPlace place;  // of size 0 where there is no mouse
};

// What the panel is told, in its own pixels; what is left for the scene: presses and turns of the wheel or stick that met the panel are not.
struct Pointed {
    PanelPointer pointer;
    std::vector<InputEvent> panel, rest;
};
[[nodiscard]] Pointed point_at_panel(PanelPointer pointer, std::span<const InputEvent> events, const PanelStand& stand,
                                     ImageSize panel, const MouseView& mouse);

// The same events with the mouse's places in pixels of an eye's picture, whichever of the two it is seen on.
struct OnPicture {
    PanelPointer pointer;
    std::vector<InputEvent> events;
};
[[nodiscard]] OnPicture mouse_on_picture(PanelPointer pointer, std::span<const InputEvent> events,
                                         const OutputSettings& output, const OutputPlace& place);

}  // namespace burin

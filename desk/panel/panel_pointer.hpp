// SPDX-License-Identifier: MIT
// Pointers that work the panel: where it stands in the scene, the first wand's ray or an eye's line through the mouse;
// where it lies over the eyes' pictures, the mouse as it is seen on them. Pure; any thread.
#pragma once

#include <span>
#include <vector>

#include "picture/panel_stand.hpp"
#include "picture/picture.hpp"
#include "session/input/input_event.hpp"
#include "wall/seen_place.hpp"

namespace burin::session {

struct PanelPointer {
    bool over = false;                           // points at the panel
    bool pressed = false;                        // pressed on the panel and not released yet
    Vec2 mouse_px{0.0};                          // last mouse position, in output pixels
    std::optional<Vec2> held_px = std::nullopt;  // where the left button went down that is still held
};

// Screen that the mouse moves on, the eyes that look at it, and how it shows their pictures.
struct MouseView {
    wall::Screen screen;
    wall::Eyes eyes_world{};
    wall::OutputSettings output;
    wall::OutputPlace place;  // size 0 where there is no mouse
};

// Splits the events: those for the panel, in its own pixels, and the rest for the scene, without presses and turns of
// the wheel or stick that met the panel.
struct Pointed {
    PanelPointer pointer;
    std::vector<InputEvent> panel, rest;
};
[[nodiscard]] Pointed point_at_panel(PanelPointer pointer, std::span<const InputEvent> events,
                                     const picture::PanelStand& stand, ImageSize panel, const MouseView& mouse);

// Converts the mouse's positions to pixels of an eye's picture, whichever of the two it is seen on.
struct OnPicture {
    PanelPointer pointer;
    std::vector<InputEvent> events;
};
[[nodiscard]] OnPicture mouse_on_picture(PanelPointer pointer, std::span<const InputEvent> events,
                                         const wall::OutputSettings& output, const wall::OutputPlace& place);

// A panel in a window of its own: the mouse's positions there lie this far to the right of those in the main screen's,
// beyond the right eye's window.
inline constexpr double kPanelWindow_px = 131072.0;

// Divides the events between that window and the scene: the mouse is where it was last moved, and what its buttons
// began in one of them ends there. Keys and text are for both.
struct InWindows {
    std::vector<InputEvent> panel, rest;  // the panel's in pixels of its window
};
[[nodiscard]] InWindows divide_by_window(bool& mouse_on_panel, std::span<const InputEvent> events);

}  // namespace burin::session

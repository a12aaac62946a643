// SPDX-License-Identifier: MIT
// The cube in the corner of a desk's picture: it stands as the workpiece does, each face says from where that is seen,
// and a press on one shows the workpiece from there. It is there while the mouse is led along the surface.
// Frames: world; the cube's own, with edges from -0.5 to 0.5 along the axes of the workpiece's first pose. Pure; any
// thread.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "desk/input/desk_input_table.hpp"
#include "picture/picture.hpp"
#include "session/input/input_event.hpp"

namespace burin::session {

struct Viewer;
struct ViewedSession;
struct ViewerLook;

// Returns where the cube stands; nothing where there is none.
[[nodiscard]] std::optional<Similarity> view_cube(const ViewedSession& seen);
// Returns the view that the face stands for which a line from the eye through another place meets first; nothing where
// it passes by.
[[nodiscard]] std::optional<Action> face_met(const Similarity& world_from_cube, const Vec3& eye_world,
                                             const Vec3& through_world);

// Takes the presses that met the cube out of a step's events, with the views that they asked for. The face under the
// cursor is noted in the viewer, who is the one that sees.
struct BesideCube {
    std::vector<InputEvent> events;
    std::vector<Action> views;
};
[[nodiscard]] BesideCube take_presses(Viewer& viewer, const ViewedSession& seen, std::span<const InputEvent> events,
                                      const ViewerLook& look);

// Adds the cube to the main screen's picture.
void add_view_cube(picture::Picture& scene, const ViewedSession& seen);

}  // namespace burin::session

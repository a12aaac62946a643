// SPDX-License-Identifier: MIT
// A world that a person explores in a desktop's window: what of it fills the part of the picture that the panel leaves
// free, and where the cursor points in the hand's frame. Pure; any thread.
#pragma once

#include <optional>

#include "desk/viewer/viewer.hpp"
#include "scene/object_property.hpp"
#include "session/state/leader.hpp"

namespace burin::session {

// Returns the box with at least this length along each side, about its middle.
[[nodiscard]] Box grown(const Box& box, double least_m);
// Returns the object that the panel shows; null: there is none.
[[nodiscard]] const scene::SceneObject* chosen_object(const SessionState& state, const Viewer& viewer);
// Whether the panel may cover the object after such an edit.
[[nodiscard]] bool moves_or_grows(scene::ObjectProperty property);
// Returns the pose in which an object, and as much around it on each side, fills the free part of the picture.
// Linear in the object's places.
[[nodiscard]] Similarity fitted_to(const scene::SceneObject& object, const SeenFrom& from,
                                   const Quat& world_from_object);
// Returns the scene moved along the screen until the object is between the picture's left edge and the panel; the same
// where it is. Where it is wider than what is free its left edge stays in the picture.
[[nodiscard]] Similarity beside_panel(const scene::SceneObject& object, const SeenFrom& from,
                                      const Similarity& world_from_object);
// Returns from where the cursor is seen, in the frame of the device of the hand in use.
[[nodiscard]] CursorView cursor_of(const ViewedSession& seen, const StepView& view, const wall::OutputPlace& output);

}  // namespace burin::session

// SPDX-License-Identifier: MIT
// Draws a world: its objects as the renderer's, on a plinth before the wall, with the tool that touches them.
// Frames: the scene's is the world file's; scaled and moved, so that the whole world stands before the viewer.
// Pure; any thread.
#pragma once

#include <span>
#include <vector>

#include "haptics/tick_record.hpp"
#include "haptics/tool_state.hpp"
#include "picture/picture.hpp"
#include "scene/mesh_part.hpp"
#include "scene/scene_changes.hpp"
#include "session/objects/drawn_world.hpp"

namespace burin::activities {

class WorldView {
public:
    // Takes the meshes of the objects that are seen. `tool_radius_m`: of the ball that touches, in the scene.
    WorldView(const scene::MeshPart& part, std::span<const scene::ObjectId> ids, double tool_radius_m);
    WorldView(session::DrawnWorld drawn, double tool_radius_m);

    // Takes over what has changed.
    void take(std::span<const scene::ObjectUpdate> updates) { drawn_.take(updates); }
    void take(const session::DrawnWorld& now) { drawn_ = now; }
    // Returns the picture of the world with the tool as it is now, seen from the middle between the eyes, from nearby.
    [[nodiscard]] picture::Picture close_scene(const haptics::ToolState& tool) const;
    // Returns the world on the wall, for a tracked viewer with two eyes.
    [[nodiscard]] picture::Picture wall_scene(const haptics::ToolState& tool) const;

    [[nodiscard]] const Similarity& world_from_scene() const { return world_from_scene_; }
    // Returns the bounds of all that is seen at the beginning.
    [[nodiscard]] const Box& bounds_scene() const { return bounds_scene_; }

private:
    session::DrawnWorld drawn_;
    Box bounds_scene_;
    Similarity world_from_scene_;
    double tool_radius_m_;
};

}  // namespace burin::activities

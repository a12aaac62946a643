// SPDX-License-Identifier: MIT
// The objects of a world as pictures show them: a mesh for each, where it is, and its colour. Objects with one mesh
// share what is drawn of it; sheets are seen from both sides.
// Frame: the scene's, metres. One thread, that of the frames.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "picture/picture.hpp"
#include "scene/mesh_part.hpp"

namespace burin::scene {
struct ObjectUpdate;  // scene/scene_changes.hpp
}  // namespace burin::scene

namespace burin::session {

class DrawnWorld {
public:
    // The objects as they are at the beginning. is_shown: pictures may be made; else no mesh is made ready, and none is
    // returned.
    explicit DrawnWorld(std::span<const scene::SceneObject> objects, bool is_shown = true);

    // Takes over what has changed.
    void take(std::span<const scene::ObjectUpdate> updates);
    // Returns the objects that are seen, where the scene is in the world.
    [[nodiscard]] std::vector<picture::DrawnObject> in_world(const Similarity& world_from_scene) const;
    // Returns the bounds of all that was seen at the beginning, in the scene; empty where nothing was.
    [[nodiscard]] const Box& bounds_scene() const { return bounds_scene_; }

private:
    struct Seen {
        std::shared_ptr<const picture::DrawnMesh> mesh, coloured;  // white, to be tinted; in its file's colours
        bool has_own_colours = false;                              // those of its file
        Similarity scene_from_mesh;
        bool seen = true;
        Vec3 colour{};
        double opacity = 1.0;
    };
    std::map<scene::ObjectId, Seen> objects_;
    Box bounds_scene_;
};

}  // namespace burin::session

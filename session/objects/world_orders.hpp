// SPDX-License-Identifier: MIT
// What a session's scene is told about the objects of its world. Plain data.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/object_id.hpp"
#include "scene/scene_object.hpp"

namespace burin::session {

struct WorldOrder {
    scene::ObjectId object = 0;
    scene::ObjectEdit edit;
};

// What parts of hands take hold of, by the numbers that the scene knows them by (scene/mesh_part.hpp); by none: it is
// let go of.
struct HoldOrder {
    scene::ObjectId object = 0;
    std::vector<std::size_t> parts;
    bool felt = false;  // by these parts
};

}  // namespace burin::session

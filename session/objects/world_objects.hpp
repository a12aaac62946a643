// SPDX-License-Identifier: MIT
// The objects of a session's world as its frames know them: as they were read, with all that commands have changed
// since and with where hands have left them. A value that states share and nobody changes.
// Frame: the scene's, metres. Pure; any thread.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/haptic_material.hpp"
#include "scene/scene_object.hpp"
#include "session/objects/edit_object.hpp"
#include "session/objects/world_orders.hpp"

namespace burin::scene {
struct ObjectUpdate;  // scene/scene_changes.hpp
}  // namespace burin::scene

namespace burin::session {

struct WorldObjects {
    std::string name;
    std::vector<std::shared_ptr<const scene::SceneObject>> objects;  // numbered from 1 in this order
    scene::MaterialTable materials;                                  // as of the last update that a frame took

    // Returns null where there is none.
    [[nodiscard]] const scene::SceneObject* find(scene::ObjectId id) const {
        return id >= 1 && id <= objects.size() ? objects[id - 1].get() : nullptr;
    }
};

// Returns the object of that name. Fails where there is none, and says which name is nearest.
[[nodiscard]] Result<scene::ObjectId> object_named(const WorldObjects& world, const std::string& name);

// Returns the world after the command, and the order with which the scene follows. Fails where the world has no object
// of that name, where the value is out of bounds, and where there would be more materials than a session has room for.
struct EditedWorld {
    std::shared_ptr<const WorldObjects> world;
    WorldOrder order;
};
[[nodiscard]] Result<EditedWorld> edited(const WorldObjects& world, const EditObject& command);
// Likewise with the object as it is here, which was in this world before.
[[nodiscard]] Result<EditedWorld> restored(const WorldObjects& world, std::shared_ptr<const scene::SceneObject> object);

// Returns the world with objects where they are now, also those that a hand holds, and with the materials of these
// updates; the same one where nothing of it has changed.
[[nodiscard]] std::shared_ptr<const WorldObjects> followed(std::shared_ptr<const WorldObjects> world,
                                                           std::span<const scene::ObjectUpdate> updates,
                                                           const scene::MaterialTable* materials);

}  // namespace burin::session

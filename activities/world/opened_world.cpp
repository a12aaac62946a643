// SPDX-License-Identifier: MIT
#include "activities/world/opened_world.hpp"

#include <cstdint>
#include <utility>

#include "base/try.hpp"
#include "scene/world_digest.hpp"
#include "session/live/world_side.hpp"

namespace burin::activities {

Result<std::unique_ptr<OpenedWorld>> open_world(const std::string& path, const MaterialOverride& materials) {
    BURIN_TRY(world, session::read_sound_world(path));
    auto opened = std::make_unique<OpenedWorld>();
    for (scene::SceneObject& object : world.objects) {
        materials.apply(object.material);
        opened->ids.push_back(object.id);
        opened->objects.push_back({static_cast<std::int64_t>(object.id), object.name});
    }
    opened->digest = scene::world_digest(world.objects);
    BURIN_TRY(part, scene::MeshPart::create(std::move(world.objects), opened->materials));
    opened->part = std::move(part);
    return opened;
}

}  // namespace burin::activities

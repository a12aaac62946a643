// SPDX-License-Identifier: MIT
// The world of a session: its objects as a part of the scene, and as pictures show them.
// Frame: the scene's. The part and its materials belong to the scene's thread once that has started; all else to the
// frame's.
#pragma once

#include <memory>
#include <string>

#include "scene/world_file.hpp"
#include "scene/world_reading.hpp"
#include "session/objects/drawn_world.hpp"
#include "session/objects/world_objects.hpp"

namespace burin::session {

// Reads a world, that of a document, or a mesh as a world of one object. Where it has several problems all are printed.
[[nodiscard]] Result<scene::World> read_sound_world(const std::string& path, const scene::WorldReading& reading = {});

class WorldSide {
public:
    // is_shown: pictures may be made of it.
    [[nodiscard]] static Result<std::unique_ptr<WorldSide>> create(scene::World world, bool is_shown = true);

    [[nodiscard]] scene::MeshPart& part() { return *part_; }
    [[nodiscard]] const scene::MeshPart& part() const { return *part_; }
    [[nodiscard]] const scene::MaterialTable& materials() const { return materials_; }
    // Returns the objects as they were read.
    [[nodiscard]] const std::shared_ptr<const WorldObjects>& objects() const { return objects_; }
    [[nodiscard]] DrawnWorld& drawn() { return drawn_; }
    [[nodiscard]] const DrawnWorld& drawn() const { return drawn_; }

private:
    WorldSide(const scene::World& world, bool is_shown) : drawn_(world.objects, is_shown) {}

    scene::MaterialTable materials_{1};  // the first is a carved workpiece's
    std::unique_ptr<scene::MeshPart> part_;
    std::shared_ptr<const WorldObjects> objects_;
    DrawnWorld drawn_;
};

}  // namespace burin::session

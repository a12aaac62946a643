// SPDX-License-Identifier: MIT
#include "activities/world/opened_world.hpp"

#include <cstdint>
#include <utility>

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "record/motion.hpp"
#include "scene/world_digest.hpp"
#include "session/live/world_side.hpp"

namespace burin::activities {

Result<std::unique_ptr<OpenedWorld>> open_world(const std::string& path, const MaterialOverride& materials) {
    BURIN_TRY(world, session::read_sound_world(path));
    auto opened = std::make_unique<OpenedWorld>();
    for (scene::SceneObject& object : world.objects) {
        materials.apply(object.material);
        opened->objects.push_back({static_cast<std::int64_t>(object.id), object.name});
    }
    opened->digest = scene::world_digest(world.objects);
    opened->scene = std::make_shared<const scene::World>(std::move(world));
    return opened;
}

Result<std::vector<std::pair<std::string, std::string>>> facts_of_stroke(
    const std::string& world_file, const OpenedWorld& world, const std::string& stroke_file,
    std::vector<std::pair<std::string, std::string>> facts) {
    BURIN_TRY(world_bytes, file_digest(world_file));
    BURIN_TRY(stroke_bytes, file_digest(stroke_file));
    facts.emplace_back("command", "world --stroke");
    facts.emplace_back("world", world_file);
    facts.emplace_back("world file sha256", world_bytes);
    facts.emplace_back(record::kWorldDigestFact, world.digest);
    facts.emplace_back("stroke", stroke_file);
    facts.emplace_back("stroke sha256", stroke_bytes);
    facts.emplace_back("time", "simulated");
    return facts;
}

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
#include "session/live/world_side.hpp"

#include <cstdio>
#include <utility>

#include "base/try.hpp"
#include "scene/vrml_world.hpp"
#include "session/work/opened_work.hpp"

namespace burin::session {

Result<scene::World> read_sound_world(const std::string& path, const scene::WorldReading& reading) {
    if (document::is_document_name(path)) {
        BURIN_TRY(opened, open_document(path));
        if (!opened.lost.empty()) std::fprintf(stderr, "burin: %s\n", opened.lost.c_str());
        if (!opened.world) return fail(path, "holds no world", "open it as a workpiece: burin sculpt " + path);
        return std::move(*opened.world);
    }
    scene::WorldOrProblems world = scene::read_any_world(path, reading);
    if (world) {
        for (const std::string& remark : world->remarks) std::fprintf(stderr, "burin: %s\n", remark.c_str());
        return std::move(*world);
    }
    if (world.error().size() == 1) return std::unexpected(world.error().front());
    for (const Error& problem : world.error()) std::fprintf(stderr, "burin: %s\n", problem.line().c_str());
    return fail(path, std::to_string(world.error().size()) + " problems", "correct them; burin world check lists them");
}

Result<std::unique_ptr<WorldSide>> WorldSide::create(scene::World world, bool is_shown) {
    std::unique_ptr<WorldSide> side(new WorldSide(world, is_shown));
    auto objects = std::make_shared<WorldObjects>();
    objects->name = std::move(world.name);
    for (const scene::SceneObject& object : world.objects)
        objects->objects.push_back(std::make_shared<const scene::SceneObject>(object));
    BURIN_TRY(part, scene::MeshPart::create(std::move(world.objects), side->materials_));
    side->part_ = std::move(part);
    objects->materials = side->materials_;
    side->objects_ = std::move(objects);
    return side;
}

}  // namespace burin::session

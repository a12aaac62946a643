// SPDX-License-Identifier: MIT
#include "session/work/saved_world.hpp"

#include "scene/saved_objects.hpp"

namespace burin::session {

void SavedWorld::begin(const WorldObjects& now, bool is_saved) {
    std::vector<const geometry::TriangleMesh*> meshes;
    for (const auto& object : now.objects) meshes.push_back(object->mesh.get());
    meshes_ = scene::mesh_numbers(meshes);
    colours_.clear();
    for (const auto& object : now.objects) colours_.push_back(object->corner_colours);
    saved_ = is_saved ? now.objects : Objects(now.objects.size());
    told_ = now.objects;
}

scene::Pages SavedWorld::pages(const WorldObjects& now, const Objects* known) const {
    scene::Pages pages{.part = std::string(scene::kObjectsPart), .whole = known == nullptr};
    for (std::size_t i = 0; i < now.objects.size(); ++i)
        if (known == nullptr || now.objects[i] != (*known)[i])
            scene::save_object(*now.objects[i], colours_[i].get(), meshes_[i],
                               scene::object_bytes(*now.objects[i], meshes_[i]), pages);
    return pages;
}

scene::Pages SavedWorld::save(const WorldObjects& now, bool whole) {
    scene::Pages given = pages(now, whole ? nullptr : &saved_);
    saved_ = now.objects;
    return given;
}

scene::Pages SavedWorld::all(const WorldObjects& now) {
    told_ = now.objects;
    return pages(now, nullptr);
}

std::optional<scene::Pages> SavedWorld::take_change(const WorldObjects& now) {
    scene::Pages change{.part = std::string(scene::kObjectsPart), .whole = false};
    for (std::size_t i = 0; i < now.objects.size(); ++i) {
        if (now.objects[i] == told_[i]) continue;
        const scene::SceneObject& object = *now.objects[i];
        change.pages[scene::change_of(object.id)] = scene::object_bytes(object, meshes_[i]);
    }
    told_ = now.objects;
    if (change.pages.empty()) return std::nullopt;
    return change;
}

}  // namespace burin::session

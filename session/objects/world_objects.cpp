// SPDX-License-Identifier: MIT
#include "session/objects/world_objects.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "base/try.hpp"
#include "scene/object_property.hpp"
#include "scene/scene_changes.hpp"
#include "scene/world_file.hpp"

namespace burin::session {
namespace {

// Counts the different materials that would be felt.
bool materials_fit(const WorldObjects& world) {
    std::vector<scene::HapticMaterial> felt;
    for (const auto& object : world.objects) {
        if (!object->felt || std::ranges::find(felt, object->material) != felt.end()) continue;
        felt.push_back(object->material);
    }
    return felt.size() <= scene::kMaxWorldMaterials;
}

}  // namespace

Result<scene::ObjectId> object_named(const WorldObjects& world, const std::string& name) {
    std::vector<std::string_view> names;
    for (const auto& object : world.objects) {
        if (object->name == name) return object->id;
        names.push_back(object->name);
    }
    if (names.empty()) return fail("object " + name, "is none of this session", "open a world: burin world FILE");
    return fail("object " + name, "there is none of this name",
                "did you mean " + std::string(nearest_name(name, names)) + "?");
}

Result<EditedWorld> edited(const WorldObjects& world, const EditObject& command) {
    BURIN_TRY(id, object_named(world, command.object));
    const scene::SceneObject& object = *world.find(id);
    const scene::ObjectEdit edit = scene::edit_of(object, command.property, command.value);
    BURIN_TRY(changed, scene::edited(object, edit));
    auto next = std::make_shared<WorldObjects>(world);
    next->objects[id - 1] = std::make_shared<const scene::SceneObject>(std::move(changed));
    if (!materials_fit(*next))
        return fail(
            "object " + command.object,
            formatted("would feel like no other, and there is room for %zu materials", scene::kMaxWorldMaterials),
            "let it feel like another object");
    return EditedWorld{std::move(next), {id, edit}};
}

Result<EditedWorld> restored(const WorldObjects& world, std::shared_ptr<const scene::SceneObject> object) {
    const scene::ObjectId id = object->id;
    const scene::ObjectEdit edit = scene::Restore{object};
    BURIN_TRY(changed, scene::edited(*world.find(id), edit));
    const bool was_held = std::holds_alternative<scene::HeldMotion>(object->motion);
    auto next = std::make_shared<WorldObjects>(world);
    next->objects[id - 1] =
        was_held ? std::make_shared<const scene::SceneObject>(std::move(changed)) : std::move(object);
    if (!materials_fit(*next))
        return fail("object " + next->objects[id - 1]->name, "cannot be made what it was: there are too many materials",
                    "let another object feel like one more");
    return EditedWorld{std::move(next), {id, edit}};
}

std::shared_ptr<const WorldObjects> followed(std::shared_ptr<const WorldObjects> world,
                                             std::span<const scene::ObjectUpdate> updates,
                                             const scene::MaterialTable* materials) {
    if (!world) return world;
    std::shared_ptr<WorldObjects> next;
    const auto changed = [&]() -> WorldObjects& {
        if (!next) next = std::make_shared<WorldObjects>(*world);
        return *next;
    };
    for (const scene::ObjectUpdate& update : updates) {
        const scene::SceneObject* object = world->find(update.id);
        if (object == nullptr) continue;
        const bool is_held = std::holds_alternative<scene::HeldMotion>(update.motion);
        const Similarity& placed = update.scene_from_mesh;
        const Pose pose = is_held ? Pose{placed.position_m, placed.orientation} : update.pose;
        if (object->pose == pose && object->motion == update.motion) continue;
        scene::SceneObject moved = *object;
        moved.pose = pose;
        moved.motion = update.motion;
        changed().objects[update.id - 1] = std::make_shared<const scene::SceneObject>(std::move(moved));
    }
    if (materials != nullptr) changed().materials = *materials;
    return next ? next : world;
}

}  // namespace burin::session

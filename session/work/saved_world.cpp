// SPDX-License-Identifier: MIT
#include "session/work/saved_world.hpp"

#include "scene/saved_objects.hpp"

namespace burin::session {
namespace {

std::map<std::int64_t, std::uint64_t> states_of(const WorldHistory& edits) {
    std::map<std::int64_t, std::uint64_t> states;
    const scene::PartSteps now = edits.steps();
    for (std::int64_t number = now.first; number <= now.last; ++number) states[number] = edits.state_after(number);
    return states;
}

}  // namespace

void SavedWorld::begin(const WorldObjects& now, const WorldHistory& edits, bool is_saved) {
    std::vector<const geometry::TriangleMesh*> meshes;
    for (const auto& object : now.objects) meshes.push_back(object->mesh.get());
    meshes_ = scene::mesh_numbers(meshes);
    colours_.clear();
    for (const auto& object : now.objects) colours_.push_back(object->corner_colours);
    saved_ = is_saved ? now.objects : Objects(now.objects.size());
    told_ = now.objects;
    saved_steps_ = is_saved ? states_of(edits) : States();
    told_steps_ = states_of(edits);
    told_state_ = edits.state();
}

scene::Steps SavedWorld::steps(const WorldHistory& edits, const States& known) const {
    const scene::PartSteps now = edits.steps();
    scene::Steps given{.first = now.first, .done = now.done, .last = now.last};
    for (std::int64_t number = now.first; number <= now.last; ++number) {
        const auto at = known.find(number);
        if (at != known.end() && at->second == edits.state_after(number)) continue;
        const scene::ObjectStep& step = edits.step(number);
        scene::save_step(step, number, meshes_[step.before->id - 1], given.pages);
    }
    return given;
}

scene::Pages SavedWorld::pages(const WorldObjects& now, const Objects* known) const {
    scene::Pages pages{.part = std::string(scene::kObjectsPart), .whole = known == nullptr};
    for (std::size_t i = 0; i < now.objects.size(); ++i)
        if (known == nullptr || now.objects[i] != (*known)[i])
            scene::save_object(*now.objects[i], colours_[i].get(), meshes_[i],
                               scene::object_bytes(*now.objects[i], meshes_[i]), pages);
    return pages;
}

scene::Pages SavedWorld::save(const WorldObjects& now, const WorldHistory& edits, bool whole) {
    scene::Pages given = pages(now, whole ? nullptr : &saved_);
    given.steps = steps(edits, whole ? States() : saved_steps_);
    saved_ = now.objects;
    saved_steps_ = states_of(edits);
    return given;
}

scene::Pages SavedWorld::all(const WorldObjects& now, const WorldHistory& edits) {
    scene::Pages given = pages(now, nullptr);
    given.steps = steps(edits, {});
    told_ = now.objects;
    told_steps_ = states_of(edits);
    told_state_ = edits.state();
    return given;
}

std::optional<scene::Pages> SavedWorld::take_change(const WorldObjects& now, const WorldHistory& edits) {
    if (told_ == now.objects && told_state_ == edits.state()) return std::nullopt;
    scene::Pages change{.part = std::string(scene::kObjectsPart), .whole = false};
    for (std::size_t i = 0; i < now.objects.size(); ++i) {
        if (now.objects[i] == told_[i]) continue;
        const scene::SceneObject& object = *now.objects[i];
        change.pages[scene::change_of(object.id)] = scene::object_bytes(object, meshes_[i]);
    }
    change.steps = steps(edits, told_steps_);
    told_ = now.objects;
    told_steps_ = states_of(edits);
    told_state_ = edits.state();
    return change;
}

}  // namespace burin::session

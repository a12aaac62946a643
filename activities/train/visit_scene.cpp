// SPDX-License-Identifier: MIT
#include "activities/train/visit_scene.hpp"

#include "study/felt/felt_world.hpp"

#include <algorithm>

namespace burin::activities {
namespace {

std::vector<const study::FeltWorld*> worlds_of(const study::Protocol& protocol, const FeltWorlds& worlds,
                                               const std::vector<study::StagePlace>& places) {
    std::vector<const study::FeltWorld*> found;
    for (const study::StagePlace& at : places) {
        if (at.stage->world.empty()) continue;
        const study::FeltWorld* world = worlds.at(at.stage->world).get();
        if (std::ranges::find(found, world) == found.end()) found.push_back(world);
    }
    if (found.empty()) found.push_back(worlds.at(protocol.worlds.front().name).get());
    return found;
}

}  // namespace

VisitScene::VisitScene(const study::Protocol& protocol, const FeltWorlds& worlds,
                       const std::vector<study::StagePlace>& places)
    : worlds_(worlds_of(protocol, worlds, places)) {
    auto scene = std::make_shared<scene::World>();
    for (const study::FeltWorld* world : worlds_) {
        const study::StudyWorld& own = world->world();
        const bool first = world == worlds_.front();
        scene->name += (first ? "" : ", ") + own.name;
        for (const scene::ObjectId id : world->objects()) {
            scene::SceneObject object = world->part().object(id);
            if (!first) object.name = own.name + ": " + object.name;
            if (object.felt)
                object.material = {.stiffness_N_per_m = own.wall_N_per_m, .damping_Ns_per_m = own.wall_Ns_per_m};
            object.seen = object.seen && first && id != study::kSeenTubeObject;
            object.felt = object.felt && first;
            places_[{world, id}] = scene->objects.size();
            object.id = scene->objects.size() + 1;
            scene->objects.push_back(std::move(object));
        }
    }
    scene_ = std::move(scene);
    const study::FeltWorld& first = *worlds_.front();
    const auto is_same = [&](scene::ObjectId id) { return object(first, id).id == id; };
    if (std::ranges::all_of(first.objects(), is_same)) as_numbered_ = &first;
}

const scene::SceneObject& VisitScene::object(const study::FeltWorld& world, scene::ObjectId id) const {
    return scene_->objects[places_.at({&world, id})];
}

scene::ObjectId VisitScene::number_in(const study::FeltWorld& world, scene::ObjectId of_scene) const {
    for (const scene::ObjectId id : world.objects())
        if (object(world, id).id == of_scene) return id;
    return 0;
}

}  // namespace burin::activities

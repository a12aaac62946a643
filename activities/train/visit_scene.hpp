// SPDX-License-Identifier: MIT
// The worlds of a participant's visit as the scene of a live session: every object of every world that a stage of the
// visit has, under a name and a number of its own. The activity lets those of one world be felt and seen at a time.
//
// The objects of the first world keep their names ("tube"); those of another are called by their world as well
// ("curve: tube"). Numbers count from 1 in the order of the worlds.
// Frame: the worlds', which is the scene's. Immutable; any thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/train/ended_stage.hpp"
#include "scene/world_file.hpp"

namespace burin::activities {

class VisitScene {
public:
    // The worlds of the places' stages; of a visit of pages alone, the protocol's first. They must outlive it.
    VisitScene(const study::Protocol& protocol, const FeltWorlds& worlds, const std::vector<study::StagePlace>& places);

    [[nodiscard]] const std::vector<const study::FeltWorld*>& worlds() const { return worlds_; }
    // Felt is what of the first world can be felt.
    [[nodiscard]] const std::shared_ptr<const scene::World>& scene() const { return scene_; }
    // The object of a world as the scene has it. Requires a world of worlds().
    [[nodiscard]] const scene::SceneObject& object(const study::FeltWorld& world, scene::ObjectId id) const;
    // Returns the number that an object of the scene has in this world; 0: it is none of this world's.
    [[nodiscard]] scene::ObjectId number_in(const study::FeltWorld& world, scene::ObjectId of_scene) const;
    // Returns whether the scene's numbers of all objects of this world are the world's own.
    [[nodiscard]] bool has_numbers_of(const study::FeltWorld& world) const { return &world == as_numbered_; }

private:
    std::vector<const study::FeltWorld*> worlds_;
    std::shared_ptr<const scene::World> scene_;
    const study::FeltWorld* as_numbered_ = nullptr;  // has its own numbers in the scene; null: none has
    std::map<std::pair<const study::FeltWorld*, scene::ObjectId>, std::size_t> places_;  // index in the scene
};

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
// A world that a hand explores along a script, with what a recording of that names. Plain data.
#pragma once

#include <memory>
#include <string>

#include "scene/object_id.hpp"

namespace burin::scene {
struct World;  // scene/world_file.hpp
}  // namespace burin::scene

namespace burin::activities {

// A world to be explored, the device that feels it, and the file that the exploration is recorded into.
struct ExploredWorld {
    std::string file = {};                           // as a recording names it; empty: none
    std::shared_ptr<const scene::World> scene = {};  // as it was read
    std::string device = "simulated";
    std::string points = {};  // of a wand, as --points names them
    std::string record = {};  // a new session file; empty: none
};

// Returns the name of an object of a world; empty where there is none of that number.
[[nodiscard]] std::string name_in(const scene::World& world, scene::ObjectId id);

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
// What `burin world check` finds in a file: its objects and what a hand feels of them, or all that is wrong with it.
#pragma once

#include <cstddef>
#include <string>

#include "base/json.hpp"
#include "scene/world_reading.hpp"

namespace burin::app {

struct CheckedWorld {
    Json json;  // as in the --json of the command
    std::size_t faults = 0;
};

// Checks a world: TOML, VRML, a mesh or a document. print: tells on standard output what is there, or what is wrong.
[[nodiscard]] CheckedWorld check_world(const std::string& path, const scene::WorldReading& reading, bool print);

}  // namespace burin::app

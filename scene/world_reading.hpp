// SPDX-License-Identifier: MIT
// How a world's file is read, where the file leaves that open. Plain data; any thread.
#pragma once

#include <string>

#include "base/error.hpp"

namespace burin::scene {

struct WorldReading {
    // What a number of the file is: "mm", or "2.54mm" for units of 0.1 inch. Empty: what the settings beside a world in
    // VRML say, else metres; of a mesh, what the file states, else a guess (geometry/files/mesh_unit.hpp).
    std::string unit = {};
    // A folder around the file: of it and below it files may be named. Empty: the file's own.
    std::string root = {};
};

// Returns the metres in a unit, written as above. `where` names the option or key in the message.
[[nodiscard]] Result<double> parse_world_unit(const std::string& text, const std::string& where);

}  // namespace burin::scene

// SPDX-License-Identifier: MIT
// Makes a world of one mesh: an object with the file's name that stands where the file has it and feels like any other.
// An open mesh, or one whose triangles face both ways, is felt from both sides, and a remark says so.
// Failure: as read_world(). Threads: any; nothing shared.
#pragma once

#include <filesystem>

#include "scene/world_file.hpp"

namespace burin::scene {

// Returns whether the file's name is that of a mesh.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& path);
[[nodiscard]] WorldOrProblems read_mesh_world(const std::filesystem::path& path, const std::string& unit = {});

}  // namespace burin::scene

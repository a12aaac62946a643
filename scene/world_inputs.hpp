// SPDX-License-Identifier: MIT
// Tells which files a world reads, so that no output overwrites one. Threads: any. Cost: that of reading the world's
// text, and the texts that it inlines; its meshes are not read.
#pragma once

#include <filesystem>
#include <vector>

namespace burin::scene {

// Returns the world's own file, whether it is there or not, and what read_any_world() reads besides: the meshes of a
// world in TOML, what a world in VRML inlines and the settings beside it, also where there are none yet, and material
// files of meshes. Of a file with faults, those that it names nevertheless.
[[nodiscard]] std::vector<std::filesystem::path> files_of_world(const std::filesystem::path& path);

}  // namespace burin::scene

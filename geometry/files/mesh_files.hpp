// SPDX-License-Identifier: MIT
// Tells which files import_mesh() opens for a mesh, so that no output overwrites one. Threads: any. Cost: of an OBJ the
// reading of its text, of other formats none.
#pragma once

#include <filesystem>
#include <vector>

namespace burin::geometry {

// Returns the mesh itself, whether it is there or not, and the material files that an OBJ names.
[[nodiscard]] std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path);

}  // namespace burin::geometry

// SPDX-License-Identifier: MIT
// Tells which files import_mesh() opens for a mesh, so that no output overwrites one. Threads: any. Cost: of an OBJ the
// reading of its text, of a PLY that of its header, of other formats none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace burin::geometry {

// Bounds of what an OBJ may name: a hostile file could name thousands. What is written stays within them.
inline constexpr std::size_t kMostMaterialFiles = 64;
inline constexpr std::uint64_t kMaxMaterialFileBytes = 64 << 20;

// Returns the names of a line that names several material files, with blanks between them and quotes around some.
[[nodiscard]] std::vector<std::string> material_file_names(std::string_view names);

// Returns the mesh itself, whether it is there or not, the material files that an OBJ may name with their pictures, and
// the pictures of a PLY: of a line with blanks in it the one file of that name, and one of each word.
[[nodiscard]] std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path);

}  // namespace burin::geometry

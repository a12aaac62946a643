// SPDX-License-Identifier: MIT
// Reads a world.toml: the objects of a scene, with meshes from files beside it. docs/formats.md has the keys.
//
// All problems of a file are listed at once, each with line and remedy: TOML that is none ends the reading, everything
// else does not. Only a file without a problem gives a world.
// Hardest case: a file by somebody else. It may name meshes in its own folder and below alone, through no link that
// leads out; a thousand objects may name one mesh, which is then read and kept once; what is in memory is bounded by
// what the files hold and by the limits below.
// Units: metres, radians nowhere (orientations are quaternions). Frame: the scene's. Threads: any; nothing shared.
// Cost: that of reading the meshes, once each, and of examining them (geometry/mesh/mesh_health.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "geometry/files/mesh_import.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

inline constexpr std::uint64_t kMaxWorldBytes = std::uint64_t{1} << 24;
inline constexpr std::size_t kMaxWorldObjects = 4096;
inline constexpr std::size_t kMaxWorldTriangles = 10'000'000;  // of the different meshes together
// Different materials of what is felt. The session's first is that of a carved workpiece.
inline constexpr std::size_t kMaxWorldMaterials = MaterialTable::kMaxEntries - 1;

struct World {
    std::string name;
    std::vector<SceneObject> objects;  // numbered from 1 in the file's order
    std::vector<std::string> remarks;  // one line each, for the user: what was assumed
};

using WorldOrProblems = std::expected<World, std::vector<Error>>;

// Returns the mesh that a world names, by its path relative to the world's folder.
using WorldMeshReader =
    std::function<Result<geometry::ImportedMesh>(const std::string& name, std::optional<LengthUnit> given_unit)>;

// Reads meshes in the folder of a world's file and below it.
[[nodiscard]] WorldMeshReader meshes_beside(const std::filesystem::path& world);

// Reads the text of a world. `name` stands for the file in messages.
[[nodiscard]] WorldOrProblems parse_world(std::string_view text, const std::string& name,
                                          const WorldMeshReader& read_mesh);

// Reads a world's file and the meshes that it names.
[[nodiscard]] WorldOrProblems read_world(const std::filesystem::path& path);

}  // namespace burin::scene

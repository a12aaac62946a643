// SPDX-License-Identifier: MIT
// What a recording is compared by before it is replayed: digests of a world and of files. Any thread.
#pragma once

#include <span>
#include <string>

#include "base/error.hpp"
#include "scene/scene_object.hpp"

namespace burin::app {

// The fact of a session file that holds a world's digest.
inline constexpr const char* kWorldDigestFact = "world sha256";

// Returns the SHA-256 of all that is in a world, meshes included, as it was read: the same for another file with the
// same objects, another one where anything that is felt or seen is another. 64 hexadecimal digits. Cost: one pass over
// the meshes, each once.
[[nodiscard]] std::string world_digest(std::span<const scene::SceneObject> objects);

// Returns the SHA-256 of a file's bytes, as sha256sum prints it.
[[nodiscard]] Result<std::string> file_digest(const std::string& path);

}  // namespace burin::app

// SPDX-License-Identifier: MIT
// The digest of a world, by which a recording of it is compared before it is replayed. Any thread.
#pragma once

#include <span>
#include <string>

#include "scene/scene_object.hpp"

namespace burin::scene {

// Returns the SHA-256 of all that is in a world, meshes included, as it was read: the same for another file with the
// same objects, another one where anything that is felt or seen is another. 64 hexadecimal digits. Cost: one pass over
// the meshes, each once.
[[nodiscard]] std::string world_digest(std::span<const SceneObject> objects);

}  // namespace burin::scene

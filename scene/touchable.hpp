// SPDX-License-Identifier: MIT
// Says whether a session can make an object felt, as geometry/contact/touch_mesh.hpp asks for: it has triangles, and no
// vertex is farther than 1e8 m from its mesh's origin at its scale. Pure; any thread. Cost: a look at each vertex.
#pragma once

#include <algorithm>
#include <cmath>

#include "scene/scene_object.hpp"

namespace burin::scene {

// The object must have a mesh.
[[nodiscard]] inline bool can_be_touched(const SceneObject& object) {
    constexpr double kFarthest_m = 1e8;
    const auto is_near = [&](const Vec3& p) {
        return object.scale * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthest_m;
    };
    return !object.mesh->triangles.empty() && std::ranges::all_of(object.mesh->positions_m, is_near);
}

}  // namespace burin::scene

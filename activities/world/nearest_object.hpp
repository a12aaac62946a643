// SPDX-License-Identifier: MIT
// Tells how near a place is to objects of a world that are not touched. Which object is touched, the tick has found
// (haptics::PointRecord::object). One thread. Frame: the scene's.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh/triangle_tree.hpp"
#include "scene/mesh_part.hpp"

namespace burin::activities {

// Finds the object whose surface is nearest to a place.
class NearestObject {
public:
    NearestObject(const scene::MeshPart& part, std::span<const scene::ObjectId> ids);

    struct Near {
        scene::ObjectId id = 0;
        double distance_m = 0.0;
    };
    // None: nothing can be felt.
    [[nodiscard]] std::optional<Near> at(const Vec3& place_scene) const;

private:
    const scene::MeshPart& part_;
    std::map<const geometry::TriangleMesh*, std::shared_ptr<const geometry::TriangleTree>> trees_;
    std::vector<std::pair<scene::ObjectId, std::shared_ptr<const geometry::TriangleTree>>> objects_;
};

}  // namespace burin::activities

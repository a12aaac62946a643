// SPDX-License-Identifier: MIT
#include "activities/world/nearest_object.hpp"

namespace burin::activities {

NearestObject::NearestObject(const scene::MeshPart& part, std::span<const scene::ObjectId> ids) : part_(part) {
    for (const scene::ObjectId id : ids) {
        const scene::SceneObject& object = part.object(id);
        if (!object.felt) continue;
        auto& tree = trees_[object.mesh.get()];
        if (!tree) tree = std::make_shared<geometry::TriangleTree>(object.mesh->positions_m, object.mesh->triangles);
        objects_.emplace_back(id, tree);
    }
}

std::optional<NearestObject::Near> NearestObject::at(const Vec3& place_scene) const {
    std::optional<Near> nearest;
    for (const auto& [id, tree] : objects_) {
        const Pose& pose = part_.pose(id);
        const Similarity mesh_from_scene =
            inverse(Similarity{pose.position_m, pose.orientation, part_.object(id).scale});
        const double distance_m = tree->nearest(mesh_from_scene * place_scene, 0).distance_m / mesh_from_scene.scale;
        if (!nearest || distance_m < nearest->distance_m) nearest = Near{id, distance_m};
    }
    return nearest;
}

}  // namespace burin::activities

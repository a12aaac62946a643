// SPDX-License-Identifier: MIT
#include "session/picture/drawn_world.hpp"

#include <utility>

#include "renderer/scene/frame_setup.hpp"

namespace burin::session {
namespace {

Vec3 srgb_of(const scene::Colour& c) { return Vec3(c[0], c[1], c[2]) / 255.0; }

// The object's colour counts, whatever materials its file has. What is felt from both sides is a sheet, and is seen
// from both: each of its triangles is there the other way round as well.
geometry::TriangleMesh plain_mesh(const scene::SceneObject& object) {
    geometry::TriangleMesh plain{object.mesh->positions_m, object.mesh->triangles, {}, {}, {}};
    if (!object.both_sides) return plain;
    plain.triangles.reserve(2 * object.mesh->triangles.size());
    for (const auto& [a, b, c] : object.mesh->triangles) plain.triangles.push_back({a, c, b});
    return plain;
}

Pose pose_at_the_beginning(const scene::SceneObject& object) {
    const auto* path = std::get_if<scene::PathMotion>(&object.motion);
    return path == nullptr ? object.pose : scene::composed(object.pose, scene::pose_on(*path, 0.0));
}

}  // namespace

DrawnWorld::DrawnWorld(std::span<const scene::SceneObject> objects) {
    std::map<std::pair<const geometry::TriangleMesh*, bool>, std::shared_ptr<const renderer::DrawnMesh>> drawn;
    for (const scene::SceneObject& object : objects) {
        auto& mesh = drawn[{object.mesh.get(), object.both_sides}];
        if (!mesh) mesh = renderer::drawn_mesh(plain_mesh(object));
        const Pose pose = pose_at_the_beginning(object);
        const Similarity scene_from_mesh{pose.position_m, pose.orientation, object.scale};
        objects_[object.id] = {mesh, scene_from_mesh, object.seen, srgb_of(object.colour), object.opacity};
        const Box bounds = renderer::placed_box(mesh->bounds, scene_from_mesh);
        if (!object.seen || bounds.empty()) continue;
        bounds_scene_.include(bounds.lo);
        bounds_scene_.include(bounds.hi);
    }
}

void DrawnWorld::take(std::span<const scene::ObjectUpdate> updates) {
    for (const scene::ObjectUpdate& update : updates) {
        const auto at = objects_.find(update.id);
        if (at == objects_.end()) continue;
        at->second = {at->second.mesh, update.scene_from_mesh, update.seen, srgb_of(update.colour), update.opacity};
    }
}

std::vector<renderer::DrawnObject> DrawnWorld::in_world(const Similarity& world_from_scene) const {
    std::vector<renderer::DrawnObject> list;
    for (const auto& [id, object] : objects_)
        if (object.seen)
            list.push_back({object.mesh, world_from_scene * object.scene_from_mesh, object.colour, object.opacity});
    return list;
}

}  // namespace burin::session

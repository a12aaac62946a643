// SPDX-License-Identifier: MIT
#include "session/objects/drawn_world.hpp"

#include <tuple>
#include <utility>

#include "picture/frame_setup.hpp"
#include "scene/scene_changes.hpp"

namespace burin::session {
namespace {

Vec3 srgb_of(const scene::Colour& c) { return Vec3(c[0], c[1], c[2]) / 255.0; }

// What is felt from both sides is a sheet, and is seen from both: each of its triangles is there the other way round as
// well.
std::shared_ptr<const picture::DrawnMesh> mesh_of(const scene::SceneObject& object,
                                                  const scene::CornerColours* own_colours) {
    geometry::TriangleMesh plain{object.mesh->positions_m, object.mesh->triangles, {}, {}, {}};
    scene::CornerColours colours = own_colours != nullptr ? *own_colours : scene::CornerColours();
    if (object.both_sides) {
        for (const auto& [a, b, c] : object.mesh->triangles) plain.triangles.push_back({a, c, b});
        for (std::size_t i = 0, count = colours.size(); i < count; ++i)
            colours.push_back({colours[i][0], colours[i][2], colours[i][1]});
    }
    return picture::drawn_mesh(plain, colours);
}

Box bounds_of(const geometry::TriangleMesh& mesh) {
    Box bounds;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) bounds.include(mesh.positions_m[corner]);
    return bounds;
}

Pose pose_at_the_beginning(const scene::SceneObject& object) {
    const auto* path = std::get_if<scene::PathMotion>(&object.motion);
    return path == nullptr ? object.pose : scene::composed(object.pose, scene::pose_on(*path, 0.0));
}

}  // namespace

DrawnWorld::DrawnWorld(std::span<const scene::SceneObject> objects, bool is_shown) {
    std::map<std::tuple<const geometry::TriangleMesh*, const scene::CornerColours*, bool>,
             std::shared_ptr<const picture::DrawnMesh>>
        drawn;
    for (const scene::SceneObject& object : objects) {
        const auto drawn_with = [&](const scene::CornerColours* colours) {
            auto& mesh = drawn[{object.mesh.get(), colours, object.both_sides}];
            if (!mesh && is_shown) mesh = mesh_of(object, colours);
            return mesh;
        };
        // Both are made ready, so that no frame waits when an object in its file's colours is given another.
        const auto mesh = drawn_with(nullptr), coloured = drawn_with(object.corner_colours.get());
        const Pose pose = pose_at_the_beginning(object);
        const Similarity scene_from_mesh{pose.position_m, pose.orientation, object.scale};
        objects_[object.id] = {mesh,
                               coloured,
                               object.corner_colours != nullptr,
                               scene_from_mesh,
                               object.seen,
                               srgb_of(object.colour),
                               object.opacity};
        const Box bounds = picture::placed_box(mesh ? mesh->bounds : bounds_of(*object.mesh), scene_from_mesh);
        if (!object.seen || bounds.empty()) continue;
        bounds_scene_.include(bounds.lo);
        bounds_scene_.include(bounds.hi);
    }
}

void DrawnWorld::take(std::span<const scene::ObjectUpdate> updates) {
    for (const scene::ObjectUpdate& update : updates) {
        const auto at = objects_.find(update.id);
        if (at == objects_.end()) continue;
        at->second = {at->second.mesh, at->second.coloured,    update.has_own_colours, update.scene_from_mesh,
                      update.seen,     srgb_of(update.colour), update.opacity};
    }
}

std::vector<picture::DrawnObject> DrawnWorld::in_world(const Similarity& world_from_scene) const {
    std::vector<picture::DrawnObject> list;
    for (const auto& [id, object] : objects_) {
        if (!object.seen || !object.mesh) continue;
        const Similarity placed = world_from_scene * object.scene_from_mesh;
        if (object.has_own_colours)
            list.push_back({object.coloured, placed, Vec3(1.0), object.opacity});
        else
            list.push_back({object.mesh, placed, object.colour, object.opacity});
        list.back().casts_shadow = true;
    }
    return list;
}

}  // namespace burin::session

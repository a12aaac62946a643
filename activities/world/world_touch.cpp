// SPDX-License-Identifier: MIT
#include "activities/world/world_touch.hpp"

#include <algorithm>
#include <cmath>

namespace burin::activities {
namespace {

// Returns how far the farthest point is from the first.
double spread_of(const haptics::Probe& probe) {
    double farthest_m = 0.0;
    for (std::uint32_t i = 1; i < probe.count; ++i)
        farthest_m =
            std::max(farthest_m, glm::length(probe.points[i].offset_device_m - probe.points[0].offset_device_m));
    return farthest_m;
}

}  // namespace

// ---- WorldTouch

WorldTouch::WorldTouch(scene::MeshPart& part, const scene::MaterialTable& materials, const WorldSettings& settings,
                       const haptics::Probe& probe)
    : part_(part),
      settings_(settings),
      probe_(probe),
      spread_m_(spread_of(probe)),
      service_({&part}, {{&channels_, settings.start_scene_m, 0.0, settings.reach_m}}) {
    materials.write(materials_);
    publish(settings.scene_from_device);
}

void WorldTouch::publish(const Similarity& scene_from_device) {
    settings_.scene_from_device = scene_from_device;
    service_.use_probe(0, 2.0 * settings_.tool_radius_m + scene_from_device.scale * spread_m_);
    haptics::TickParameters parameters = parameters_of(settings_);
    parameters.probe = probe_;
    parameters.sequence = ++sequence_;
    parameters.materials = materials_;
    channels_.parameters.draft() = parameters;
    channels_.parameters.publish();
}

void WorldTouch::use_mapping(const Similarity& scene_from_device) { publish(scene_from_device); }

std::uint32_t WorldTouch::object_of(const haptics::TickRecord& tick, std::uint32_t point) {
    const std::uint32_t triangle = tick.contact.points[point].active_triangle;
    if (point >= tick.contact.point_count || triangle == haptics::kNoTriangle) return 0;
    const geometry::LocalSurface& surface = channels_.surface.newest();
    BURIN_CHECK(surface.sequence == tick.surface_sequence);
    if (surface.sequence != tick.surface_sequence) return 0;
    const std::uint32_t mesh = surface.mesh_of(triangle);
    if (mesh == geometry::LocalSurface::kNoMesh) return 0;
    if (surface.sequence != known_surface_ || mesh != known_mesh_) {
        known_surface_ = surface.sequence;
        known_mesh_ = mesh;
        known_object_ = static_cast<std::uint32_t>(part_.id_of(surface.meshes[mesh]));
    }
    return known_object_;
}

// ---- NearestObject

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

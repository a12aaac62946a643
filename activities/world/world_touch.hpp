// SPDX-License-Identifier: MIT
// The touching of a world by one hand, whatever moves it: channels with the tick's parameters, the scene's service, and
// which object each point of a tick touches. One thread. Frame: the scene's.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "activities/world/world_settings.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "haptics/channels.hpp"
#include "scene/mesh_part.hpp"
#include "scene/scene_service.hpp"

namespace burin::activities {

class WorldTouch {
public:
    // Part and materials must outlive it. Publishes the parameters of the settings, whose start is the first point's.
    WorldTouch(scene::MeshPart& part, const scene::MaterialTable& materials, const WorldSettings& settings,
               const haptics::Probe& probe);
    // With a ball of the settings' radius where the device is.
    WorldTouch(scene::MeshPart& part, const scene::MaterialTable& materials, const WorldSettings& settings)
        : WorldTouch(part, materials, settings, haptics::ball_probe(settings.tool_radius_m)) {}
    WorldTouch(const WorldTouch&) = delete;
    WorldTouch& operator=(const WorldTouch&) = delete;

    [[nodiscard]] haptics::HapticChannels& channels() { return channels_; }
    [[nodiscard]] scene::SceneService& service() { return service_; }
    // Maps the device into the scene in another way from the next tick on.
    void use_mapping(const Similarity& scene_from_device);
    // Returns the number of the object whose triangle bears a point of the tick, which must be the last one that used
    // the newest surface; 0: none. Cost: a look at each mesh of the surface, and when another mesh is touched than
    // before, one at each object.
    [[nodiscard]] std::uint32_t object_of(const haptics::TickRecord& tick, std::uint32_t point);

private:
    void publish(const Similarity& scene_from_device);

    const scene::MeshPart& part_;
    WorldSettings settings_;
    haptics::Probe probe_;
    double spread_m_ = 0.0;  // from the first point to the farthest, at the device
    std::array<haptics::TouchMaterial, haptics::kMostMaterials> materials_{};
    haptics::HapticChannels channels_;
    scene::SceneService service_;
    std::uint64_t sequence_ = 0;  // of the parameters
    std::uint64_t known_surface_ = 0;
    std::uint32_t known_mesh_ = geometry::LocalSurface::kNoMesh, known_object_ = 0;
};

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

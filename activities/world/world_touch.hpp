// SPDX-License-Identifier: MIT
// The touching of a world by one hand, whatever moves it: channels with the tick's parameters, and the scene's service.
// One thread. Frame: the scene's.
#pragma once

#include <array>
#include <cstdint>

#include "activities/world/exploration_settings.hpp"
#include "haptics/channels.hpp"
#include "scene/mesh_part.hpp"
#include "scene/scene_service.hpp"

namespace burin::activities {

class WorldTouch {
public:
    // Part and materials must outlive it. Publishes the parameters of the settings, whose start is the first point's.
    WorldTouch(scene::MeshPart& part, const scene::MaterialTable& materials, const ExplorationSettings& settings,
               const haptics::Probe& probe);
    // With a ball of the settings' radius where the device is.
    WorldTouch(scene::MeshPart& part, const scene::MaterialTable& materials, const ExplorationSettings& settings)
        : WorldTouch(part, materials, settings, haptics::ball_probe(settings.tool_radius_m)) {}
    WorldTouch(const WorldTouch&) = delete;
    WorldTouch& operator=(const WorldTouch&) = delete;

    [[nodiscard]] haptics::HapticChannels& channels() { return channels_; }
    [[nodiscard]] scene::SceneService& service() { return service_; }
    // Maps the device into the scene in another way from the next tick on.
    void use_mapping(const Similarity& scene_from_device);

private:
    void publish(const Similarity& scene_from_device);

    ExplorationSettings settings_;
    haptics::Probe probe_;
    double spread_m_ = 0.0;  // from the first point to the farthest, at the device
    std::array<haptics::TouchMaterial, haptics::kMostMaterials> materials_{};
    haptics::HapticChannels channels_;
    scene::SceneService service_;
    std::uint64_t sequence_ = 0;  // of the parameters
};

}  // namespace burin::activities

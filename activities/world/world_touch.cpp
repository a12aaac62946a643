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

WorldTouch::WorldTouch(scene::MeshPart& part, const scene::MaterialTable& materials,
                       const ExplorationSettings& settings, const haptics::Probe& probe)
    : settings_(settings),
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

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
// What was asked of a device and what it has rendered, for the reports of what was felt and of worlds.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "devices/haptic/wand_description.hpp"
#include "scene/mesh_part.hpp"
#include "scene/rendered_material.hpp"
#include "session/felt/rendered_tally.hpp"

namespace burin::app {

inline constexpr const char* kWallHead = "asked -> rendered -> felt, N/m";

// "1200 -> 858 -> 857, its maker's limit".
[[nodiscard]] std::string wall_text(const session::RenderedTally& wall);
// Adds "asked", "rendered", "limited_by", "felt_N_per_m" and "energy_took" to the JSON of a touch.
void add_wall(Json& touch, const session::RenderedTally& wall);

// The probe of a wand's points, without their radii.
[[nodiscard]] haptics::Probe probe_of(const devices::WandDescription& wand, std::span<const devices::WandPoint> points);

// Tells on standard error what the world asks for and the device does not render; nothing where it renders all.
void tell_what_is_not_rendered(const std::string& world, const std::vector<scene::SceneObject>& objects,
                               const devices::DeviceDescription& device, const haptics::Probe& probe);

// What the simulated stylus, and the simulated wand with one end and with both, render of a material.
struct RenderedOn {
    const char* device;
    scene::RenderedMaterial rendered;
};
[[nodiscard]] std::vector<RenderedOn> rendered_on_usual_devices(const scene::HapticMaterial& material);
// ", on a stylus 700 N/m, 0.44 N s/m (its maker's limit), on a wand ..."; empty where all is rendered as asked.
[[nodiscard]] std::string rendered_text(std::span<const RenderedOn> rendered);
[[nodiscard]] Json rendered_json(std::span<const RenderedOn> rendered);

}  // namespace burin::app

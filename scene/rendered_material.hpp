// SPDX-License-Identifier: MIT
// What of a material a hand's device renders: known before anything is touched, from the device and the probe, by the
// same law that the tick uses (haptics/stability/rendered_wall.hpp). What the energy account takes of a force depends
// on the motion, so it is told by the ticks alone (haptics::PassivityRecord::share). Pure; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "haptics/stability/coupled_wall.hpp"
#include "scene/haptic_material.hpp"

namespace burin::devices {
struct DeviceDescription;  // devices/haptic/haptic_device.hpp
}  // namespace burin::devices

namespace burin::haptics {
struct TickParameters;  // haptics/tick_parameters.hpp
}  // namespace burin::haptics

namespace burin::scene {

struct SceneObject;  // scene/scene_object.hpp

// Where so many points of the probe touch at once, the first ones. In the material's own units, as of a point that
// renders all of its surface.
struct RenderedMaterial {
    std::uint32_t points = 1;
    double stiffness_N_per_m = 0.0, damping_Ns_per_m = 0.0;
    haptics::StiffnessBound bound = haptics::StiffnessBound::none;  // why it is less than asked

    bool operator==(const RenderedMaterial&) const = default;
};

// points: 1 to the probe's count.
[[nodiscard]] RenderedMaterial rendered_material(const HapticMaterial& material,
                                                 const devices::DeviceDescription& device,
                                                 const haptics::TickParameters& parameters, std::uint32_t points);

// "700 N/m, 0.44 N s/m (its maker's limit)"; of what is rendered as asked "as asked".
[[nodiscard]] std::string text_of(const RenderedMaterial& rendered);

// Sums up which of the objects ask for more than the device renders where all points of the probe touch: "2 of 10
// objects ask for more than simulated PHANTOM Omni renders, such as stone: 1200 N/m, 0.5 N s/m become 700 N/m, 0.44 N
// s/m (its maker's limit)"; empty where none does. What is felt as every object unless its file says otherwise asks
// nothing.
[[nodiscard]] std::string more_than_rendered(std::span<const SceneObject> objects,
                                             const devices::DeviceDescription& device,
                                             const haptics::TickParameters& parameters);

}  // namespace burin::scene

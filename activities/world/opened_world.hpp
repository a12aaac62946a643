// SPDX-License-Identifier: MIT
// A world that is opened to be touched, as its file has it or with other materials. One thread; reads the file.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "record/record_reader.hpp"
#include "scene/mesh_part.hpp"
#include "scene/world_file.hpp"

namespace burin::activities {

// Values that all objects of a world get instead of their own.
struct MaterialOverride {
    std::optional<double> stiffness_N_per_m, damping_Ns_per_m, static_friction, dynamic_friction,
        coulomb_velocity_m_per_s;

    void apply(scene::HapticMaterial& material) const {
        material.stiffness_N_per_m = stiffness_N_per_m.value_or(material.stiffness_N_per_m);
        material.damping_Ns_per_m = damping_Ns_per_m.value_or(material.damping_Ns_per_m);
        material.static_friction = static_friction.value_or(material.static_friction);
        material.dynamic_friction = dynamic_friction.value_or(material.dynamic_friction);
        material.coulomb_velocity_m_per_s = coulomb_velocity_m_per_s.value_or(material.coulomb_velocity_m_per_s);
    }
    [[nodiscard]] bool is_any() const {
        return stiffness_N_per_m || damping_Ns_per_m || static_friction || dynamic_friction || coulomb_velocity_m_per_s;
    }
};

// A world that can be touched.
struct OpenedWorld {
    std::shared_ptr<const scene::World> scene;
    std::vector<record::RecordedObject> objects;
    std::string digest;
};
[[nodiscard]] Result<std::unique_ptr<OpenedWorld>> open_world(const std::string& path,
                                                              const MaterialOverride& materials);

// Returns what a recording of a stroke through a world says of both, after the facts of the program. Fails where one of
// the files cannot be read.
[[nodiscard]] Result<std::vector<std::pair<std::string, std::string>>> facts_of_stroke(
    const std::string& world_file, const OpenedWorld& world, const std::string& stroke_file,
    std::vector<std::pair<std::string, std::string>> facts);

}  // namespace burin::activities

// SPDX-License-Identifier: MIT
// Makes a world's objects of a VRML file (geometry/vrml/): shapes of one name are one object, in the world's frame.
//
// A material is what the numbers of a PROTO HapticMaterial say by name: stiffness (N/m), damping (N s/m),
// staticFriction, dynamicFriction, coulombVelocity (m/s); what is left out is HapticMaterial's own. Shapes without a
// name are called shape-1, shape-2... A surface that says solid FALSE, or that is open, is felt from both sides; a
// remark tells of the latter.
// Failure: all problems at once. Threads: any; nothing shared.
#pragma once

#include <filesystem>

#include "geometry/vrml/vrml_shapes.hpp"
#include "scene/world_file.hpp"
#include "scene/world_reading.hpp"

namespace burin::scene {

// `name` stands for the file in messages.
[[nodiscard]] WorldOrProblems world_of(const geometry::VrmlWorld& world, const std::string& name);

// Reads a world in TOML (.toml), in VRML 2.0 (.wrl) with the settings beside it (scene/world_settings.hpp), or a mesh
// as a world of one object (scene/mesh_world.hpp).
[[nodiscard]] WorldOrProblems read_any_world(const std::filesystem::path& path, const WorldReading& reading = {});

// Returns the metres in a number of a world in VRML: as it is to be read, else as the settings beside it say, else 1.
[[nodiscard]] Result<double> metres_in_vrml(const std::filesystem::path& path, const WorldReading& reading);
// Makes all of it larger by a factor, about the origin. A world that reaches far for metres is remarked on.
void scale_vrml(geometry::VrmlWorld& world, double factor);
[[nodiscard]] std::string unit_remark(const geometry::VrmlWorld& world, const std::string& name);

}  // namespace burin::scene

// SPDX-License-Identifier: MIT
// Reads an object's values from a TOML table: pose, scale, colour, opacity, seen, felt, material, path
// (docs/formats.md). A
// world in TOML and the settings beside a world in VRML have the same keys. What a table leaves out stays as the object
// has it. Threads: any; nothing shared.
#pragma once

#include <vector>

#include "base/toml_table.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

// The tables of one object: kept, since problems of values are told at the keys' lines.
class ObjectKeys {
public:
    // The table is of [[object]]; both must outlive the object.
    ObjectKeys(TableReading& reading, const toml::table& table);

    // Reads all values but name and mesh into the object.
    void read(SceneObject& object);
    // Lists what is wrong with the object's values, each at the line of its key; values without a key are left out.
    void tell_problems(const SceneObject& object);

    [[nodiscard]] TableReader& table() { return table_; }

private:
    void read_colour(SceneObject& object);
    void read_material(HapticMaterial& material);
    [[nodiscard]] PathMotion read_path(bool repeats, const Vec3& about_m);

    TableReading& reading_;
    TableReader table_;
    TableReader material_;
    std::vector<const toml::table*> path_;
};

// Sorts errors of one file, whose places end with a line.
[[nodiscard]] std::vector<Error> in_order_of_lines(std::vector<Error> errors);

}  // namespace burin::scene

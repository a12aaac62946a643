// SPDX-License-Identifier: MIT
#include "scene/world_inputs.hpp"

#include <set>
#include <string>

#include "base/file_io.hpp"
#include "base/toml_table.hpp"
#include "geometry/files/mesh_files.hpp"
#include "geometry/vrml/vrml_file.hpp"
#include "geometry/vrml/vrml_textures.hpp"
#include "scene/mesh_world.hpp"
#include "scene/world_file.hpp"
#include "scene/world_settings.hpp"

namespace burin::scene {
namespace {

namespace fs = std::filesystem;

// Returns the names behind `mesh` in a world's tables, each once.
std::set<std::string> meshes_named(const fs::path& world) {
    std::set<std::string> names;
    const Result<std::string> text = read_text_file(world, kMaxWorldBytes);
    if (!text) return names;
    const Result<toml::table> root = parse_toml(*text, world.string());
    if (!root) return names;
    const toml::node* const objects = root->get("object");
    if (objects == nullptr || !objects->is_array()) return names;
    for (const toml::node& object : *objects->as_array()) {
        const toml::table* const table = object.as_table();
        const toml::node* const mesh = table != nullptr ? table->get("mesh") : nullptr;
        if (mesh != nullptr && mesh->is_string()) names.insert(*mesh->value<std::string>());
    }
    return names;
}

}  // namespace

std::vector<fs::path> files_of_world(const fs::path& path) {
    if (is_mesh_file(path)) return geometry::files_of_mesh(path);
    std::vector<fs::path> files{path};
    if (path.extension() == ".toml") {
        for (const std::string& name : meshes_named(path))
            for (fs::path& file : geometry::files_of_mesh(path.parent_path() / name)) files.push_back(std::move(file));
        return files;
    }
    files.push_back(settings_of(path));
    if (const Result<geometry::VrmlFile> vrml = geometry::read_vrml_file(path)) {
        for (const geometry::VrmlSource& source : vrml->sources) files.emplace_back(source.name);
        for (const std::string& name : geometry::vrml_picture_names(*vrml)) files.push_back(vrml->root / name);
    }
    return files;
}

}  // namespace burin::scene

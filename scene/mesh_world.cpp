// SPDX-License-Identifier: MIT
#include "scene/mesh_world.hpp"

#include <string>
#include <utility>

#include "base/json.hpp"

namespace burin::scene {
namespace {

// Reads the mesh through a world that names it, so that the same rules hold.
WorldOrProblems read_as_world(const std::filesystem::path& path, const std::string& unit, bool both_sides) {
    const auto quoted = [](const std::string& text) {
        return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    const std::string name = path.stem().empty() ? "mesh" : path.stem().string();
    const std::string text = "[[object]]\nname = " + quoted(name) + "\nmesh = " + quoted(path.filename().string()) +
                             (unit.empty() ? "" : "\nmesh_units = " + quoted(unit)) +
                             "\nboth_sides = " + (both_sides ? "true" : "false") + "\n";
    WorldOrProblems world = parse_world(text, path.string(), meshes_beside(path));
    if (world || world.error().empty()) return world;
    // The text has lines of its own, which nobody sees.
    Error first = world.error().front();
    first.where = path.string();
    return std::unexpected(std::vector{std::move(first)});
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) { return geometry::mesh_format_of(path).has_value(); }

WorldOrProblems read_mesh_world(const std::filesystem::path& path, const std::string& unit) {
    if (WorldOrProblems world = read_as_world(path, unit, false)) return world;
    WorldOrProblems world = read_as_world(path, unit, true);
    if (world) world->remarks.push_back(path.string() + ": is no closed surface; it is felt from both sides");
    return world;
}

}  // namespace burin::scene

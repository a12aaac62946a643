// SPDX-License-Identifier: MIT
#include "scene/world_settings.hpp"

#include <algorithm>
#include <map>

#include "base/text.hpp"
#include "base/try.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "scene/object_keys.hpp"
#include "scene/value_text.hpp"
#include "scene/world_reading.hpp"

namespace burin::scene {
namespace {

// Returns the names of all objects; at most so many that a message stays readable.
std::string some_names(const World& world) {
    constexpr std::size_t kMost = 12;
    std::string text;
    for (std::size_t i = 0; i < std::min(world.objects.size(), kMost); ++i)
        text += (i > 0 ? ", " : "") + world.objects[i].name;
    return world.objects.size() > kMost ? text + ", ..." : text;
}

SceneObject* object_named(World& world, TableReader& t, const std::string& name) {
    const auto found = std::ranges::find(world.objects, name, &SceneObject::name);
    if (found != world.objects.end()) return &*found;
    if (world.objects.empty()) return nullptr;
    std::vector<std::string_view> names;
    for (const SceneObject& object : world.objects) names.push_back(object.name);
    t.refuse("name", "is " + name + ", which the world does not have",
             "did you mean " + std::string(nearest_name(name, names)) + "? It has: " + some_names(world));
    return nullptr;
}

bool is_open(const SceneObject& object) { return object.mesh != nullptr && !geometry::examine(*object.mesh).closed; }

}  // namespace

std::filesystem::path settings_of(const std::filesystem::path& world) {
    std::filesystem::path plain = world;
    if (plain.extension() == ".gz") plain.replace_extension();  // world.wrl.gz is world.wrl, packed
    return plain.replace_extension(".toml");
}

bool has_settings(const std::filesystem::path& world) {
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::symlink_status(settings_of(world), ignored));
}

Result<double> unit_in_settings(std::string_view text, const std::string& name) {
    BURIN_TRY(root, parse_toml(text, name));
    const auto unit = root["world"]["unit"].value<std::string>();
    return unit ? parse_world_unit(*unit, name + ": [world] unit") : 1.0;
}

std::vector<Error> apply_settings(World& world, std::string_view text, const std::string& name) {
    const Result<toml::table> root = parse_toml(text, name);
    if (!root) return {root.error()};
    TableReading reading{name};
    TableReader file(reading, &*root, "the file");
    if (const auto title = file.text("name")) world.name = *title;
    if (has_control_characters(world.name)) file.refuse("name", "holds control characters", "write it on one line");
    TableReader whole(reading, file.table("world"), "[world]");
    static_cast<void>(whole.text("unit"));  // the world has been read in it: unit_in_settings()
    whole.refuse_unknown();
    std::map<std::string, std::uint32_t> lines;  // of the names so far
    for (const toml::table* table : file.tables("object")) {
        ObjectKeys keys(reading, *table);
        TableReader& t = keys.table();
        t.require("name", "name an object of the world; burin world check lists them");
        const std::string object_name = t.text("name").value_or("");
        SceneObject unknown;
        SceneObject* known = t.has("name") ? object_named(world, t, object_name) : nullptr;
        // The keys of an object that is not there are checked as well.
        SceneObject& object = known != nullptr ? *known : unknown;
        keys.read(object);
        for (const char* const key : {"mesh", "mesh_units"})
            if (t.text(key)) t.refuse(key, "has no place here, since the shape is the world's", "leave it out");
        t.refuse_unknown();
        if (known == nullptr) continue;
        keys.tell_problems(object);
        if (object.felt && !object.both_sides && t.has("both_sides") && is_open(object))
            world.remarks.push_back(
                formatted("%s:%u: %s is open, and with both_sides = false it is not felt from behind", name.c_str(),
                          static_cast<unsigned>(t.find("both_sides")->source().begin.line), object_name.c_str()));
        const auto line = static_cast<std::uint32_t>(t.find("name")->source().begin.line);
        const auto [at, is_new] = lines.try_emplace(object_name, line);
        if (!is_new)
            t.refuse("name",
                     "is " + object_name + formatted(" again, after line %u", static_cast<unsigned>(at->second)),
                     "write all of an object into one table");
    }
    file.refuse_unknown();
    return in_order_of_lines(std::move(reading.errors));
}

}  // namespace burin::scene

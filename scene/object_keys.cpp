// SPDX-License-Identifier: MIT
#include "scene/object_keys.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace burin::scene {
namespace {

std::optional<Colour> colour_in(const std::string& text) {
    if (text.size() != 7 || text.front() != '#') return std::nullopt;
    Colour colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        const char *const from = text.data() + 1 + 2 * i, *const end = from + 2;
        const auto [stopped, failed] = std::from_chars(from, end, colour[i], 16);
        if (failed != std::errc() || stopped != end) return std::nullopt;
    }
    return colour;
}

}  // namespace

ObjectKeys::ObjectKeys(TableReading& reading, const toml::table& table)
    : reading_(reading),
      table_(reading, &table, "[[object]]"),
      material_(reading, table_.table("material"), "[object.material]") {}

void ObjectKeys::read(SceneObject& object) {
    const Vec3 displaced_m = table_.vector("position").value_or(displacement_m(object));
    object.pivot_m = table_.vector("pivot").value_or(object.pivot_m);
    const Quat orientation = table_.quaternion("orientation").value_or(object.pose.orientation);
    object.scale = table_.number("scale").value_or(object.scale);
    object.pose = turned_about_pivot(object, displaced_m, orientation, object.scale);
    object.seen = table_.flag("seen").value_or(object.seen);
    object.felt = table_.flag("felt").value_or(object.felt);
    object.both_sides = table_.flag("both_sides").value_or(object.both_sides);
    object.opacity = table_.number("opacity").value_or(object.opacity);
    read_colour(object);
    read_material(object.material);
    path_ = table_.tables("path");
    const std::optional<bool> repeats = table_.flag("repeat");
    if (!path_.empty()) object.motion = read_path(repeats.value_or(true), object.scale * object.pivot_m);
    if (repeats && !table_.has("path")) table_.refuse("repeat", "stands where there is no path", "leave it out");
}

void ObjectKeys::read_colour(SceneObject& object) {
    const auto text = table_.text("colour");
    if (!text) return;
    if (const auto colour = colour_in(*text))
        object.colour = *colour;
    else
        table_.refuse("colour", "is " + *text, "write red, green and blue as \"#c08040\", say");
}

void ObjectKeys::read_material(HapticMaterial& material) {
    TableReader& m = material_;
    material.stiffness_N_per_m = m.number("stiffness").value_or(material.stiffness_N_per_m);
    material.damping_Ns_per_m = m.number("damping").value_or(material.damping_Ns_per_m);
    const auto at_rest = m.number("static_friction"), sliding = m.number("dynamic_friction");
    // One alone stands for both.
    material.static_friction = at_rest.value_or(sliding.value_or(material.static_friction));
    material.dynamic_friction = sliding.value_or(at_rest.value_or(material.dynamic_friction));
    material.coulomb_velocity_m_per_s = m.number("coulomb_velocity").value_or(material.coulomb_velocity_m_per_s);
    m.refuse_unknown();
}

PathMotion ObjectKeys::read_path(bool repeats, const Vec3& about_m) {
    PathMotion path;
    path.repeats = repeats;
    path.about_m = about_m;
    for (const toml::table* table : path_) {
        TableReader t(reading_, table, "[[object.path]]");
        t.require("time", "give the time in seconds at which it is there; the first at 0");
        const Vec3 position_m = t.vector("position").value_or(Vec3(0.0));
        const Quat turn = t.quaternion("orientation").value_or(Quat(1.0, 0.0, 0.0, 0.0));
        path.keys.push_back({t.number("time").value_or(0.0), {position_m, turn}});
        t.refuse_unknown();
    }
    return path;
}

void ObjectKeys::tell_problems(const SceneObject& object) {
    for (const Problem& problem : problems(object)) {
        const std::string& key = problem.key;
        if (table_.has(key.c_str())) {
            table_.refuse(key.c_str(), problem.what, problem.remedy);
        } else if (material_.has(key.c_str())) {
            material_.refuse(key.c_str(), problem.what, problem.remedy);
        } else if (std::size_t i = 0; key.starts_with("path[")) {
            std::from_chars(key.data() + 5, key.data() + key.size(), i);
            if (i < path_.size()) reading_.refuse(*path_[i], key + " " + problem.what, problem.remedy);
        }
    }
}

std::vector<Error> in_order_of_lines(std::vector<Error> errors) {
    std::ranges::stable_sort(errors, {}, [](const Error& error) {
        const char* const end = error.where.data() + error.where.size();
        unsigned line = 0;
        std::from_chars(error.where.data() + error.where.rfind(':') + 1, end, line);
        return line;
    });
    return errors;
}

}  // namespace burin::scene

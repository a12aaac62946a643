// SPDX-License-Identifier: MIT
#include "app/world/world_check.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/world/rendered_report.hpp"
#include "base/text.hpp"
#include "document/document_file.hpp"
#include "geometry/files/mesh_unit.hpp"
#include "geometry/vrml/vrml_shapes.hpp"
#include "scene/mesh_part.hpp"
#include "scene/mesh_world.hpp"
#include "scene/vrml_world.hpp"
#include "scene/world_file.hpp"
#include "scene/world_settings.hpp"
#include "session/live/world_side.hpp"

namespace burin::app {
namespace {

// The shapes of one name.
struct WorldObject {
    std::string name;
    std::size_t shapes = 0, triangles = 0;
    Box bounds_m;
    geometry::VrmlColour colour{};
    bool has_own_colours = false;  // several
    double transparency = 0.0;
    bool two_sided = false;
    std::map<std::string, double> haptics;
};

void include_shape(Box& bounds_m, const geometry::VrmlShape& shape) {
    const geometry::TriangleMesh& mesh = shape.surface->mesh;
    for (const auto& t : mesh.triangles) {
        for (const std::uint32_t v : t)
            bounds_m.include(Vec3(shape.world_from_shape * glm::dvec4(mesh.positions_m[v], 1.0)));
    }
}

// Returns the named objects in the order of their first shapes; colour and material are those of these shapes.
std::vector<WorldObject> objects_of(const geometry::VrmlWorld& world) {
    std::vector<WorldObject> objects;
    std::map<std::string, std::size_t> known;
    for (const geometry::VrmlShape& shape : world.shapes) {
        if (shape.name.empty()) continue;
        const auto [entry, is_new] = known.try_emplace(shape.name, objects.size());
        if (is_new) {
            objects.push_back({.name = shape.name, .bounds_m = {}, .colour = shape.colour, .haptics = shape.haptics});
            objects.back().transparency = shape.transparency;
            objects.back().two_sided = shape.surface->two_sided;
        }
        WorldObject& object = objects[entry->second];
        ++object.shapes;
        object.triangles += shape.surface->mesh.triangles.size();
        include_shape(object.bounds_m, shape);
    }
    return objects;
}

std::string hexadecimal(const geometry::VrmlColour& colour) {
    return formatted("#%02x%02x%02x", colour[0], colour[1], colour[2]);
}

std::string size_text(const Box& bounds_m) {
    return bounds_m.empty() ? "nothing to touch" : in_millimetres(bounds_m.extent());
}

Json error_json(const Error& error) { return {{"where", error.where}, {"what", error.what}, {"remedy", error.remedy}}; }

Json vector_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

// Describes the contents of one file, for the terminal and for --json.
class WorldSummary {
public:
    // felt: the same world as objects.
    WorldSummary(std::string path, const geometry::VrmlFile& file, const geometry::VrmlWorld& world,
                 const scene::World& felt)
        : path_(std::move(path)), file_(file), world_(world), felt_(felt), objects_(objects_of(world)) {
        for (WorldObject& o : objects_) {
            const auto object = std::ranges::find(felt.objects, o.name, &scene::SceneObject::name);
            if (object == felt.objects.end()) continue;
            o.colour = object->colour;
            o.has_own_colours = object->corner_colours != nullptr;
        }
        for (const geometry::VrmlShape& shape : world.shapes) include_shape(bounds_m_, shape);
        unnamed_ = static_cast<std::size_t>(
            std::ranges::count_if(world.shapes, [](const geometry::VrmlShape& s) { return s.name.empty(); }));
    }

    void print() const {
        std::printf("%s: %zu %s, %zu triangles, %s\n", path_.c_str(), world_.shapes.size(),
                    world_.shapes.size() == 1 ? "shape" : "shapes", world_.triangles, size_text(bounds_m_).c_str());
        std::size_t width = 0;
        for (const WorldObject& o : objects_) width = std::max(width, o.name.size());
        for (const WorldObject& o : objects_) {
            std::printf("  %-*s  %zu triangles, %s, %s", static_cast<int>(std::min<std::size_t>(width, 40)),
                        o.name.c_str(), o.triangles, size_text(o.bounds_m).c_str(),
                        o.has_own_colours ? "colours of its own" : hexadecimal(o.colour).c_str());
            if (o.transparency > 0.0) std::printf(", transparency %g", o.transparency);
            if (o.two_sided) std::printf(", two-sided");
            for (const auto& [name, value] : o.haptics) std::printf(", %s %g", name.c_str(), value);
            std::printf("\n");
        }
        if (unnamed_ > 0) {
            std::printf(
                "  %zu %s without a name; commands and settings know them as %s, in the order of the file. DEF "
                "Name before a Shape gives it one that stays\n",
                unnamed_, unnamed_ == 1 ? "shape" : "shapes", unnamed_names().c_str());
        }
        for (const geometry::VrmlSkipped& skipped : world_.skipped) {
            std::printf("  skipped: %zu %s, the first at %s\n", skipped.count, skipped.type.c_str(),
                        file_.where(skipped.first_place).c_str());
        }
        for (const Error& remark : world_.remarks) std::printf("  %s\n", remark.line().c_str());
        for (const std::string& remark : felt_.remarks) std::printf("  %s\n", remark.c_str());
    }

    // "shape-1 to shape-3": what they are called as objects.
    [[nodiscard]] std::string unnamed_names() const {
        const auto is_new = [&](const scene::SceneObject& object) {
            return std::ranges::find(objects_, object.name, &WorldObject::name) == objects_.end();
        };
        const auto first = std::ranges::find_if(felt_.objects, is_new);
        if (first == felt_.objects.end()) return "nothing: they have no triangles";
        const auto last = std::find_if(felt_.objects.rbegin(), felt_.objects.rend(), is_new);
        return first->name == last->name ? first->name : first->name + " to " + last->name;
    }

    [[nodiscard]] Json json() const {
        Json json{{"file", path_}, {"faults", Json::array()}};
        json["shapes"] = world_.shapes.size();
        json["unnamed_shapes"] = unnamed_;
        json["triangles"] = world_.triangles;
        json["nodes"] = world_.nodes;
        json["objects"] = Json::array();
        for (const WorldObject& o : objects_) json["objects"].push_back(object_json(o));
        json["skipped"] = Json::array();
        for (const geometry::VrmlSkipped& s : world_.skipped)
            json["skipped"].push_back({{"type", s.type}, {"count", s.count}, {"where", file_.where(s.first_place)}});
        json["remarks"] = Json::array();
        for (const Error& remark : world_.remarks) json["remarks"].push_back(error_json(remark));
        for (const std::string& remark : felt_.remarks)
            json["remarks"].push_back(error_json({.what = remark, .where = "", .remedy = ""}));
        return json;
    }

private:
    static Json object_json(const WorldObject& o) {
        Json json{{"name", o.name}, {"shapes", o.shapes}, {"triangles", o.triangles}};
        json["lowest_m"] = vector_json(o.bounds_m.lo);
        json["highest_m"] = vector_json(o.bounds_m.hi);
        json["colour"] = hexadecimal(o.colour);
        json["own_colours"] = o.has_own_colours;
        json["transparency"] = o.transparency;
        json["two_sided"] = o.two_sided;
        json["haptics"] = o.haptics;
        return json;
    }

    std::string path_;
    const geometry::VrmlFile& file_;
    const geometry::VrmlWorld& world_;
    const scene::World& felt_;
    std::vector<WorldObject> objects_;
    Box bounds_m_;
    std::size_t unnamed_ = 0;
};

CheckedWorld faulty(const std::string& path, std::span<const Error> faults, bool print) {
    CheckedWorld checked{{{"file", path}, {"faults", Json::array()}}, faults.size()};
    for (const Error& fault : faults) {
        if (print) std::printf("%s\n", fault.line().c_str());
        checked.json["faults"].push_back(error_json(fault));
    }
    return checked;
}

// ---- Worlds in TOML

std::string look_text(const scene::SceneObject& object) {
    if (!object.seen) return "not seen";
    return (object.corner_colours ? "colours of its own" : hexadecimal(object.colour)) +
           (object.opacity < 1.0 ? formatted(", opacity %.9g", object.opacity) : "");
}

// Returns the box around an object where its own pose has it.
Box bounds_of(const scene::SceneObject& object) {
    Box bounds_m;
    for (const auto& triangle : object.mesh->triangles)
        for (const std::uint32_t v : triangle)
            bounds_m.include(object.pose * (object.scale * object.mesh->positions_m[v]));
    return bounds_m;
}

std::string feel_text(const scene::SceneObject& object) {
    if (!object.felt) return "not felt";
    const scene::HapticMaterial& m = object.material;
    std::string text = formatted("%g N/m, %g N s/m", m.stiffness_N_per_m, m.damping_Ns_per_m);
    if (m.static_friction > 0.0) text += formatted(", friction %g and %g", m.static_friction, m.dynamic_friction);
    if (m.coulomb_velocity_m_per_s > 0.0)
        text += formatted(", growing up to %g mm/s", 1000.0 * m.coulomb_velocity_m_per_s);
    if (object.both_sides) text += ", from both sides";
    return text + rendered_text(rendered_on_usual_devices(m));
}

void print_world(const std::string& path, const scene::World& world) {
    std::size_t width = 0, triangles = 0;
    for (const scene::SceneObject& o : world.objects) {
        width = std::max(width, o.name.size());
        triangles += o.mesh->triangles.size();
    }
    std::printf("%s: %zu %s, %zu triangles%s%s\n", path.c_str(), world.objects.size(),
                world.objects.size() == 1 ? "object" : "objects", triangles, world.name.empty() ? "" : ", ",
                world.name.c_str());
    for (const scene::SceneObject& o : world.objects) {
        const auto* path_of = std::get_if<scene::PathMotion>(&o.motion);
        std::printf("  %-*s  %zu triangles, %s, %s, %s", static_cast<int>(std::min<std::size_t>(width, 40)),
                    o.name.c_str(), o.mesh->triangles.size(), in_millimetres(bounds_of(o).extent()).c_str(),
                    look_text(o).c_str(), feel_text(o).c_str());
        if (path_of != nullptr) std::printf(", moves for %g s", path_of->keys.back().time_s);
        std::printf("\n");
    }
    for (const std::string& remark : world.remarks) std::printf("  %s\n", remark.c_str());
}

Json object_json(const scene::SceneObject& o) {
    const Box bounds_m = bounds_of(o);
    Json json{{"name", o.name}, {"triangles", o.mesh->triangles.size()}};
    json["lowest_m"] = vector_json(bounds_m.lo);
    json["highest_m"] = vector_json(bounds_m.hi);
    json["colour"] = hexadecimal(o.colour);
    json["own_colours"] = o.corner_colours != nullptr;
    json["opacity"] = o.opacity;
    json["seen"] = o.seen;
    json["felt"] = o.felt;
    json["both_sides"] = o.both_sides;
    json["stiffness_N_per_m"] = o.material.stiffness_N_per_m;
    json["damping_Ns_per_m"] = o.material.damping_Ns_per_m;
    json["static_friction"] = o.material.static_friction;
    json["dynamic_friction"] = o.material.dynamic_friction;
    json["coulomb_velocity_m_per_s"] = o.material.coulomb_velocity_m_per_s;
    json["rendered"] = rendered_json(rendered_on_usual_devices(o.material));
    const auto* path = std::get_if<scene::PathMotion>(&o.motion);
    json["path_s"] = path != nullptr ? Json(path->keys.back().time_s) : Json();
    return json;
}

// Prints what the settings beside a world in VRML have made of its objects.
void print_settings(const std::string& path, const scene::World& world) {
    std::printf("  with %s:\n", scene::settings_of(path).string().c_str());
    for (const scene::SceneObject& o : world.objects)
        std::printf("  %s: %s, %s\n", o.name.c_str(), look_text(o).c_str(), feel_text(o).c_str());
}

// Returns why a session could not touch the world's objects.
std::optional<Error> why_not_touched(const scene::World& world) {
    scene::MaterialTable materials;
    const auto part = scene::MeshPart::create(world.objects, materials);
    return part ? std::nullopt : std::optional(part.error());
}

scene::WorldOrProblems saved_world(const std::string& path) {
    Result<scene::World> world = session::read_sound_world(path);
    if (!world) return std::unexpected(std::vector{world.error()});
    return std::move(*world);
}

// Checks a world in TOML, a mesh that is a world alone, or that of a document.
CheckedWorld check_toml_world(const std::string& path, const scene::WorldReading& reading, bool print) {
    const scene::WorldOrProblems world =
        document::is_document_name(path) ? saved_world(path) : scene::read_any_world(path, reading);
    if (!world) return faulty(path, world.error(), print);
    if (const auto why = why_not_touched(*world)) return faulty(path, std::array{*why}, print);
    if (print) print_world(path, *world);
    Json json{{"file", path}, {"faults", Json::array()}};
    json["name"] = world->name;
    json["objects"] = Json::array();
    for (const scene::SceneObject& object : world->objects) json["objects"].push_back(object_json(object));
    json["remarks"] = world->remarks;
    return {std::move(json), 0};
}

}  // namespace

CheckedWorld check_world(const std::string& path, const scene::WorldReading& reading, bool print) {
    if (std::filesystem::path(path).extension() == ".toml" || scene::is_mesh_file(path) ||
        document::is_document_name(path))
        return check_toml_world(path, reading, print);
    const Result<double> unit_m = scene::metres_in_vrml(path, reading);
    if (!unit_m) return faulty(path, std::array{unit_m.error()}, print);
    const Result<geometry::VrmlFile> file = geometry::read_vrml_file(path, reading.root);
    if (!file) return faulty(path, std::array{file.error()}, print);
    geometry::VrmlWorldOrFaults world = geometry::shapes_of(*file);
    if (!world) return faulty(path, world.error(), print);
    scene::scale_vrml(*world, *unit_m);
    scene::WorldOrProblems felt = scene::world_of(*world, path);
    if (!felt) return faulty(path, felt.error(), print);
    if (const auto why = why_not_touched(*felt)) return faulty(path, std::array{*why}, print);
    if (const std::string remark = scene::unit_remark(*world, path); !remark.empty()) felt->remarks.push_back(remark);
    const WorldSummary summary(path, *file, *world, *felt);
    if (print) summary.print();
    CheckedWorld checked{summary.json(), 0};
    if (!scene::has_settings(path)) return checked;
    const scene::WorldOrProblems with_settings = scene::read_any_world(path, reading);
    if (!with_settings) return faulty(path, with_settings.error(), print);
    if (const auto why = why_not_touched(*with_settings)) return faulty(path, std::array{*why}, print);
    if (print) print_settings(path, *with_settings);
    checked.json["settings"] = scene::settings_of(path).string();
    checked.json["felt_objects"] = Json::array();
    for (const scene::SceneObject& object : with_settings->objects)
        checked.json["felt_objects"].push_back(object_json(object));
    return checked;
}

}  // namespace burin::app

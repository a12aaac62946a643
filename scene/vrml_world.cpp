// SPDX-License-Identifier: MIT
#include "scene/vrml_world.hpp"

#include <array>
#include <map>
#include <utility>

#include "base/file_io.hpp"
#include "base/text.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/vertex_weld.hpp"
#include "scene/mesh_world.hpp"
#include "scene/world_settings.hpp"

namespace burin::scene {
namespace {

HapticMaterial material_of(const geometry::VrmlShape& shape) {
    HapticMaterial material;
    const std::array fields{std::pair("stiffness", &HapticMaterial::stiffness_N_per_m),
                            std::pair("damping", &HapticMaterial::damping_Ns_per_m),
                            std::pair("staticFriction", &HapticMaterial::static_friction),
                            std::pair("dynamicFriction", &HapticMaterial::dynamic_friction)};
    for (const auto& [field, member] : fields)
        if (const auto given = shape.haptics.find(field); given != shape.haptics.end())
            material.*member = given->second;
    return material;
}

// Adds a shape's triangles to a mesh, welding equal positions.
void add_shape(geometry::TriangleMesh& mesh, geometry::VertexWeld& weld, const geometry::VrmlShape& shape) {
    const geometry::TriangleMesh part = geometry::mesh_in_world(shape);
    for (const auto& [a, b, c] : part.triangles)
        mesh.triangles.push_back({weld.index_of(part.positions_m[a]), weld.index_of(part.positions_m[b]),
                                  weld.index_of(part.positions_m[c])});
}

struct Gathered {
    std::string name;
    std::vector<const geometry::VrmlShape*> shapes;
};

// Returns the shapes by name, in the order of the first of each name.
std::vector<Gathered> by_name(const geometry::VrmlWorld& world) {
    std::vector<Gathered> objects;
    std::map<std::string, std::size_t> known;
    std::size_t unnamed = 0;
    for (const geometry::VrmlShape& shape : world.shapes) {
        if (shape.surface->mesh.triangles.empty()) continue;
        std::string name = shape.name;
        // No DEF has a dash and a number behind "shape", unless a file means to confuse.
        while (name.empty() || (shape.name.empty() && known.contains(name)))
            name = "shape-" + std::to_string(++unnamed);
        const auto [at, is_new] = known.try_emplace(name, objects.size());
        if (is_new) objects.push_back({name, {}});
        objects[at->second].shapes.push_back(&shape);
    }
    return objects;
}

}  // namespace

WorldOrProblems world_of(const geometry::VrmlWorld& vrml, const std::string& name) {
    World world;
    world.name = name;
    std::vector<Error> found;
    for (const Gathered& gathered : by_name(vrml)) {
        const geometry::VrmlShape& first = *gathered.shapes.front();
        SceneObject object;
        object.id = world.objects.size() + 1;
        object.name = gathered.name;
        object.colour = first.colour;
        object.seen = first.transparency < 1.0;
        object.opacity = object.seen ? 1.0 - first.transparency : 1.0;
        object.material = material_of(first);
        auto mesh = std::make_shared<geometry::TriangleMesh>();
        geometry::VertexWeld weld(mesh->positions_m);
        for (const geometry::VrmlShape* shape : gathered.shapes) {
            add_shape(*mesh, weld, *shape);
            object.both_sides = object.both_sides || shape->surface->two_sided;
        }
        const geometry::MeshHealth health = geometry::examine(*mesh);
        if (!object.both_sides && (!health.closed || !health.consistently_oriented || health.inside_out())) {
            object.both_sides = true;
            world.remarks.push_back(name + ": " + object.name +
                                    " is no closed surface that faces outwards, and is felt from both sides");
        }
        object.mesh = std::move(mesh);
        for (const Problem& problem : problems(object))
            found.push_back({.what = problem.what,
                             .where = name + ": " + object.name + ": " + problem.key,
                             .remedy = problem.remedy});
        world.objects.push_back(std::move(object));
    }
    if (world.objects.empty())
        found.push_back({.what = "holds nothing to touch or see", .where = name, .remedy = "give it a shape"});
    if (world.objects.size() > kMaxWorldObjects)
        found.push_back({.what = formatted("has %zu objects, more than %zu", world.objects.size(), kMaxWorldObjects),
                         .where = name,
                         .remedy = "give what belongs together one name (DEF)"});
    if (!found.empty()) return std::unexpected(std::move(found));
    return world;
}

WorldOrProblems read_any_world(const std::filesystem::path& path) {
    if (path.extension() == ".toml") return read_world(path);
    if (is_mesh_file(path)) return read_mesh_world(path);
    const Result<geometry::VrmlFile> file = geometry::read_vrml_file(path);
    if (!file) return std::unexpected(std::vector{file.error()});
    const geometry::VrmlWorldOrFaults shapes = geometry::shapes_of(*file);
    if (!shapes) return std::unexpected(shapes.error());
    WorldOrProblems world = world_of(*shapes, path.string());
    if (!world) return world;
    if (!has_settings(path)) return world;
    const std::filesystem::path settings = settings_of(path);
    const Result<std::string> text = read_text_file(settings, kMaxWorldBytes);
    if (!text) return std::unexpected(std::vector{text.error()});
    if (std::vector<Error> problems = apply_settings(*world, *text, settings.string()); !problems.empty())
        return std::unexpected(std::move(problems));
    return world;
}

}  // namespace burin::scene

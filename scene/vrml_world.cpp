// SPDX-License-Identifier: MIT
#include "scene/vrml_world.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/vertex_weld.hpp"
#include "scene/mesh_world.hpp"
#include "scene/world_settings.hpp"

namespace burin::scene {
namespace {

// A world that is longer is no room before a wall; half of what a wand or a mesh has is above a hundredth of that.
constexpr double kLongestInReach_m = 4.0;

HapticMaterial material_of(const geometry::VrmlShape& shape) {
    HapticMaterial material;
    const std::array fields{std::pair("stiffness", &HapticMaterial::stiffness_N_per_m),
                            std::pair("damping", &HapticMaterial::damping_Ns_per_m),
                            std::pair("staticFriction", &HapticMaterial::static_friction),
                            std::pair("dynamicFriction", &HapticMaterial::dynamic_friction),
                            std::pair("coulombVelocity", &HapticMaterial::coulomb_velocity_m_per_s)};
    for (const auto& [field, member] : fields)
        if (const auto given = shape.haptics.find(field); given != shape.haptics.end())
            material.*member = given->second;
    return material;
}

// Adds a shape's triangles to a mesh, welding equal positions, and the colours of their corners.
void add_shape(geometry::TriangleMesh& mesh, geometry::VertexWeld& weld, CornerColours& colours,
               const geometry::VrmlShape& shape) {
    const geometry::TriangleMesh part = geometry::mesh_in_world(shape);
    const auto& own = shape.surface->corner_colours;
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
        const auto& [a, b, c] = part.triangles[i];
        mesh.triangles.push_back({weld.index_of(part.positions_m[a]), weld.index_of(part.positions_m[b]),
                                  weld.index_of(part.positions_m[c])});
        colours.push_back(own.empty() ? std::array{shape.colour, shape.colour, shape.colour} : own[i]);
        if (shape.mirrored()) std::swap(colours.back()[1], colours.back()[2]);
    }
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

// A session tells the first of what was left out or may be meant otherwise; burin world check tells all.
void tell_remarks(World& world, const std::vector<Error>& remarks, const std::string& path) {
    constexpr std::size_t kTold = 5;
    for (std::size_t i = 0; i < std::min(kTold, remarks.size()); ++i) world.remarks.push_back(remarks[i].line());
    if (remarks.size() > kTold)
        world.remarks.push_back(formatted("%s: %zu more remarks; burin world check %s tells all", path.c_str(),
                                          remarks.size() - kTold, path.c_str()));
}

// A file of settings is no world: names the world that it is of.
WorldOrProblems read_world_or_name_its_world(const std::filesystem::path& path) {
    WorldOrProblems world = read_world(path);
    if (world) return world;
    for (const char* const ending : {".wrl", ".wrl.gz", ".wrz"}) {
        std::filesystem::path beside = path;
        beside.replace_extension(ending);
        std::error_code ignored;
        if (!std::filesystem::exists(beside, ignored)) continue;
        std::vector<Error> problems = std::move(world.error());
        problems.insert(problems.begin(), Error{"has the name of the settings of " + beside.string(), path.string(),
                                                "name " + beside.string() + ": its settings are read with it"});
        return std::unexpected(std::move(problems));
    }
    return world;
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
        CornerColours colours;
        geometry::VertexWeld weld(mesh->positions_m);
        for (const geometry::VrmlShape* shape : gathered.shapes) {
            add_shape(*mesh, weld, colours, *shape);
            object.both_sides = object.both_sides || shape->surface->two_sided;
        }
        const geometry::MeshHealth health = geometry::examine(*mesh);
        if (!object.both_sides && (!health.closed || !health.consistently_oriented || health.inside_out())) {
            object.both_sides = true;
            world.remarks.push_back(name + ": " + object.name +
                                    " is no closed surface that faces outwards, and is felt from both sides");
        }
        Box box;
        for (const Vec3& p : mesh->positions_m) box.include(p);
        object.pivot_m = first.pivot_world.value_or(box.empty() ? Vec3(0.0) : box.center());
        object.mesh = std::move(mesh);
        take_colours(object, std::move(colours));
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
    if (found.empty()) return world;
    found.insert(found.end(), vrml.remarks.begin(), vrml.remarks.end());  // what was left out may be why
    return std::unexpected(std::move(found));
}

Result<double> metres_in_vrml(const std::filesystem::path& path, const WorldReading& reading) {
    if (!reading.unit.empty()) return parse_world_unit(reading.unit, "--units");
    if (!has_settings(path)) return 1.0;
    const std::filesystem::path settings = settings_of(path);
    BURIN_TRY(text, read_text_file(settings, kMaxWorldBytes));
    return unit_in_settings(text, settings.string());
}

void scale_vrml(geometry::VrmlWorld& world, double factor) {
    if (factor == 1.0) return;
    Mat4 scaling(factor);
    scaling[3][3] = 1.0;
    for (geometry::VrmlShape& shape : world.shapes) {
        shape.world_from_shape = scaling * shape.world_from_shape;
        if (shape.pivot_world) *shape.pivot_world *= factor;
    }
}

std::string unit_remark(const geometry::VrmlWorld& world, const std::string& name) {
    Box bounds_m;
    for (const geometry::VrmlShape& shape : world.shapes)
        for (const Vec3& p : shape.surface->mesh.positions_m)
            bounds_m.include(Vec3(shape.world_from_shape * glm::dvec4(p, 1.0)));
    if (bounds_m.empty()) return "";
    const Vec3 size_m = bounds_m.extent();
    const double longest_m = std::max({size_m.x, size_m.y, size_m.z});
    if (longest_m <= kLongestInReach_m) return "";
    return formatted(
        "%s: is %.3g m long. VRML has metres; if these are others, --units mm, or [world] unit = \"mm\" in %s, says so "
        "(2.54mm for units of 0.1 inch, as in models of electronic parts)",
        name.c_str(), longest_m, settings_of(name).string().c_str());
}

WorldOrProblems read_any_world(const std::filesystem::path& path, const WorldReading& reading) {
    if (path.extension() == ".toml") {
        if (reading.unit.empty()) return read_world_or_name_its_world(path);
        return std::unexpected(std::vector{Error{"has no place with a world in TOML", "--units " + reading.unit,
                                                 "write mesh_units into its objects"}});
    }
    if (is_mesh_file(path)) return read_mesh_world(path, reading.unit);
    const Result<double> unit_m = metres_in_vrml(path, reading);
    if (!unit_m) return std::unexpected(std::vector{unit_m.error()});
    const Result<geometry::VrmlFile> file = geometry::read_vrml_file(path, reading.root);
    if (!file) return std::unexpected(std::vector{file.error()});
    geometry::VrmlWorldOrFaults shapes = geometry::shapes_of(*file);
    if (!shapes) return std::unexpected(shapes.error());
    scale_vrml(*shapes, *unit_m);
    WorldOrProblems world = world_of(*shapes, path.string());
    if (!world) return world;
    tell_remarks(*world, shapes->remarks, path.string());
    if (const std::string remark = unit_remark(*shapes, path.string()); !remark.empty())
        world->remarks.push_back(remark);
    if (!has_settings(path)) return world;
    const std::filesystem::path settings = settings_of(path);
    const Result<std::string> text = read_text_file(settings, kMaxWorldBytes);
    if (!text) return std::unexpected(std::vector{text.error()});
    if (std::vector<Error> problems = apply_settings(*world, *text, settings.string()); !problems.empty())
        return std::unexpected(std::move(problems));
    return world;
}

}  // namespace burin::scene

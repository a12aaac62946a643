// SPDX-License-Identifier: MIT
#include "scene/world_file.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "base/file_io.hpp"
#include "base/length_unit.hpp"
#include "base/text.hpp"
#include "base/toml_table.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "scene/object_keys.hpp"
#include "scene/value_text.hpp"

namespace burin::scene {
namespace {

namespace fs = std::filesystem;

// A mesh as several objects may name it.
struct WorldMesh {
    std::shared_ptr<const geometry::TriangleMesh> mesh;  // null: could not be read
    geometry::MeshHealth health;
    double reach_m = 0.0;   // of the farthest corner of its box from its origin
    CornerColours colours;  // that the file gives them; empty: none
    std::optional<Error> failure;
};

// Returns the colours of the corners: of the vertices, or else of the triangles' materials.
CornerColours colours_of(const geometry::TriangleMesh& mesh) {
    CornerColours colours;
    if (mesh.colours.empty() && mesh.materials.empty()) return colours;
    colours.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!mesh.colours.empty()) {
            const auto& [a, b, c] = mesh.triangles[i];
            colours.push_back({mesh.colours[a], mesh.colours[b], mesh.colours[c]});
        } else {
            const std::size_t at = mesh.triangle_materials.empty() ? 0 : mesh.triangle_materials[i];
            const Colour colour = at < mesh.materials.size() ? mesh.materials[at].colour : geometry::Material{}.colour;
            colours.push_back({colour, colour, colour});
        }
    }
    return colours;
}

Vec3 middle_of(const geometry::TriangleMesh& mesh) {
    Box box;
    for (const Vec3& p : mesh.positions_m) box.include(p);
    return box.empty() ? Vec3(0.0) : box.center();
}

// Returns why a mesh is not the surface of a solid; empty where it is.
std::string not_solid(const geometry::MeshHealth& health) {
    if (!health.closed) return formatted("is open: %zu edges have a triangle on one side only", health.boundary_edges);
    if (!health.consistently_oriented)
        return formatted("has %zu edges whose two triangles face opposite ways", health.misoriented_edges);
    return health.inside_out() ? "is inside out: its triangles face inwards" : "";
}

// Says how large a mesh of no known unit is, how it was read, and what to write in the object if that is wrong.
std::string guessed_size(const std::string& name, const geometry::ImportReport& report) {
    const LengthUnit read = report.unit.unit, other = read == LengthUnit::m ? LengthUnit::mm : LengthUnit::m;
    return formatted(
        "%s: %s (no unit that Burin knows is given in the file; read as %s, since its longest side is %s %g; "
        "mesh_units = \"%s\" in the [[object]] of a world reads it as %s)",
        name.c_str(), in_millimetres(report.size_m).c_str(), descriptor_of(read).plural,
        read == LengthUnit::m ? "at most" : "above", geometry::kLongestInMetres, name_of(other),
        descriptor_of(other).plural);
}

// Reads one file; collects problems on the way.
class WorldReader {
public:
    WorldReader(const std::string& name, const WorldMeshReader& read_mesh) : reading_{name}, read_mesh_(read_mesh) {}

    WorldOrProblems read(const toml::table& root) {
        TableReader t(reading_, &root, "the file");
        world_.name = t.text("name").value_or("");
        if (has_control_characters(world_.name)) t.refuse("name", "holds control characters", "write it on one line");
        t.require("object", "write [[object]] with name and mesh for each object");
        const std::vector<const toml::table*> tables = t.tables("object");
        if (tables.size() > kMaxWorldObjects)
            t.refuse("object", formatted("stands there %zu times", tables.size()),
                     formatted("a world has at most %zu objects", kMaxWorldObjects));
        else
            for (const toml::table* table : tables) read_object(*table);
        t.refuse_unknown();
        if (!reading_.errors.empty()) return std::unexpected(in_order_of_lines(std::move(reading_.errors)));
        return std::move(world_);
    }

private:
    void read_object(const toml::table& table) {
        ObjectKeys keys(reading_, table);
        TableReader& t = keys.table();
        SceneObject object;
        object.id = world_.objects.size() + 1;
        t.require("name", "give each object a name of its own");
        t.require("mesh", "name an STL, OBJ, PLY or OFF file in the world's folder");
        object.name = t.text("name").value_or("object " + std::to_string(object.id));
        keys.read(object);
        read_mesh(t, object);
        // What the file says is of the mesh's origin, unless it names another pivot; who turns it later expects its
        // middle.
        if (object.mesh && !t.has("pivot")) object.pivot_m = middle_of(*object.mesh);
        t.refuse_unknown();
        keys.tell_problems(object);
        check_others(t, table, object);
        world_.objects.push_back(std::move(object));
    }

    // ---- Meshes

    void read_mesh(TableReader& t, SceneObject& object) {
        const std::optional<LengthUnit> unit = read_unit(t);
        const auto name = t.text("mesh");
        if (!name) return;
        const WorldMesh& known = mesh_of(*name, unit);
        if (known.failure) return t.refuse("mesh", known.failure->what, known.failure->remedy);
        object.mesh = known.mesh;
        if (t.find("colour") == nullptr) take_colours(object, known.colours);
        if (const double reach_m = object.scale * known.reach_m; object.scale <= kMaxScale && reach_m > kMaxDistance_m)
            t.refuse("mesh", formatted("reaches %.3g m from its origin", reach_m), "give mesh_units, or another scale");
        if (!object.felt || object.both_sides) return;
        if (const std::string why = not_solid(known.health); !why.empty())
            t.refuse("mesh", why,
                     "burin convert --close-holes closes and turns it, --weld joins corners; both_sides = true has it "
                     "felt from "
                     "either side, felt = false not at all");
    }

    std::optional<LengthUnit> read_unit(TableReader& t) {
        const auto word = t.text("mesh_units");
        if (!word) return std::nullopt;
        const auto unit = length_unit(*word);
        if (!unit) t.refuse("mesh_units", "is " + *word, "write m, cm, mm, in or ft, or leave it out");
        return unit;
    }

    const WorldMesh& mesh_of(const std::string& name, std::optional<LengthUnit> unit) {
        const auto [at, is_new] = meshes_.try_emplace({fs::path(name).lexically_normal().string(), unit});
        WorldMesh& known = at->second;
        if (!is_new) return known;
        if (triangles_ >= kMaxWorldTriangles) {
            known.failure = Error{formatted("is one too many: the others have %zu triangles", triangles_), "",
                                  formatted("a world has at most %zu", kMaxWorldTriangles)};
            return known;
        }
        Result<geometry::ImportedMesh> imported = read_mesh_(name, unit);
        if (!imported) {
            known.failure = Error{"cannot be used: " + imported.error().where + ": " + imported.error().what, "",
                                  imported.error().remedy};
            return known;
        }
        // Before vertices of several colours become one.
        known.colours =
            imported->corner_colours.empty() ? colours_of(imported->mesh) : std::move(imported->corner_colours);
        geometry::weld_vertices(imported->mesh);
        const auto joined = geometry::join_open_edges(imported->mesh, imported->report.weld_tolerance_m);
        if (joined.triangles_dropped > 0) known.colours = colours_of(imported->mesh);
        triangles_ += imported->mesh.triangles.size();
        if (imported->mesh.triangles.empty()) known.failure = Error{"has no triangles: " + name, "", "name another"};
        known.health = geometry::examine(imported->mesh);
        const Box& box = known.health.bounds_m;
        if (!box.empty()) known.reach_m = glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
        const geometry::ImportReport& report = imported->report;
        for (const std::string& remark : report.remarks) world_.remarks.push_back(name + ": " + remark);
        if (joined.vertices_joined > 0) world_.remarks.push_back(name + ": " + in_words(joined));
        if (report.unit.source == geometry::UnitSource::guessed) world_.remarks.push_back(guessed_size(name, report));
        known.mesh = std::make_shared<const geometry::TriangleMesh>(std::move(imported->mesh));
        return known;
    }

    // ---- Checks

    // Compares the object with those before it.
    void check_others(TableReader& t, const toml::table& table, const SceneObject& object) {
        const toml::node* const name = t.find("name");
        if (name != nullptr) {
            const auto line = static_cast<std::uint32_t>(name->source().begin.line);
            const auto [at, is_new] = names_.try_emplace(object.name, line);
            if (!is_new)
                t.refuse("name",
                         formatted("\"%.100s\" is also that of the object in line %u", object.name.c_str(),
                                   static_cast<unsigned>(at->second)),
                         "give each object a name of its own");
        }
        if (!object.felt || !problems(object.material).empty()) return;
        const bool is_known = std::ranges::find(materials_, object.material) != materials_.end();
        if (is_known) return;
        if (materials_.size() == kMaxWorldMaterials)
            reading_.refuse(table, formatted("its material is one more than %zu different ones", kMaxWorldMaterials),
                            "let it feel like another object");
        else
            materials_.push_back(object.material);
    }

    TableReading reading_;
    const WorldMeshReader& read_mesh_;
    World world_;
    std::map<std::pair<std::string, std::optional<LengthUnit>>, WorldMesh> meshes_;
    std::size_t triangles_ = 0;
    std::map<std::string, std::uint32_t> names_;  // and their lines
    std::vector<HapticMaterial> materials_;       // that are felt
};

}  // namespace

WorldMeshReader meshes_beside(const fs::path& world) {
    return [folder = world.parent_path()](const std::string& name,
                                          std::optional<LengthUnit> unit) -> Result<geometry::ImportedMesh> {
        constexpr const char* kRemedy = "copy that file into the world's folder";
        const fs::path relative = fs::path(name).lexically_normal();
        if (name.empty() || relative.is_absolute() || *relative.begin() == "..")
            return fail(name.empty() ? "\"\"" : name, "is not in the world's folder", kRemedy);
        std::error_code code;
        const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, code);
        const fs::path real = fs::weakly_canonical(root / relative, code);
        if (std::ranges::mismatch(root, real).in1 != root.end())
            return fail(name, "is a link that leads out of the world's folder", kRemedy);
        return geometry::import_mesh(folder / relative, unit);
    };
}

WorldOrProblems parse_world(std::string_view text, const std::string& name, const WorldMeshReader& read_mesh) {
    const Result<toml::table> root = parse_toml(text, name);
    if (!root) return std::unexpected(std::vector{root.error()});
    return WorldReader(name, read_mesh).read(*root);
}

WorldOrProblems read_world(const fs::path& path) {
    const Result<std::string> text = read_text_file(path, kMaxWorldBytes);
    if (!text) return std::unexpected(std::vector{text.error()});
    return parse_world(*text, path.string(), meshes_beside(path));
}

}  // namespace burin::scene

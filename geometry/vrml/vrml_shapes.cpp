// SPDX-License-Identifier: MIT
#include "geometry/vrml/vrml_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <unordered_map>
#include <utility>

#include "geometry/files/mesh_import.hpp"
#include "geometry/files/text_scanner.hpp"
#include "geometry/vrml/vrml_fields.hpp"
#include "geometry/vrml/vrml_geometry.hpp"
#include "geometry/vrml/vrml_textures.hpp"

namespace burin::geometry {
namespace {

constexpr std::string_view kHapticMaterial = "HapticMaterial";
constexpr std::string_view kFurtherTypes = "nodes of further types";
constexpr std::size_t kFieldsLikeANode = 32;

// A name given by DEF, at one of the places where its node is used.
struct DefinedName {
    std::string_view def;
    std::string unique;  // empty until the first shape takes it
};

// The surroundings of a node.
struct Surroundings {
    Mat4 world_from_here{1.0};
    DefinedName* name = nullptr;
    std::optional<Vec3> pivot_world = {};
    bool names_pivot = true;  // the next Transform has it: none around has a name
    std::size_t depth = 0;
};

struct SharedSurface {
    std::shared_ptr<const VrmlSurface> surface;  // null: nothing to see, or a fault
    Box bounds;
};

// ISO/IEC 14772-1:1997, 6.52: P' = T * C * R * SR * S * -SR * -C * P.
Mat4 matrix_of_transform(VrmlFields& fields, const VrmlPlaced& node, const Vec3& scale) {
    const Mat4 unit(1.0);
    const Vec3 center = fields.vector(node, "center", Vec3(0.0));
    const Mat4 rotation = glm::mat4_cast(fields.rotation(node, "rotation"));
    const Mat4 orientation = glm::mat4_cast(fields.rotation(node, "scaleOrientation"));
    Mat4 scaling(1.0);
    for (int k = 0; k < 3; ++k) scaling[k][k] = scale[k];
    Mat4 moved = unit, back = unit;
    moved[3] = glm::dvec4(fields.vector(node, "translation", Vec3(0.0)) + center, 1.0);
    back[3] = glm::dvec4(-center, 1.0);
    return moved * rotation * orientation * scaling * glm::transpose(orientation) * back;
}

bool is_group(std::string_view type) {
    return type == "Group" || type == "Anchor" || type == "Billboard" || type == "Collision";
}

class WorldWalk {
public:
    explicit WorldWalk(const VrmlFile& file) : fields_(file) {}

    VrmlWorldOrFaults walk() {
        const VrmlFile& file = fields_.file();
        for (const VrmlFault& f : file.faults) fields_.fault(f.place, f.what, f.remedy);
        visit_all(file.roots_of(file.sources[0]), {});
        if (!fields_.faults().empty()) {
            std::vector<Error> errors;
            for (const VrmlFault& f : fields_.faults()) errors.push_back(file.error_of(f));
            return std::unexpected(std::move(errors));
        }
        for (const VrmlFault& f : file.remarks) fields_.remark(f.place, f.what, f.remedy);
        for (const VrmlFault& f : fields_.remarks()) world_.remarks.push_back(file.error_of(f));
        return std::move(world_);
    }

private:
    // has_pivot: it is a Transform, or an instance of which one may be the body.
    void name(Surroundings& around, std::string_view def, bool has_pivot) {
        around.name = &names_.emplace_back(DefinedName{def, {}});
        around.names_pivot = has_pivot || !around.pivot_world;
    }

    void visit_all(std::span<const VrmlLink> links, const Surroundings& around) {
        for (const VrmlLink& link : links) visit({link.node, nullptr}, around);
    }

    void visit_all(const std::vector<VrmlPlaced>& nodes, const Surroundings& around) {
        for (const VrmlPlaced& node : nodes) visit(node, around);
    }

    // Counts a node; false where there are too many.
    bool enter(const VrmlPlaced& placed) {
        if (fields_.full()) return false;
        if (!fields_.spend(fields_.place(placed), 1 + fields_.node(placed).field_count / kFieldsLikeANode))
            return false;
        ++world_.nodes;
        fields_.check_names(placed);
        return true;
    }

    void visit(const VrmlPlaced& placed, Surroundings around) {
        if (!enter(placed)) return;
        const VrmlFile& file = fields_.file();
        const VrmlNode& node = fields_.node(placed);
        if (++around.depth > kDeepestVrmlNode) {
            return fields_.fault(fields_.place(placed),
                                 "nodes are nested more than " + std::to_string(kDeepestVrmlNode) +
                                     " deep, through PROTO, USE and Inline",
                                 "take groups out of each other");
        }
        if (node.name_length > 0 && (placed.within == nullptr || !placed.within->named))
            name(around, file.name_of(node), node.prototype != kNoVrmlIndex || file.type_of(node) == "Transform");
        if (node.prototype != kNoVrmlIndex) {
            const auto body = fields_.body_of(placed);
            if (body) return visit(*body, around);
            return skip(placed);
        }
        const std::string_view type = file.type_of(node);
        if (type == "Shape") {
            shape(placed, around);
        } else if (type == "Transform") {
            transform(placed, around);
        } else if (is_group(type)) {
            visit_all(fields_.nodes(placed, "children"), around);
        } else if (type == "Switch" || type == "LOD") {
            choice(placed, around, type == "LOD");
        } else if (type == "Inline") {
            inlined(placed, around);
        } else {
            skip(placed);
            if (vrml_geometry_maker(type) == nullptr) return;
            fields_.remark(fields_.place(placed), in_quotes(type) + " stands outside of a Shape, where it is not shown",
                           "write Shape { geometry ... } around it");
        }
    }

    void transform(const VrmlPlaced& placed, Surroundings around) {
        const Vec3 scale = fields_.vector(placed, "scale", Vec3(1.0));
        if (scale.x == 0.0 || scale.y == 0.0 || scale.z == 0.0) {
            return fields_.remark(fields_.place(placed), "a Transform scales by 0, so that nothing in it has a volume",
                                  "it is left out; scale by numbers above 0");
        }
        if (around.names_pivot) {
            const Vec3 middle =
                fields_.vector(placed, "translation", Vec3(0.0)) + fields_.vector(placed, "center", Vec3(0.0));
            around.pivot_world = Vec3(around.world_from_here * glm::dvec4(middle, 1.0));
            around.names_pivot = around.name == nullptr;  // what stands within a named one turns with it
        }
        around.world_from_here = around.world_from_here * matrix_of_transform(fields_, placed, scale);
        visit_all(fields_.nodes(placed, "children"), around);
    }

    void choice(const VrmlPlaced& placed, const Surroundings& around, bool level) {
        const std::int64_t chosen = level ? 0 : fields_.integer(placed, "whichChoice", -1);
        const std::vector<VrmlPlaced> all = fields_.nodes(placed, level ? "level" : "choice");
        if (chosen >= 0 && chosen < std::ssize(all)) visit(all[static_cast<std::size_t>(chosen)], around);
    }

    void inlined(const VrmlPlaced& placed, const Surroundings& around) {
        const VrmlFile& file = fields_.file();
        const VrmlNode& node = fields_.node(placed);
        if (node.inlined != kNoVrmlIndex) return visit_all(file.roots_of(file.sources[node.inlined]), around);
        const auto url = fields_.find(placed, "url");
        const VrmlBoundInline* const bound = url ? file.bound_inline(*url->field) : nullptr;
        if (bound != nullptr && bound->source != kNoVrmlIndex)
            return visit_all(file.roots_of(file.sources[bound->source]), around);
        if (bound != nullptr) return fields_.fault(bound->fault.place, bound->fault.what, bound->fault.remedy);
        skip(placed);
        fields_.remark(fields_.place(placed), "an Inline names no file here", "write its name in quotes behind url");
    }

    void skip(const VrmlPlaced& placed) {
        const bool listed = skipped_.size() < kMostVrmlFaults || skipped_.contains(std::string(fields_.type(placed)));
        const std::string type(listed ? fields_.type(placed) : kFurtherTypes);
        const auto [entry, is_new] = skipped_.try_emplace(type, world_.skipped.size());
        if (is_new) world_.skipped.push_back({type, 0, fields_.place(placed)});
        ++world_.skipped[entry->second].count;
        if (!is_new || !listed || fields_.remarked_enough() || is_vrml_type(type) ||
            fields_.node(placed).prototype != kNoVrmlIndex)
            return;
        fields_.remark(fields_.place(placed), in_quotes(type) + " is no node of VRML 2.0",
                       "it is left out; the nearest name is " + in_quotes(nearest_vrml_type(type)));
    }

    // ---- Shapes

    void shape(const VrmlPlaced& placed, const Surroundings& around) {
        VrmlShape made;
        made.place = fields_.place(placed);
        made.world_from_shape = around.world_from_here;
        made.pivot_world = around.pivot_world;
        VrmlTexture texture;
        for (const VrmlPlaced& appearance : fields_.nodes(placed, "appearance")) appear(appearance, made, texture);
        const std::vector<VrmlPlaced> geometries = fields_.nodes(placed, "geometry");
        for (const VrmlPlaced& given : geometries) {
            const auto node = fields_.resolved(given);
            if (!node) {
                skip(given);
                continue;
            }
            const SharedSurface& shared = surface(*node, texture.picture != nullptr);
            if (!shared.surface || !fits(placed, shared, made.world_from_shape)) continue;
            made.surface =
                texture.picture ? painted(*shared.surface, fields_.type(*node), texture, made.colour) : shared.surface;
            made.name = name_for(around, given);
            world_.triangles += shared.surface->mesh.triangles.size();
            world_.shapes.push_back(made);
        }
    }

    // Reads an Appearance, or a HapticMaterial in its place.
    void appear(const VrmlPlaced& given, VrmlShape& made, VrmlTexture& texture) {
        const auto node = through_haptics(given, made);
        if (!node) return skip(given);
        if (!enter(*node)) return;
        const std::string_view type = fields_.type(*node);
        if (type == "Material") return colour(*node, made);
        if (type != "Appearance") return skip(*node);
        for (const VrmlPlaced& material : fields_.nodes(*node, "material")) {
            const auto at = through_haptics(material, made);
            if (!at) {
                skip(material);
            } else if (fields_.type(*at) != "Material") {
                skip(*at);
            } else if (enter(*at)) {
                colour(*at, made);
            }
        }
        texture = textures_.texture_of(*node, [&](const VrmlPlaced& unread) { skip(unread); });
    }

    // Resolves an instance as VrmlFields::resolved() does, and keeps the numbers of a HapticMaterial on the way.
    std::optional<VrmlPlaced> through_haptics(const VrmlPlaced& given, VrmlShape& made) {
        std::optional<VrmlPlaced> at = given;
        while (at && fields_.node(*at).prototype != kNoVrmlIndex) {
            if (fields_.type(*at) == kHapticMaterial) keep_numbers(*at, made);
            at = fields_.body_of(*at);
        }
        return at;
    }

    void keep_numbers(const VrmlPlaced& instance, VrmlShape& made) {
        const VrmlFile& file = fields_.file();
        const VrmlNode& node = fields_.node(instance);
        const auto keep = [&](std::string_view name, const VrmlField& value) {
            if (value.kind == VrmlKind::numbers && value.count == 1)
                made.haptics[std::string(name)] = file.numbers[value.first];
        };
        const VrmlPrototype& prototype = file.prototypes[node.prototype];
        for (const VrmlField& field : file.fields_of(prototype))
            keep(file.text_at({prototype.file, field.at}, field.name_length), field);
        for (const VrmlField& field : file.fields_of(node)) {
            const std::string_view name = file.text_at({node.file, field.at}, field.name_length);
            if (const auto value = fields_.find(instance, name)) keep(name, *value->field);
        }
    }

    void colour(const VrmlPlaced& material, VrmlShape& made) {
        // What glows is seen in that colour too, whatever light falls on it.
        const Vec3 diffuse = glm::min(Vec3(1.0), fields_.colour(material, "diffuseColor", Vec3(0.8)) +
                                                     fields_.colour(material, "emissiveColor", Vec3(0.0)));
        made.transparency = fields_.from_0_to_1(material, "transparency", 0.0);
        made.colour = vrml_colour(diffuse.x, diffuse.y, diffuse.z);
    }

    // Returns the triangles of a geometry node, which is no instance; made once where no PROTO's instance changes it.
    const SharedSurface& surface(const VrmlPlaced& placed, bool textured) {
        const VrmlNode& node = fields_.node(placed);
        auto& surfaces = textured ? textured_surfaces_ : surfaces_;
        if (const auto known = surfaces.find(placed.node); known != surfaces.end()) {
            static_cast<void>(enter(placed));
            return known->second;
        }
        SharedSurface made;
        if (const VrmlGeometryMaker maker = vrml_geometry_maker(fields_.type(placed)); maker == nullptr) {
            skip(placed);
        } else if (enter(placed)) {
            VrmlSurface surface = maker({fields_, placed, kMostVrmlTriangles - world_.triangles, textured});
            for (const auto& t : surface.mesh.triangles) {
                for (const std::uint32_t v : t) made.bounds.include(surface.mesh.positions_m[v]);
            }
            if (!surface.mesh.triangles.empty()) {
                made.surface = std::make_shared<const VrmlSurface>(std::move(surface));
            }
        }
        // Nodes changed by an instance are not taken from the cache: the changes hold only until the next instance.
        if (node.bound) return unshared_ = std::move(made);
        return surfaces.emplace(placed.node, std::move(made)).first->second;
    }

    // Checks that the shape has a place in space, and the world room for its triangles.
    bool fits(const VrmlPlaced& placed, const SharedSurface& shared, const Mat4& world_from_shape) {
        if (shared.surface->mesh.triangles.size() > kMostVrmlTriangles - world_.triangles) {
            fields_.fault(fields_.place(placed),
                          "the world has more than " + std::to_string(kMostVrmlTriangles) + " triangles",
                          "reduce or split it");
            return false;
        }
        for (int corner = 0; corner < 8; ++corner) {
            const auto side = [&](int axis) {
                return (corner >> axis & 1) != 0 ? shared.bounds.hi[axis] : shared.bounds.lo[axis];
            };
            const Vec3 p(world_from_shape * glm::dvec4(side(0), side(1), side(2), 1.0));
            if (finite(p) && glm::all(glm::lessThanEqual(glm::abs(p), Vec3(kMaxCoordinate)))) continue;
            fields_.fault(fields_.place(placed), "this shape reaches farther than 1e9 m from the origin",
                          "look for a scale or a translation around it that is too large");
            return false;
        }
        const double volume = glm::determinant(glm::dmat3(world_from_shape));
        if (std::isnormal(volume)) return true;
        fields_.remark(fields_.place(placed), "this shape is scaled to nothing", "it is left out; look at the scales");
        return false;
    }

    // ---- Names

    std::string name_for(const Surroundings& around, const VrmlPlaced& geometry) {
        if (around.name == nullptr) return std::string(fields_.file().name_of(fields_.node(geometry)));
        if (around.name->unique.empty()) around.name->unique = unique_name(std::string(around.name->def));
        return around.name->unique;
    }

    std::string unique_name(const std::string& def) {
        std::size_t& number = taken_[def];
        std::string name = def;
        while (++number > 1 && taken_.contains(name = def + "-" + std::to_string(number))) {
        }
        if (number > 1) taken_.emplace(name, 1);
        return name;
    }

    VrmlFields fields_;
    VrmlWorld world_;
    std::deque<DefinedName> names_;
    std::map<std::string, std::size_t> taken_, skipped_;
    VrmlTextures textures_{fields_};
    std::unordered_map<std::uint32_t, SharedSurface> surfaces_, textured_surfaces_;
    SharedSurface unshared_;
};

}  // namespace

VrmlWorldOrFaults shapes_of(const VrmlFile& file) { return WorldWalk(file).walk(); }

TriangleMesh mesh_in_world(const VrmlShape& shape) {
    TriangleMesh mesh = shape.surface->mesh;
    for (Vec3& p : mesh.positions_m) p = Vec3(shape.world_from_shape * glm::dvec4(p, 1.0));
    if (shape.mirrored()) {
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    return mesh;
}

}  // namespace burin::geometry

// SPDX-License-Identifier: MIT
#include "geometry/vrml/vrml_fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

// So many entries of a list take about the time of a node.
constexpr std::size_t kNumbersLikeANode = 256, kLinksLikeANode = 64;

struct TypeFields {
    std::string_view type;
    std::vector<std::string_view> fields;
};

// The fields of the node types that are read (ISO/IEC 14772-1:1997, clause 6), those without effect included.
const std::vector<TypeFields>& read_types() {
    static const std::vector<TypeFields> types{
        {"Anchor", {"children", "description", "parameter", "url", "bboxCenter", "bboxSize"}},
        {"Appearance", {"material", "texture", "textureTransform"}},
        {"Billboard", {"axisOfRotation", "children", "bboxCenter", "bboxSize"}},
        {"Box", {"size"}},
        {"Collision", {"children", "collide", "bboxCenter", "bboxSize", "proxy"}},
        {"Color", {"color"}},
        {"Cone", {"bottomRadius", "height", "side", "bottom"}},
        {"Coordinate", {"point"}},
        {"Cylinder", {"bottom", "height", "radius", "side", "top"}},
        {"ElevationGrid",
         {"color", "normal", "texCoord", "height", "ccw", "colorPerVertex", "creaseAngle", "normalPerVertex", "solid",
          "xDimension", "xSpacing", "zDimension", "zSpacing"}},
        {"Extrusion",
         {"beginCap", "ccw", "convex", "creaseAngle", "crossSection", "endCap", "orientation", "scale", "solid",
          "spine"}},
        {"Group", {"children", "bboxCenter", "bboxSize"}},
        {"IndexedFaceSet",
         {"color", "coord", "normal", "texCoord", "ccw", "colorIndex", "colorPerVertex", "convex", "coordIndex",
          "creaseAngle", "normalIndex", "normalPerVertex", "solid", "texCoordIndex"}},
        {"ImageTexture", {"url", "repeatS", "repeatT"}},
        {"Inline", {"url", "bboxCenter", "bboxSize"}},
        {"LOD", {"level", "center", "range"}},
        {"Material",
         {"ambientIntensity", "diffuseColor", "emissiveColor", "shininess", "specularColor", "transparency"}},
        {"PixelTexture", {"image", "repeatS", "repeatT"}},
        {"Shape", {"appearance", "geometry"}},
        {"Sphere", {"radius"}},
        {"Switch", {"choice", "whichChoice"}},
        {"TextureCoordinate", {"point"}},
        {"TextureTransform", {"center", "rotation", "scale", "translation"}},
        {"Transform",
         {"center", "children", "rotation", "scale", "scaleOrientation", "translation", "bboxCenter", "bboxSize"}},
    };
    return types;
}

// The other node types of the standard.
constexpr std::string_view kOtherVrmlTypes[] = {"AudioClip",
                                                "Background",
                                                "ColorInterpolator",
                                                "CoordinateInterpolator",
                                                "CylinderSensor",
                                                "DirectionalLight",
                                                "Fog",
                                                "FontStyle",
                                                "IndexedLineSet",
                                                "MovieTexture",
                                                "NavigationInfo",
                                                "Normal",
                                                "NormalInterpolator",
                                                "OrientationInterpolator",
                                                "PlaneSensor",
                                                "PointLight",
                                                "PointSet",
                                                "PositionInterpolator",
                                                "ProximitySensor",
                                                "ScalarInterpolator",
                                                "Script",
                                                "Sound",
                                                "SphereSensor",
                                                "SpotLight",
                                                "Text",
                                                "TimeSensor",
                                                "TouchSensor",
                                                "Viewpoint",
                                                "VisibilitySensor",
                                                "WorldInfo"};

const TypeFields* read_type(std::string_view type) {
    const auto& types = read_types();
    const auto found = std::ranges::find(types, type, &TypeFields::type);
    return found == types.end() ? nullptr : &*found;
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

bool is_vrml_type(std::string_view type) {
    return read_type(type) != nullptr || std::ranges::find(kOtherVrmlTypes, type) != std::end(kOtherVrmlTypes);
}

std::string_view nearest_vrml_type(std::string_view type) {
    std::vector<std::string_view> all(std::begin(kOtherVrmlTypes), std::end(kOtherVrmlTypes));
    for (const TypeFields& known : read_types()) all.push_back(known.type);
    return nearest_name(type, all);
}

void VrmlFields::fault(VrmlPlace place, std::string what, std::string remedy) {
    if (!full()) faults_.insert({place, std::move(what), std::move(remedy)});
}

void VrmlFields::remark(VrmlPlace place, std::string what, std::string remedy) {
    if (!remarked_enough()) remarks_.insert({place, std::move(what), std::move(remedy)});
}

void VrmlFields::fault_at_value(const VrmlValue& value, std::size_t index, std::string what, std::string remedy) {
    if (full() || !blamed_.emplace(value.field, index).second) return;
    fault(file_.place_of_value(value.file, *value.field, index), std::move(what), std::move(remedy));
}

void VrmlFields::remark_at_value(const VrmlValue& value, std::size_t index, std::string what, std::string remedy) {
    if (remarked_enough() || !blamed_.emplace(value.field, index).second) return;
    remark(file_.place_of_value(value.file, *value.field, index), std::move(what), std::move(remedy));
}

bool VrmlFields::spend(VrmlPlace place, std::size_t nodes) {
    if (spent_all()) return false;
    spent_ += nodes;
    if (!spent_all()) return true;
    fault(place,
          "the world has more than " + std::to_string(kMostVrmlNodes) +
              " nodes, counting each again wherever it is used, and long lists for several",
          "use fewer, or split the world");
    return false;
}

// ---- Finding a value

// The last one of several counts.
const VrmlField* VrmlFields::field_of(std::span<const VrmlField> fields, std::uint32_t file,
                                      std::string_view name) const {
    for (std::size_t i = fields.size(); i-- > 0;) {
        if (file_.text_at({file, fields[i].at}, fields[i].name_length) == name) return &fields[i];
    }
    return nullptr;
}

std::optional<VrmlValue> VrmlFields::find(const VrmlPlaced& placed, std::string_view name) {
    const VrmlNode& holder = node(placed);
    VrmlValue value{field_of(file_.fields_of(holder), holder.file, name), holder.file, placed.within};
    while (value.field != nullptr && value.field->kind == VrmlKind::is) {
        if (value.within == nullptr) return std::nullopt;  // a fault of the syntax
        const std::string_view bound = file_.strings[value.field->first];
        const VrmlNode& instance = file_.nodes[value.within->node];
        const VrmlPrototype& prototype = file_.prototypes[instance.prototype];
        const VrmlField* declared = field_of(file_.fields_of(prototype), prototype.file, bound);
        if (declared == nullptr) {
            fault({value.file, value.field->at},
                  "PROTO " + in_quotes(file_.name_of(prototype)) + " has no field " + in_quotes(bound),
                  "declare it in the list behind the PROTO's name");
            return std::nullopt;
        }
        const VrmlInstance* const outer = value.within->outer;
        const VrmlField* given = field_of(file_.fields_of(instance), instance.file, bound);
        value = given != nullptr ? VrmlValue{given, instance.file, outer} : VrmlValue{declared, prototype.file, outer};
    }
    if (value.field == nullptr || value.field->kind == VrmlKind::broken || value.field->kind == VrmlKind::nothing)
        return std::nullopt;
    return value;
}

std::optional<VrmlPlaced> VrmlFields::body_of(const VrmlPlaced& placed) {
    const VrmlNode& instance = node(placed);
    const VrmlPrototype& prototype = file_.prototypes[instance.prototype];
    if (prototype.external || prototype.link_count == 0) return std::nullopt;
    const std::size_t depth = placed.within == nullptr ? 1 : placed.within->depth + 1;
    if (depth > kDeepestVrmlNode) {
        fault(place(placed), "PROTOs are nested more than " + std::to_string(kDeepestVrmlNode) + " deep",
              "take them out of each other");
        return std::nullopt;
    }
    if (!spend(place(placed), 1)) return std::nullopt;
    const bool named = instance.name_length > 0 || (placed.within != nullptr && placed.within->named);
    instances_.push_back({placed.node, placed.within, named, depth});
    return VrmlPlaced{file_.links[prototype.first_link].node, &instances_.back()};
}

std::optional<VrmlPlaced> VrmlFields::resolved(VrmlPlaced placed) {
    std::optional<VrmlPlaced> at = placed;
    while (at && node(*at).prototype != kNoVrmlIndex) at = body_of(*at);
    return at;
}

// ---- Values of a type

bool VrmlFields::is_kind(const VrmlValue& value, VrmlKind kind, std::string_view name, const char* expected) {
    if (value.field->kind == kind) return true;
    fault({value.file, value.field->value_at}, in_quotes(name) + " takes " + expected, "write that in its place");
    return false;
}

// Points at each that is no finite number, and at the first that is too large.
bool VrmlFields::are_sound(const VrmlValue& value, std::span<const double> numbers, std::string_view name,
                           const VrmlNumberLimits& limits) {
    bool sound = true, has_huge = false;
    for (std::size_t i = 0; i < numbers.size() && !full(); ++i) {
        const bool is_huge = std::abs(numbers[i]) > limits.most;
        if (!is_huge && (limits.not_numbers || !std::isnan(numbers[i]))) continue;
        sound = false;
        if (std::isfinite(numbers[i]) && std::exchange(has_huge, true)) continue;
        fault_at_value(value, i,
                       in_quotes(name) +
                           (std::isfinite(numbers[i]) ? " has a number above 1e9" : " has what is not a finite number"),
                       "repair the file or export it again");
    }
    return sound;
}

std::span<const double> VrmlFields::exactly(const VrmlPlaced& placed, std::string_view name, std::size_t count) {
    const auto value = find(placed, name);
    if (!value) return {};
    const std::string expected = counted(count, "number", "numbers");
    if (!is_kind(*value, VrmlKind::numbers, name, expected.c_str())) return {};
    if (value->field->count != count) {
        fault({value->file, value->field->value_at},
              in_quotes(name) + " takes " + expected + ", and has " + std::to_string(value->field->count),
              "write " + expected);
        return {};
    }
    const std::span<const double> values = std::span(file_.numbers).subspan(value->field->first, count);
    return are_sound(*value, values, name, {}) ? values : std::span<const double>();
}

double VrmlFields::number(const VrmlPlaced& placed, std::string_view name, double otherwise) {
    const auto values = exactly(placed, name, 1);
    return values.empty() ? otherwise : values[0];
}

double VrmlFields::positive(const VrmlPlaced& placed, std::string_view name, double otherwise) {
    const double value = number(placed, name, otherwise);
    if (value > 0.0) return value;
    remark_at_value(*find(placed, name), 0, in_quotes(name) + " is not above zero",
                    "its shape is left out; write a length in metres");
    return 0.0;
}

double VrmlFields::from_0_to_1(const VrmlPlaced& placed, std::string_view name, double otherwise) {
    const double value = number(placed, name, otherwise);
    if (value >= 0.0 && value <= 1.0) return value;
    const double nearer = std::clamp(value, 0.0, 1.0);
    remark_at_value(*find(placed, name), 0, in_quotes(name) + formatted(" is %.9g, not from 0 to 1", value),
                    formatted("it is taken for %g", nearer));
    return nearer;
}

std::int64_t VrmlFields::integer(const VrmlPlaced& placed, std::string_view name, std::int64_t otherwise) {
    const double value = number(placed, name, static_cast<double>(otherwise));
    if (value == std::floor(value)) return static_cast<std::int64_t>(value);
    fault_at_value(*find(placed, name), 0, in_quotes(name) + " is not a whole number", "write a whole number");
    return otherwise;
}

bool VrmlFields::flag(const VrmlPlaced& placed, std::string_view name, bool otherwise) {
    const auto value = find(placed, name);
    if (!value || !is_kind(*value, VrmlKind::booleans, name, "TRUE or FALSE")) return otherwise;
    return file_.numbers[value->field->first] != 0.0;
}

Vec3 VrmlFields::vector(const VrmlPlaced& placed, std::string_view name, const Vec3& otherwise) {
    const auto values = exactly(placed, name, 3);
    return values.empty() ? otherwise : Vec3(values[0], values[1], values[2]);
}

Vec3 VrmlFields::colour(const VrmlPlaced& placed, std::string_view name, const Vec3& otherwise) {
    if (const auto value = find(placed, name);
        value && value->field->kind == VrmlKind::numbers && value->field->count == 3) {
        const auto numbers = std::span(file_.numbers).subspan(value->field->first, 3);
        const auto none = std::ranges::find_if_not(numbers, [](double v) { return std::isfinite(v); });
        if (none != numbers.end()) {
            remark_at_value(*value, static_cast<std::size_t>(none - numbers.begin()),
                            in_quotes(name) + " has a colour that is no number", "it is left out");
            return otherwise;
        }
    }
    const Vec3 given = vector(placed, name, otherwise), nearer = glm::clamp(given, 0.0, 1.0);
    for (int k = 0; k < 3; ++k) {
        if (given[k] == nearer[k]) continue;
        remark_at_value(*find(placed, name), static_cast<std::size_t>(k),
                        formatted("a colour has the number %.9g, not from 0 to 1", given[k]),
                        formatted("it is taken for %g", nearer[k]));
    }
    return nearer;
}

Quat VrmlFields::rotation(const VrmlPlaced& placed, std::string_view name) {
    const auto values = exactly(placed, name, 4);
    if (values.empty()) return Quat(1.0, 0.0, 0.0, 0.0);
    return vrml_rotation(Vec3(values[0], values[1], values[2]), values[3]);
}

VrmlNumbers VrmlFields::numbers(const VrmlPlaced& placed, std::string_view name, std::size_t size,
                                const VrmlNumberLimits& limits) {
    const auto value = find(placed, name);
    if (!value) return {};
    if (value->field->kind == VrmlKind::empty) return {{}, *value};
    if (!spend(place(placed), value->field->count / kNumbersLikeANode)) return {{}, *value};
    const std::string expected = size == 1 ? "numbers" : "numbers in groups of " + std::to_string(size);
    if (!is_kind(*value, VrmlKind::numbers, name, expected.c_str())) return {{}, *value};
    if (value->field->count % size != 0) {
        fault({value->file, value->field->value_at},
              in_quotes(name) + " takes " + expected + ", and has " + std::to_string(value->field->count),
              "complete the last group, or remove it");
        return {{}, *value};
    }
    const auto values = std::span(file_.numbers).subspan(value->field->first, value->field->count);
    if (!are_sound(*value, values, name, limits)) return {{}, *value};
    return {values, *value};
}

std::vector<VrmlPlaced> VrmlFields::nodes(const VrmlPlaced& placed, std::string_view name) {
    const auto value = find(placed, name);
    if (!value || value->field->kind == VrmlKind::empty) return {};
    if (!is_kind(*value, VrmlKind::nodes, name, "nodes")) return {};
    if (!spend(place(placed), value->field->count / kLinksLikeANode)) return {};
    std::vector<VrmlPlaced> found;
    for (const VrmlLink& link : std::span(file_.links).subspan(value->field->first, value->field->count))
        found.push_back({link.node, value->within});
    return found;
}

void VrmlFields::check_names(const VrmlPlaced& placed) {
    const TypeFields* const known = read_type(type(placed));
    if (known == nullptr || remarked_enough() || node(placed).prototype != kNoVrmlIndex) return;
    for (const VrmlField& field : file_.fields_of(node(placed))) {
        const VrmlPlace place{node(placed).file, field.at};
        const std::string_view name = file_.text_at(place, field.name_length);
        // A PROTO also binds its events, whose names are not listed.
        if (field.kind == VrmlKind::is || std::ranges::find(known->fields, name) != known->fields.end()) continue;
        remark(place, in_quotes(type(placed)) + " has no field " + in_quotes(name),
               "it has no effect; the nearest name is " + in_quotes(nearest_name(name, known->fields)));
    }
}

}  // namespace burin::geometry

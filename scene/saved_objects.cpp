// SPDX-License-Identifier: MIT
#include "scene/saved_objects.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/json.hpp"
#include "scene/touchable.hpp"
#include "scene/world_file.hpp"

namespace burin::scene {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(std::array<Colour, 3>) == 9, "without gaps");

constexpr const char *kObject = "object", *kMesh = "mesh", *kColours = "colours";
constexpr std::string_view kChanged = "object ", kWas = "was ", kIs = "is ";
constexpr std::int64_t kPieces = 4096;  // that numbers have room for
using Bytes = std::vector<std::byte>;

// ---- Writing

Json numbers_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json pose_json(const Pose& pose) {
    const Quat& q = pose.orientation;
    return {{"position_m", numbers_json(pose.position_m)}, {"orientation", Json::array({q.w, q.x, q.y, q.z})}};
}

Json path_json(const PathMotion& path) {
    Json keys = Json::array();
    for (const PathKey& key : path.keys) {
        Json one = pose_json(key.pose);
        one["time_s"] = key.time_s;
        keys.push_back(std::move(one));
    }
    return {{"repeats", path.repeats}, {"about_m", numbers_json(path.about_m)}, {"keys", std::move(keys)}};
}

void add_bytes(Bytes& to, std::span<const std::byte> bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

void put_pieces(const Bytes& bytes, const char* kind, std::int64_t number, Pages& pages) {
    std::int64_t piece = number * kPieces;
    for (std::size_t at = 0; at < bytes.size(); at += kMostPieceBytes) {
        const auto part = std::span(bytes).subspan(at, std::min(kMostPieceBytes, bytes.size() - at));
        pages.pages[{kind, piece++}] = Bytes(part.begin(), part.end());
    }
}

Bytes mesh_bytes(const geometry::TriangleMesh& mesh) {
    Bytes bytes;
    const std::array<std::uint64_t, 2> counts{mesh.positions_m.size(), mesh.triangles.size()};
    add_bytes(bytes, std::as_bytes(std::span(counts)));
    add_bytes(bytes, std::as_bytes(std::span(mesh.positions_m)));
    add_bytes(bytes, std::as_bytes(std::span(mesh.triangles)));
    return bytes;
}

// ---- Reading

// Values of a page; one that is not there, or of another kind, makes the page unsound.
class ReadValues {
public:
    explicit ReadValues(const Json& json) : json_(json) {}

    [[nodiscard]] bool sound() const { return sound_; }
    double number(const char* key) { return number_in(json_.contains(key) ? json_[key] : Json()); }
    bool yes(const char* key) {
        const Json* value = find_value(json_, std::string("/") + key);
        sound_ = sound_ && value != nullptr && value->is_boolean();
        return sound_ && value->get<bool>();
    }
    std::string text(const char* key) {
        const Json* value = find_value(json_, std::string("/") + key);
        sound_ = sound_ && value != nullptr && value->is_string();
        return sound_ ? value->get<std::string>() : std::string();
    }
    template <std::size_t count>
    std::array<double, count> numbers(const char* key) {
        std::array<double, count> list{};
        const Json* value = find_value(json_, std::string("/") + key);
        sound_ = sound_ && value != nullptr && value->is_array() && value->size() == count;
        for (std::size_t i = 0; sound_ && i < count; ++i) list[i] = number_in((*value)[i]);
        return list;
    }
    Vec3 vector(const char* key) {
        const auto n = numbers<3>(key);
        return {n[0], n[1], n[2]};
    }
    Pose pose() {
        const auto q = numbers<4>("orientation");
        return {vector("position_m"), {q[0], q[1], q[2], q[3]}};
    }

private:
    double number_in(const Json& value) {
        sound_ = sound_ && value.is_number() && std::isfinite(value.get<double>());
        return sound_ ? value.get<double>() : 0.0;
    }
    const Json& json_;
    bool sound_ = true;
};

std::optional<PathMotion> path_in(const Json& json) {
    if (!json.is_object()) return {};
    ReadValues values(json);
    PathMotion path{.keys = {}, .repeats = values.yes("repeats"), .about_m = values.vector("about_m")};
    const Json* keys = find_value(json, "/keys");
    if (!values.sound() || keys == nullptr || !keys->is_array() || keys->size() > kMaxPathKeys) return {};
    for (const Json& one : *keys) {
        if (!one.is_object()) return {};
        ReadValues key(one);
        path.keys.push_back({key.number("time_s"), key.pose()});
        if (!key.sound()) return {};
    }
    return path;
}

struct ReadObject {
    SceneObject object;
    std::int64_t mesh = 0;
    bool has_colours = false;
};

std::optional<ReadObject> object_in(const Bytes& bytes, ObjectId id) {
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const Json json = Json::parse(text, text + bytes.size(), nullptr, false);
    if (json.is_discarded() || !json.is_object()) return {};
    ReadValues values(json);
    const Json* felt_as = find_value(json, "/material");
    if (felt_as == nullptr || !felt_as->is_object()) return {};
    ReadValues material(*felt_as);
    ReadObject read;
    SceneObject& object = read.object;
    object.id = id;
    object.name = values.text("name");
    object.pose = values.pose();
    object.scale = values.number("scale");
    object.pivot_m = values.vector("pivot_m");
    object.seen = values.yes("seen");
    object.felt = values.yes("felt");
    const auto colour = values.numbers<3>("colour");
    if (!std::ranges::all_of(colour, [](double part) { return part >= 0.0 && part <= 255.0; })) return {};
    for (std::size_t k = 0; k < 3; ++k) object.colour[k] = static_cast<std::uint8_t>(colour[k]);
    object.opacity = values.number("opacity");
    object.both_sides = values.yes("both_sides");
    object.material = {material.number("stiffness_N_per_m"), material.number("damping_Ns_per_m"),
                       material.number("static_friction"), material.number("dynamic_friction"),
                       material.number("coulomb_velocity_m_per_s")};
    const double mesh = values.number("mesh");
    read.has_colours = values.yes("own_colours");
    if (!values.sound() || !material.sound() || !(mesh >= 0.0 && mesh < double{kMaxWorldObjects})) return {};
    read.mesh = static_cast<std::int64_t>(mesh);
    if (const Json* path = find_value(json, "/path")) {
        auto motion = path_in(*path);
        if (!motion) return {};
        object.motion = std::move(*motion);
    }
    const auto is_near = [&](const Vec3& at) { return glm::length(at) <= 2.0 * kMaxDistance_m; };
    const auto* path = std::get_if<PathMotion>(&object.motion);
    if (!is_near(object.scale * object.pivot_m) || (path != nullptr && !is_near(path->about_m))) return {};
    if (!problems(object).empty()) return {};
    return read;
}

// Returns the pieces of one page, one behind the other; nothing where there is none.
Bytes joined_pieces(const Pages& pages, const char* kind, std::int64_t number) {
    Bytes all;
    for (std::int64_t piece = number * kPieces; piece < (number + 1) * kPieces; ++piece) {
        const Bytes* bytes = pages.find({kind, piece});
        if (bytes == nullptr) break;
        all.insert(all.end(), bytes->begin(), bytes->end());
    }
    return all;
}

std::shared_ptr<const geometry::TriangleMesh> mesh_in(const Bytes& bytes) {
    std::array<std::uint64_t, 2> counts{};
    if (bytes.size() < sizeof counts) return {};
    std::memcpy(counts.data(), bytes.data(), sizeof counts);
    const std::size_t most = bytes.size() / 4;
    if (counts[0] > most || counts[1] > most || counts[1] > kMaxWorldTriangles) return {};
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    mesh->positions_m.resize(counts[0]);
    mesh->triangles.resize(counts[1]);
    const std::size_t of_positions = counts[0] * sizeof(Vec3), of_triangles = counts[1] * sizeof mesh->triangles[0];
    if (bytes.size() != sizeof counts + of_positions + of_triangles) return {};
    if (of_positions > 0) std::memcpy(mesh->positions_m.data(), bytes.data() + sizeof counts, of_positions);
    if (of_triangles > 0)
        std::memcpy(mesh->triangles.data(), bytes.data() + sizeof counts + of_positions, of_triangles);
    const auto is_vertex = [&](std::uint32_t index) { return index < counts[0]; };
    const bool are_vertices = std::ranges::all_of(
        mesh->triangles, [&](const auto& triangle) { return std::ranges::all_of(triangle, is_vertex); });
    if (!are_vertices || !std::ranges::all_of(mesh->positions_m, [](const Vec3& p) { return finite(p); })) return {};
    return mesh;
}

std::shared_ptr<const CornerColours> colours_in(const Bytes& bytes, std::size_t triangles) {
    if (triangles == 0 || bytes.size() != triangles * sizeof(CornerColours::value_type)) return {};
    auto colours = std::make_shared<CornerColours>(triangles);
    std::memcpy(colours->data(), bytes.data(), bytes.size());
    return colours;
}

// Whether a session can open it.
bool is_sound(const SceneObject& object) { return !object.felt || can_be_touched(object); }

// What stands for an object that is lost.
SceneObject lost_object(ObjectId id) {
    static const auto empty = std::make_shared<const geometry::TriangleMesh>();
    return {.id = id,
            .name = "lost-" + std::to_string(id),
            .mesh = empty,
            .pose = {},
            .seen = false,
            .felt = false,
            .material = {},
            .motion = {}};
}

// Reads the values of an object from a page of this kind and its number, "object 3"; nothing where the page is damaged,
// or the object is none of these.
std::optional<SceneObject> object_named(const PageName& name, std::string_view kind, const Bytes& bytes,
                                        std::span<const SceneObject> objects,
                                        std::span<const std::shared_ptr<const CornerColours>> colours) {
    ObjectId id = 0;
    if (name.kind.starts_with(kind))
        std::from_chars(name.kind.data() + kind.size(), name.kind.data() + name.kind.size(), id);
    std::optional<ReadObject> read = id >= 1 && id <= objects.size() ? object_in(bytes, id) : std::nullopt;
    if (!read) return std::nullopt;
    const SceneObject& before = objects[id - 1];
    read->object.mesh = before.mesh;
    read->object.name = before.name;
    if (read->has_colours) read->object.corner_colours = colours[id - 1];
    if (!is_sound(read->object)) read->object.seen = read->object.felt = false;
    return std::move(read->object);
}

}  // namespace

std::vector<std::byte> object_bytes(const SceneObject& object, std::size_t mesh) {
    const HapticMaterial& m = object.material;
    Json json = pose_json(object.pose);
    json["name"] = object.name;
    json["mesh"] = mesh;
    json["scale"] = object.scale;
    json["pivot_m"] = numbers_json(object.pivot_m);
    json["seen"] = object.seen;
    json["felt"] = object.felt;
    json["colour"] = Json::array({object.colour[0], object.colour[1], object.colour[2]});
    json["own_colours"] = object.corner_colours != nullptr;
    json["opacity"] = object.opacity;
    json["both_sides"] = object.both_sides;
    json["material"] = {{"stiffness_N_per_m", m.stiffness_N_per_m},
                        {"damping_Ns_per_m", m.damping_Ns_per_m},
                        {"static_friction", m.static_friction},
                        {"dynamic_friction", m.dynamic_friction},
                        {"coulomb_velocity_m_per_s", m.coulomb_velocity_m_per_s}};
    if (const auto* path = std::get_if<PathMotion>(&object.motion)) json["path"] = path_json(*path);
    const std::string text = json_text(json);
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

std::vector<std::size_t> mesh_numbers(std::span<const geometry::TriangleMesh* const> meshes) {
    std::map<const geometry::TriangleMesh*, std::size_t> numbers;
    std::vector<std::size_t> of_objects;
    for (const geometry::TriangleMesh* mesh : meshes)
        of_objects.push_back(numbers.try_emplace(mesh, numbers.size()).first->second);
    return of_objects;
}

void save_object(const SceneObject& object, const CornerColours* of_file, std::size_t mesh,
                 std::vector<std::byte> values, Pages& pages) {
    const auto id = static_cast<std::int64_t>(object.id), number = static_cast<std::int64_t>(mesh);
    pages.pages[{kObject, id}] = std::move(values);
    if (!pages.whole) return;
    if (pages.find({kMesh, number * kPieces}) == nullptr) put_pieces(mesh_bytes(*object.mesh), kMesh, number, pages);
    if (of_file == nullptr) return;
    Bytes colours;
    add_bytes(colours, std::as_bytes(std::span(*of_file)));
    put_pieces(colours, kColours, id, pages);
}

Result<LoadedObjects> load_objects(const Pages& pages, const std::string& where) {
    std::int64_t last = 0;
    for (const auto& [name, bytes] : pages.pages)
        if (name.kind == kObject) last = std::max(last, name.number);
    for (const PageName& name : pages.damaged)
        if (name.kind == kObject) last = std::max(last, name.number);
    if (last > static_cast<std::int64_t>(kMaxWorldObjects))
        return fail(where, "has an object of the number " + std::to_string(last),
                    "open it with the program that has saved it");
    LoadedObjects loaded;
    std::map<std::int64_t, std::shared_ptr<const geometry::TriangleMesh>> meshes;
    std::set<std::string> names;
    std::size_t lost = 0, bare = 0;
    for (std::int64_t number = 1; number <= last; ++number) {
        const auto id = static_cast<ObjectId>(number);
        const Bytes* bytes = pages.find({kObject, number});
        std::optional<ReadObject> read = bytes != nullptr ? object_in(*bytes, id) : std::nullopt;
        if (read && !meshes.contains(read->mesh)) meshes[read->mesh] = mesh_in(joined_pieces(pages, kMesh, read->mesh));
        if (read) read->object.mesh = meshes[read->mesh];
        const bool is_whole =
            read && read->object.mesh && is_sound(read->object) && names.insert(read->object.name).second;
        auto& colours = loaded.colours.emplace_back();
        if (is_whole) colours = colours_in(joined_pieces(pages, kColours, number), read->object.mesh->triangles.size());
        if (is_whole && read->has_colours) {
            read->object.corner_colours = colours;
            bare += colours == nullptr ? 1 : 0;
        }
        lost += is_whole ? 0 : 1;
        loaded.objects.push_back(is_whole ? std::move(read->object) : lost_object(id));
    }
    if (lost == loaded.objects.size())
        return fail(where, last == 0 ? "has no object" : "none of its objects can be read",
                    "open an earlier copy of the file");
    const auto counted = [](std::size_t count) {
        return std::to_string(count) + (count == 1 ? " object" : " objects");
    };
    if (lost > 0) loaded.lost = counted(lost) + " cannot be read, and nothing is seen or felt of it";
    if (bare > 0) loaded.lost += (lost > 0 ? "; " : "") + counted(bare) + " lost the colours of its file";
    return loaded;
}

PageName change_of(ObjectId id) { return {std::string(kChanged) + std::to_string(id), 0}; }

Result<void> apply_change(std::vector<SceneObject>& objects,
                          std::span<const std::shared_ptr<const CornerColours>> colours, const Pages& change,
                          const std::string& where) {
    std::vector<SceneObject> changed;
    for (const auto& [name, bytes] : change.pages) {
        std::optional<SceneObject> object = object_named(name, kChanged, bytes, objects, colours);
        if (!object) return fail(where, "a change of an object is damaged", "what was before it opens");
        changed.push_back(std::move(*object));
    }
    for (SceneObject& object : changed) objects[object.id - 1] = std::move(object);
    return {};
}

void save_step(const ObjectStep& step, std::int64_t number, std::size_t mesh,
               std::map<PageName, std::vector<std::byte>>& pages) {
    const std::string id = std::to_string(step.before->id);
    pages[{std::string(kWas) + id, number}] = object_bytes(*step.before, mesh);
    pages[{std::string(kIs) + id, number}] = object_bytes(*step.after, mesh);
}

Result<ObjectStep> step_in(std::span<const SceneObject> objects,
                           std::span<const std::shared_ptr<const CornerColours>> colours, const Pages& step,
                           const std::string& where) {
    ObjectStep read;
    for (const auto& [name, bytes] : step.pages) {
        auto& into = name.kind.starts_with(kWas) ? read.before : read.after;
        std::optional<SceneObject> object =
            object_named(name, name.kind.starts_with(kWas) ? kWas : kIs, bytes, objects, colours);
        if (!object || into) return fail(where, "a step of undo is damaged");
        into = std::make_shared<const SceneObject>(std::move(*object));
    }
    if (!read.before || !read.after || read.before->id != read.after->id)
        return fail(where, "a step of undo is damaged");
    return read;
}

}  // namespace burin::scene

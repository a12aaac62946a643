// SPDX-License-Identifier: MIT
#include "geometry/files/glb_skin.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "base/file_io.hpp"
#include "base/json.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "geometry/files/mesh_import.hpp"

namespace burin::geometry {
namespace {

constexpr const char* kExportAgain = "export it again as binary glTF 2.0";
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::uint64_t kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;  // component types of accessors
constexpr std::uint64_t kTriangles = 4;                                           // mode of a primitive
constexpr double kWeightSlack = 1e-3, kRigidSlack = 1e-3;

std::uint32_t word_at(std::span<const std::byte> bytes, std::uint64_t at) {
    std::uint32_t word = 0;
    for (std::uint64_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return word;
}

// Returns a whole number at a key; none where there is no such thing.
std::optional<std::uint64_t> number_at(const Json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::uint64_t>();
}

// Returns an element of an array at a key of the file's; null where there is none.
const Json* element_of(const Json& file, const char* key, std::optional<std::uint64_t> index) {
    const auto list = file.find(key);
    if (!index || list == file.end() || !list->is_array() || *index >= list->size()) return nullptr;
    return &(*list)[*index];
}

const Json* array_at(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? &*found : nullptr;
}

// The two parts of the file.
struct Chunks {
    Json json;
    std::span<const std::byte> binary;
};

Result<Chunks> chunks_of(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() < 12 || word_at(bytes, 0) != kMagic) return fail(name, "is no binary glTF", "name a .glb file");
    if (word_at(bytes, 4) != 2)
        return fail(name, formatted("is glTF %u", word_at(bytes, 4)), "export it again as glTF 2.0");
    const std::uint64_t length = word_at(bytes, 8);
    if (length > bytes.size())
        return fail(name,
                    formatted("says that it has %llu bytes, and there are %zu", static_cast<unsigned long long>(length),
                              bytes.size()),
                    "it was cut off: copy it again");
    Chunks chunks;
    bool has_json = false, has_binary = false;
    for (std::uint64_t at = 12; at + 8 <= length;) {
        const std::uint64_t size = word_at(bytes, at);
        const std::uint32_t kind = word_at(bytes, at + 4);
        at += 8;
        if (size > length - at)
            return fail(name,
                        formatted("byte %llu: a part of %llu bytes reaches beyond the end",
                                  static_cast<unsigned long long>(at), static_cast<unsigned long long>(size)),
                        "it was cut off: copy it again");
        if (kind == kJsonChunk && !has_json) {
            const auto* text = reinterpret_cast<const char*>(bytes.data() + at);
            chunks.json = Json::parse(text, text + size, nullptr, false);
            has_json = true;
        } else if (kind == kBinaryChunk && !has_binary) {
            chunks.binary = bytes.subspan(at, size);
            has_binary = true;
        }
        at += size;
    }
    if (!has_json || !chunks.json.is_object()) return fail(name, "its JSON part is missing or unsound", kExportAgain);
    if (!has_binary) return fail(name, "has no binary part", "export it with its data inside, as .glb");
    return chunks;
}

// Reads the accessors of a file: arrays of numbers of a known kind.
class Accessors {
public:
    Accessors(const Chunks& chunks, const std::string& name) : chunks_(chunks), name_(name) {}

    struct View {
        std::span<const std::byte> bytes;  // from the first element on
        std::uint64_t count = 0, stride = 0, kind = 0;
    };
    // Returns the elements of `what`, each of so many components of the type that `of` says.
    [[nodiscard]] Result<View> view(std::optional<std::uint64_t> index, const char* what, const char* type,
                                    std::uint64_t components, std::initializer_list<std::uint64_t> kinds) const {
        const Json* accessor = element_of(chunks_.json, "accessors", index);
        if (accessor == nullptr || !accessor->is_object()) return wrong(what, "are missing");
        if (accessor->contains("sparse")) return wrong(what, "are sparse");
        const Json* buffer = element_of(chunks_.json, "bufferViews", number_at(*accessor, "bufferView"));
        if (buffer == nullptr || !buffer->is_object()) return wrong(what, "have no bytes");
        if (number_at(*buffer, "buffer").value_or(0) != 0) return wrong(what, "lie in another file");
        View view;
        view.kind = number_at(*accessor, "componentType").value_or(0);
        bool known = false;
        for (const std::uint64_t kind : kinds) known = known || kind == view.kind;
        const auto type_of = accessor->find("type");
        const bool typed = type_of != accessor->end() && type_of->is_string() && *type_of == type;
        if (!known || !typed) return wrong(what, "are of a kind that is not read here");
        view.count = number_at(*accessor, "count").value_or(0);
        const std::uint64_t size = components * (view.kind == kByte ? 1 : view.kind == kShort ? 2 : 4);
        view.stride = number_at(*buffer, "byteStride").value_or(size);
        const std::uint64_t from = number_at(*buffer, "byteOffset").value_or(0),
                            length = number_at(*buffer, "byteLength").value_or(0),
                            first = number_at(*accessor, "byteOffset").value_or(0);
        const std::uint64_t all = chunks_.binary.size();
        if (from > all || length > all - from || first > length || view.stride < size || view.stride > 255)
            return wrong(what, "reach beyond the file's bytes");
        if (view.count == 0) return wrong(what, "are none");
        const std::uint64_t room = length - first;
        if (room < size || (room - size) / view.stride < view.count - 1)
            return wrong(what, "are more than the file's bytes hold");
        view.bytes = chunks_.binary.subspan(from + first, room);
        return view;
    }
    [[nodiscard]] static double float_in(const View& view, std::uint64_t element, std::uint64_t component) {
        return std::bit_cast<float>(word_at(view.bytes, element * view.stride + 4 * component));
    }
    [[nodiscard]] static std::uint32_t whole_in(const View& view, std::uint64_t element, std::uint64_t component) {
        const std::uint64_t at = element * view.stride;
        if (view.kind == kInt) return word_at(view.bytes, at + 4 * component);
        if (view.kind == kByte) return std::to_integer<std::uint32_t>(view.bytes[at + component]);
        const auto low = std::to_integer<std::uint32_t>(view.bytes[at + 2 * component]),
                   high = std::to_integer<std::uint32_t>(view.bytes[at + 2 * component + 1]);
        return low | high << 8;
    }
    [[nodiscard]] std::unexpected<Error> wrong(const std::string& what, const char* how) const {
        return fail(name_, what + " " + how, kExportAgain);
    }

private:
    const Chunks& chunks_;
    const std::string& name_;
};

// The one primitive that wears the skin.
struct Worn {
    const Json* skin = nullptr;
    const Json* primitive = nullptr;
};

Result<Worn> worn_in(const Json& file, const std::string& name) {
    const Json* nodes = array_at(file, "nodes");
    Worn worn;
    for (std::size_t i = 0; nodes != nullptr && i < nodes->size(); ++i) {
        const Json& node = (*nodes)[i];
        const Json* skin = element_of(file, "skins", number_at(node, "skin"));
        const Json* mesh = element_of(file, "meshes", number_at(node, "mesh"));
        if (skin == nullptr || mesh == nullptr || !skin->is_object() || !mesh->is_object()) continue;
        const Json* primitives = array_at(*mesh, "primitives");
        if (worn.skin != nullptr || primitives == nullptr || primitives->size() != 1 || !(*primitives)[0].is_object())
            return fail(name, "wears its skin in several pieces", "join them into one mesh with one material");
        worn = {skin, &(*primitives)[0]};
    }
    if (worn.skin == nullptr) return fail(name, "no mesh of it has a skin", "export the mesh with its armature");
    return worn;
}

// Returns the joint's pose at rest, of which the file has the inverse as a matrix; none where that is no rigid motion.
std::optional<Pose> rest_of(const Accessors::View& matrices, std::uint64_t joint) {
    Mat4 joint_from_mesh(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            joint_from_mesh[column][row] =
                Accessors::float_in(matrices, joint, static_cast<std::uint64_t>(4 * column + row));
    const glm::dmat3 turn(joint_from_mesh);
    const glm::dmat3 square = glm::transpose(turn) * turn;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(square[column][row] - (column == row ? 1.0 : 0.0)) <= kRigidSlack)) return std::nullopt;
    if (!(glm::determinant(turn) > 0.0) || !finite(Vec3(joint_from_mesh[3]))) return std::nullopt;
    const Quat back = glm::conjugate(glm::normalize(glm::quat_cast(turn)));
    return Pose{-(back * Vec3(joint_from_mesh[3])), back};
}

class SkinReader {
public:
    SkinReader(const Chunks& chunks, const Worn& worn, const std::string& name)
        : chunks_(chunks), worn_(worn), name_(name), accessors_(chunks, name) {}

    [[nodiscard]] Result<SkinnedMesh> read() {
        Result<void> done = read_joints();
        if (done) done = read_positions();
        if (done) done = read_bindings();
        if (done) done = read_triangles();
        if (!done) return std::unexpected(done.error());
        return std::move(mesh_);
    }

private:
    [[nodiscard]] Result<void> read_joints() {
        const Json* joints = array_at(*worn_.skin, "joints");
        if (joints == nullptr || joints->empty()) return accessors_.wrong("the skin's joints", "are missing");
        const auto matrices = accessors_.view(number_at(*worn_.skin, "inverseBindMatrices"),
                                              "the skin's inverse bind matrices", "MAT4", 16, {kFloat});
        if (!matrices) return std::unexpected(matrices.error());
        if (matrices->count != joints->size())
            return accessors_.wrong("the skin's inverse bind matrices", "are not as many as its joints");
        for (std::size_t i = 0; i < joints->size(); ++i) {
            const Json& number = (*joints)[i];
            const Json* node =
                number.is_number_unsigned() ? element_of(chunks_.json, "nodes", number.get<std::uint64_t>()) : nullptr;
            if (node == nullptr || !node->is_object())
                return accessors_.wrong("joint " + std::to_string(i), "is no node of the file");
            const auto named = node->find("name");
            SkinJoint joint;
            if (named != node->end() && named->is_string()) joint.name = named->get<std::string>();
            const auto rest = rest_of(*matrices, i);
            if (!rest) return accessors_.wrong("joint " + std::to_string(i), "is stretched or not finite at rest");
            joint.mesh_from_joint = *rest;
            mesh_.joints.push_back(std::move(joint));
        }
        return {};
    }

    [[nodiscard]] std::optional<std::uint64_t> attribute(const char* of) const {
        const auto attributes = worn_.primitive->find("attributes");
        return attributes != worn_.primitive->end() ? number_at(*attributes, of) : std::nullopt;
    }

    [[nodiscard]] Result<void> read_positions() {
        BURIN_TRY(view, accessors_.view(attribute("POSITION"), "the positions", "VEC3", 3, {kFloat}));
        mesh_.positions_m.reserve(view.count);
        for (std::uint64_t i = 0; i < view.count; ++i) {
            const Vec3 p{Accessors::float_in(view, i, 0), Accessors::float_in(view, i, 1),
                         Accessors::float_in(view, i, 2)};
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(p[axis]) <= kMaxCoordinate))
                    return accessors_.wrong("position " + std::to_string(i), "is not finite, or too far away");
            mesh_.positions_m.push_back(p);
        }
        return {};
    }

    [[nodiscard]] Result<void> read_bindings() {
        const auto joints =
            accessors_.view(attribute("JOINTS_0"), "the vertices' joints", "VEC4", kInfluences, {kByte, kShort});
        if (!joints) return std::unexpected(joints.error());
        const auto weights =
            accessors_.view(attribute("WEIGHTS_0"), "the vertices' weights", "VEC4", kInfluences, {kFloat});
        if (!weights) return std::unexpected(weights.error());
        const std::size_t count = mesh_.positions_m.size();
        if (joints->count != count || weights->count != count)
            return accessors_.wrong("the vertices' joints and weights", "are not as many as the positions");
        mesh_.bindings.resize(count);
        for (std::size_t i = 0; i < count; ++i) BURIN_TRY_DO(read_binding(*joints, *weights, i));
        return {};
    }

    [[nodiscard]] Result<void> read_binding(const Accessors::View& joints, const Accessors::View& weights,
                                            std::size_t i) {
        SkinBinding& binding = mesh_.bindings[i];
        double sum = 0.0;
        for (std::size_t k = 0; k < kInfluences; ++k) {
            const double weight = Accessors::float_in(weights, i, k);
            if (!(weight >= 0.0 && weight <= 2.0))
                return accessors_.wrong("a weight of vertex " + std::to_string(i), "is below 0, or no number");
            const std::uint32_t joint = Accessors::whole_in(joints, i, k);
            if (weight > 0.0 && joint >= mesh_.joints.size())
                return accessors_.wrong("vertex " + std::to_string(i), "follows a joint that there is not");
            binding.joints[k] = static_cast<std::uint16_t>(weight > 0.0 ? joint : 0);
            binding.weights[k] = weight;
            sum += weight;
        }
        if (!(std::abs(sum - 1.0) <= kWeightSlack))
            return fail(name_, formatted("the weights of vertex %zu add up to %g, not to 1", i, sum),
                        "normalise them, and export it again");
        for (double& weight : binding.weights) weight /= sum;
        return {};
    }

    [[nodiscard]] Result<void> read_triangles() {
        if (number_at(*worn_.primitive, "mode").value_or(kTriangles) != kTriangles)
            return accessors_.wrong("the faces", "are no triangles");
        BURIN_TRY(view, accessors_.view(number_at(*worn_.primitive, "indices"), "the triangles' corners", "SCALAR", 1,
                                        {kByte, kShort, kInt}));
        if (view.count % 3 != 0) return accessors_.wrong("the triangles' corners", "are no multiple of three");
        mesh_.triangles.resize(view.count / 3);
        for (std::uint64_t i = 0; i < view.count; ++i) {
            const std::uint32_t vertex = Accessors::whole_in(view, i, 0);
            if (vertex >= mesh_.positions_m.size())
                return accessors_.wrong("triangle " + std::to_string(i / 3), "has a corner that there is not");
            mesh_.triangles[i / 3][i % 3] = vertex;
        }
        return {};
    }

    const Chunks& chunks_;
    const Worn& worn_;
    const std::string& name_;
    Accessors accessors_;
    SkinnedMesh mesh_;
};

}  // namespace

Result<SkinnedMesh> read_skinned_glb(std::span<const std::byte> bytes, const std::string& name) {
    BURIN_TRY(chunks, chunks_of(bytes, name));
    BURIN_TRY(worn, worn_in(chunks.json, name));
    return SkinReader(chunks, worn, name).read();
}

Result<SkinnedMesh> read_skinned_glb(const std::filesystem::path& path) {
    BURIN_TRY(bytes, read_file(path));
    return read_skinned_glb(bytes, path.string());
}

}  // namespace burin::geometry

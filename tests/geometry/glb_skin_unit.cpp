// SPDX-License-Identifier: MIT
#include "geometry/files/glb_skin.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <set>

#include "base/file_io.hpp"
#include "base/json.hpp"

namespace burin::geometry {
namespace {

std::vector<std::byte> bytes_of_hand() {
    auto bytes = read_file("assets/hands/right.glb");
    return bytes ? std::move(*bytes) : std::vector<std::byte>{};
}

void put_word(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t word) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(word >> (8 * i));
}

std::uint32_t taken_word(const std::vector<std::byte>& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, 4);
    return word;
}

// A file of two parts, as glTF 2.0 lays them out.
std::vector<std::byte> glb_of(const Json& json, std::span<const std::byte> binary) {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> bytes(28 + text.size() + binary.size());
    put_word(bytes, 0, 0x46546C67);
    put_word(bytes, 4, 2);
    put_word(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
    put_word(bytes, 12, static_cast<std::uint32_t>(text.size()));
    put_word(bytes, 16, 0x4E4F534A);
    std::memcpy(bytes.data() + 20, text.data(), text.size());
    put_word(bytes, 20 + text.size(), static_cast<std::uint32_t>(binary.size()));
    put_word(bytes, 24 + text.size(), 0x004E4942);
    std::memcpy(bytes.data() + 28 + text.size(), binary.data(), binary.size());
    return bytes;
}

struct Parts {
    Json json;
    std::vector<std::byte> binary;
};
Parts parts_of_hand() {
    const std::vector<std::byte> bytes = bytes_of_hand();
    const std::size_t text = taken_word(bytes, 12);
    const auto* from = reinterpret_cast<const char*>(bytes.data() + 20);
    return {Json::parse(from, from + text), {bytes.begin() + static_cast<std::ptrdiff_t>(28 + text), bytes.end()}};
}

std::string error_of(std::span<const std::byte> bytes) {
    const auto mesh = read_skinned_glb(bytes, "hand.glb");
    if (mesh) return "none";
    EXPECT_FALSE(mesh.error().remedy.empty());
    EXPECT_EQ(mesh.error().where, "hand.glb");
    return mesh.error().what;
}

TEST(GlbSkin, ReadsTheHand) {
    const auto mesh = read_skinned_glb(std::filesystem::path("assets/hands/right.glb"));
    ASSERT_TRUE(mesh) << mesh.error().line();
    EXPECT_EQ(mesh->positions_m.size(), 1360u);
    EXPECT_EQ(mesh->triangles.size(), 2314u);
    EXPECT_EQ(mesh->joints.size(), 25u);
    // The joints' places stand in the file a second time, as its nodes' translations.
    const Parts parts = parts_of_hand();
    for (std::size_t i = 0; i < mesh->joints.size(); ++i) {
        const Json& node = parts.json["nodes"][i];
        EXPECT_EQ(mesh->joints[i].name, node["name"].get<std::string>());
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(mesh->joints[i].mesh_from_joint.position_m[axis],
                        node["translation"][static_cast<std::size_t>(axis)].get<double>(), 1e-6);
        const Json& q = node["rotation"];
        const Quat turn(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>());
        EXPECT_NEAR(std::abs(glm::dot(turn, mesh->joints[i].mesh_from_joint.orientation)), 1.0, 1e-6);
    }
}

TEST(GlbSkin, RefusesAFileThatIsCutOffAnywhere) {
    const std::vector<std::byte> bytes = bytes_of_hand();
    for (std::size_t size = 0; size < bytes.size(); size += 97)
        EXPECT_NE(error_of(std::span(bytes).first(size)), "none") << size;
}

TEST(GlbSkin, RefusesSizesThatLie) {
    for (const std::size_t at : {8u, 12u}) {
        std::vector<std::byte> bytes = bytes_of_hand();
        put_word(bytes, at, 0xfffffff0u);
        EXPECT_NE(error_of(bytes), "none") << at;
    }
    const Parts parts = parts_of_hand();
    for (const std::uint64_t lie : {std::uint64_t{1} << 63, std::uint64_t{100'000'000}, ~std::uint64_t{0}})
        for (const char* list : {"accessors", "bufferViews"})
            for (std::size_t i = 0; i < parts.json[list].size(); ++i)
                for (const char* key : {"count", "byteLength", "byteOffset", "bufferView"}) {
                    Json json = parts.json;
                    const bool is_read = i != 1 && i != 2;  // normals and texture coordinates are left alone
                    const bool own_key = json[list][i].contains(key);
                    if (!own_key || !is_read) continue;
                    json[list][i][key] = lie;
                    EXPECT_NE(error_of(glb_of(json, parts.binary)), "none") << list << " " << i << " " << key;
                }
}

TEST(GlbSkin, RefusesWeightsThatDoNotAddUp) {
    Parts parts = parts_of_hand();
    const auto at = parts.json["bufferViews"][4]["byteOffset"].get<std::size_t>() + 16u * 77u;
    put_word(parts.binary, at, std::bit_cast<std::uint32_t>(0.25f));
    for (std::size_t k = 1; k < 4; ++k) put_word(parts.binary, at + 4 * k, std::bit_cast<std::uint32_t>(0.0f));
    EXPECT_EQ(error_of(glb_of(parts.json, parts.binary)), "the weights of vertex 77 add up to 0.25, not to 1");
    put_word(parts.binary, at, std::bit_cast<std::uint32_t>(NAN));
    EXPECT_EQ(error_of(glb_of(parts.json, parts.binary)), "a weight of vertex 77 is below 0, or no number");
}

TEST(GlbSkin, RefusesAJointAndACornerThatThereAreNot) {
    Parts parts = parts_of_hand();
    const auto joints_at = parts.json["bufferViews"][3]["byteOffset"].get<std::size_t>();
    Parts wrong = parts;
    for (std::size_t k = 0; k < 4; ++k) wrong.binary[joints_at + k] = std::byte{99};
    EXPECT_EQ(error_of(glb_of(wrong.json, wrong.binary)), "vertex 0 follows a joint that there is not");
    wrong = parts;
    const auto corners_at = parts.json["bufferViews"][5]["byteOffset"].get<std::size_t>();
    wrong.binary[corners_at] = wrong.binary[corners_at + 1] = std::byte{0xff};
    EXPECT_EQ(error_of(glb_of(wrong.json, wrong.binary)), "triangle 0 has a corner that there is not");
}

TEST(GlbSkin, RefusesAMeshWithoutASkin) {
    const Parts parts = parts_of_hand();
    Json json = parts.json;
    json.erase("skins");
    EXPECT_EQ(error_of(glb_of(json, parts.binary)), "no mesh of it has a skin");
    json = parts.json;
    json["nodes"] = 7;
    EXPECT_EQ(error_of(glb_of(json, parts.binary)), "no mesh of it has a skin");
    EXPECT_EQ(error_of(glb_of(Json::array(), parts.binary)), "its JSON part is missing or unsound");
}

TEST(GlbSkin, RefusesAStretchedJoint) {
    Parts parts = parts_of_hand();
    const auto at = parts.json["bufferViews"][6]["byteOffset"].get<std::size_t>() + 64u * 3u;
    put_word(parts.binary, at, std::bit_cast<std::uint32_t>(2.0f));
    EXPECT_EQ(error_of(glb_of(parts.json, parts.binary)), "joint 3 is stretched or not finite at rest");
}

}  // namespace
}  // namespace burin::geometry

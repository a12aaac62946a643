// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Rgb = std::array<std::uint8_t, 3>;

Result<ImportedMesh> import_off(std::string_view text) { return import_text(text, MeshFormat::off); }
std::string refused_off(const std::string& text) { return refusal(text, MeshFormat::off); }

const std::string kPlainOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(OffImport, ReadsCommentsCarriageReturnsAndFacesOfAnySize) {
    const auto result = import_off(
        "off # a kite\r\n# and an edge\r\n4 3 0\r\n0 0 0 1 0 0\r\n1 1 0 # three\r\n0 1 0\r\n3 0 1 2\r\n4 0 1 2 3\r\n2 "
        "0 1");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(result->report.faces_without_area, 1u);
}

TEST(OffImport, ReadsCountsOnTheFirstLine) { EXPECT_EQ(refused_off("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), ""); }

TEST(OffImport, TurnsFaceColoursIntoMaterials) {
    const auto result = import_off(
        "OFF\n3 5 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2 255 0 0\n3 0 1 2 1.0 0 0 0.5\n3 0 1 2 7\n3 0 1 2 0 0 255 "
        "128\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangle_materials, (std::vector<std::uint8_t>{0, 1, 1, 0, 2}));
    EXPECT_EQ(result->mesh.materials.at(0).colour, Material{}.colour);
    EXPECT_EQ(result->mesh.materials.at(2).colour, (Rgb{0, 0, 255}));
    EXPECT_EQ(result->report.remarks.size(), 1u);  // the colour map index
}

TEST(OffImport, ReadsVertexNormalsColoursAndTexture) {
    const auto result = import_off(
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255 .5 .5\n1 0 0 0 0 1 255 0 0 255 .5 .5\n0 1 0 0 0 1 0 9 0 255 .5 .5\n3 "
        "0 1 2\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.positions_m[2], Vec3(0, 1, 0));
    EXPECT_EQ(result->mesh.colours[2], (Rgb{0, 9, 0}));
    EXPECT_EQ(result->mesh.materials.at(0).colour, (Rgb{255, 0, 0}));
}

TEST(OffImport, RefusesAFileCutAfterAnyWord) {
    for (std::size_t at = 3; at + 2 < kPlainOff.size(); at = kPlainOff.find_first_of(" \n", at + 1)) {
        EXPECT_NE(refused_off(kPlainOff.substr(0, at)), "") << kPlainOff.substr(0, at);
    }
    EXPECT_EQ(refused_off(kPlainOff), "");
}

TEST(OffImport, NamesTheLineOfWhatIsWrong) {
    const auto with = [](const std::string& from, const std::string& to) {
        std::string text = kPlainOff;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_EQ(refused_off(with("3 0 1 2", "3 0 1 3")).substr(0, 11), "test.off:6:");
    EXPECT_EQ(refused_off(with("3 0 1 2", "3 0 1 -1")).substr(0, 11), "test.off:6:");
    EXPECT_EQ(refused_off(with("3 0 1 2", "3 0 1 2 300 0 0")).substr(0, 11), "test.off:6:");
    EXPECT_EQ(refused_off(with("3 0 1 2", "4000000000 0 1 2")).substr(0, 9), "test.off:");
    EXPECT_EQ(refused_off(with("1 0 0", "1 nan 0")).substr(0, 11), "test.off:4:");
    EXPECT_EQ(refused_off(with("1 0 0", "1 0x0 0")).substr(0, 11), "test.off:4:");
    EXPECT_EQ(refused_off(with("3 1 0", "3 x 0")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("3 1 0", "4000000000 1 0")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("3 1 0", "3 18446744073709551615 0")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("OFF", "4OFF")).substr(0, 11), "test.off:1:");
    EXPECT_EQ(refused_off(with("OFF", "OFF BINARY")).substr(0, 11), "test.off:1:");
}

TEST(OffImport, SaysThatTextAfterTheLastFaceWasIgnored) {
    const auto result = import_off(kPlainOff + "1 0\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->report.remarks.size(), 1u);
}

}  // namespace
}  // namespace burin::geometry::test

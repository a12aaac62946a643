// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/files/mesh_files.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

using Corners3 = std::array<std::uint32_t, 3>;
using Rgb = std::array<std::uint8_t, 3>;

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Result<geometry::ImportedMesh> import_obj(std::string_view text) { return import_text(text, MeshFormat::obj); }
std::string refused_obj(const std::string& text) { return refusal(text, MeshFormat::obj); }

TEST(ObjImport, ReadsPositiveNegativeAndForwardIndices) {
    const auto result = import_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3//-1 -2/7 -1/2/5\nv 0 0 1\nf 4 -4 1\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles, (std::vector<Corners3>{{0, 1, 2}, {0, 1, 2}, {3, 0, 0}}));
}

TEST(ObjImport, ReadsCommentsCarriageReturnsJoinedLinesAndOddCase) {
    const auto result = import_obj(
        "# a cube it is not\r\nV 0 0 0 # the origin\r\nv 1 \\\r\n 0 0\r\n\r\n\tv 0 1 0\r\nvn 0 0 1\r\ng part\r\nF 1 2 "
        "\\\n 3");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles, (std::vector<Corners3>{{0, 1, 2}}));
    EXPECT_EQ(result->mesh.positions_m[1], Vec3(1, 0, 0));
    EXPECT_TRUE(result->report.remarks.empty());
}

TEST(ObjImport, KeepsEveryDigitOfADouble) {
    const auto result =
        import_obj("# units m\nv 0.1234567890123456 1e-3 -7.0000000000000009\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.positions_m[0], Vec3(0.1234567890123456, 1e-3, -7.0000000000000009));
}

TEST(ObjImport, KeepsFansAndRepeatedFacesAndRepeatedCorners) {
    const auto result =
        import_obj("v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 3\nf 1 1 3\n");
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.triangles.size(), 5u);
    EXPECT_EQ(result->report.faces_in_file, 5u);
}

TEST(ObjImport, SplitsConvexPolygonsAsFansAndTheOthersByASweep) {
    const auto result = import_obj(
        "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n"  // a square
        "v 1 1 0\nf 1 2 3 5\n"                             // flat at 1 1: a fan would have a triangle without area
        "v 1.5 .5 0\nf 1 2 3 6\n");                        // an arrowhead
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->report.polygons_in_file, 3u);
    EXPECT_EQ(result->report.polygons_fanned, 1u);
    EXPECT_EQ(result->report.polygons_swept, 2u);
    EXPECT_EQ(examine(result->mesh).degenerate_triangles, 0u);
    ASSERT_EQ(result->mesh.triangles.size(), 6u);
    double area = 0.0;  // of the arrowhead: both triangles point up, so the sum is the polygon's own area
    for (std::size_t t = 4; t < 6; ++t) {
        const auto& [a, b, c] = result->mesh.triangles[t];
        const auto& p = result->mesh.positions_m;
        const double z = glm::cross(p[b] - p[a], p[c] - p[a]).z;
        EXPECT_GT(z, 0.0);
        area += z / 2;
    }
    EXPECT_DOUBLE_EQ(area, 1.0);  // shoelace of (0,0) (2,0) (2,2) (1.5,0.5)
}

TEST(ObjImport, TakesMaterialsWithTheirDiffuseColour) {
    const MaterialFileReader library = [](std::string_view name) -> Result<std::string> {
        EXPECT_EQ(name, "paints and more.mtl");
        return "newmtl red one\nKa 0 0 1\nKd 1 0 0\nnewmtl unused\nKd 0 1 0\nNEWMTL grey\nkd 0.5\n";
    };
    const auto bytes = bytes_of(
        std::string(kTriangle) +
        "mtllib paints and more.mtl\nf 1 2 3\nusemtl grey\nf 1 2 3\nusemtl red one\nf 1 2 3\nusemtl lost\nf 1 2 3\n");
    const auto result = geometry::import_mesh(bytes, MeshFormat::obj, "test.obj", library);
    ASSERT_TRUE(result) << result.error().line();
    ASSERT_EQ(result->mesh.materials.size(), 4u);  // the plain one of the first face comes first
    EXPECT_EQ(result->mesh.triangle_materials, (std::vector<std::uint8_t>{0, 1, 2, 3}));
    EXPECT_EQ(result->mesh.materials[0].colour, geometry::Material{}.colour);
    EXPECT_EQ(result->mesh.materials[1].colour, (Rgb{128, 128, 128}));
    EXPECT_EQ(result->mesh.materials[2].name, "red one");
    EXPECT_EQ(result->mesh.materials[2].colour, (Rgb{255, 0, 0}));
    ASSERT_EQ(result->report.remarks.size(), 1u);
    EXPECT_NE(result->report.remarks[0].find("'lost'"), std::string::npos);
}

TEST(ObjImport, FindsTheMaterialFileBesideTheObj) {
    const TemporaryFolder folder;
    folder.write("paint.mtl", "newmtl a\nKd 0 0 1\n");
    const auto obj = folder.write("part.obj", std::string(kTriangle) + "mtllib paint.mtl\nusemtl a\nf 1 2 3\n");
    const auto result = geometry::import_mesh(obj);
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.materials.at(0).colour, (Rgb{0, 0, 255}));
}

TEST(ObjImport, RemarksOnAMissingOrBrokenMaterialFileAndReadsTheShape) {
    const TemporaryFolder folder;
    folder.write("bad.mtl", "newmtl a\nKd nan 0 1\n");
    const auto obj =
        folder.write("part.obj", std::string(kTriangle) + "mtllib gone.mtl\nmtllib bad.mtl\nmtllib .\nf 1 2 3\n");
    const auto result = geometry::import_mesh(obj);
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->report.remarks.size(), 3u);
}

// 256 shades of red in groups of two: of each group the one that more faces have weighs more.
TEST(ObjImport, MergedMaterialsHaveTheMeanColourOfTheirFaces) {
    std::string text(kTriangle), paints;
    for (int shade = 0; shade < 256; ++shade) {
        text += "usemtl m" + std::to_string(shade) + "\nf 1 2 3\n";
        if (shade == 100 || shade == 103) text += "f 1 2 3\nf 1 2 3\n";
        paints += "newmtl m" + std::to_string(shade) + "\nKd " + std::to_string(shade / 255.0) + " 0 0\n";
    }
    const auto result = import_mesh(bytes_of("mtllib p\n" + text), MeshFormat::obj, "test.obj",
                                    [&](std::string_view) -> Result<std::string> { return paints; });
    ASSERT_TRUE(result) << result.error().line();
    ASSERT_EQ(result->mesh.materials.size(), 128u);
    EXPECT_EQ(result->mesh.materials[50].colour, (Rgb{100, 0, 0})) << "100.25 of 100, 100, 100 and 101";
    EXPECT_EQ(result->mesh.materials[51].colour, (Rgb{103, 0, 0})) << "102.75 of 102, 103, 103 and 103";
}

TEST(ObjImport, MergesMoreThan254MaterialsAndSaysSo) {
    std::string text(kTriangle), paints;
    for (int i = 0; i < 600; ++i) {
        text += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
        paints += "newmtl m" + std::to_string(i) + "\nKd " + std::to_string(i / 600.0) + " 0.25 0.75\n";
    }
    const auto result = geometry::import_mesh(bytes_of("mtllib p\n" + text), MeshFormat::obj, "test.obj",
                                              [&](std::string_view) -> Result<std::string> { return paints; });
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_LE(result->mesh.materials.size(), geometry::kMaxMaterials);
    EXPECT_EQ(result->report.materials_merged, 600 - result->mesh.materials.size());
    EXPECT_EQ(result->report.remarks.size(), 1u);
    for (int i = 0; i < 600; ++i) {  // no colour moves by more than the widest group, 4 of 255
        const auto& colour =
            result->mesh.materials[result->mesh.triangle_materials[static_cast<std::size_t>(i)]].colour;
        EXPECT_NEAR(colour[0], 255.0 * i / 600.0, 4.0);
    }
}

TEST(ObjImport, ReadsVertexColoursOfEitherRange) {
    const auto unit = import_obj("v 0 0 0 1 0 0.5\nv 1 0 0 1 0 0.5\nv 0 1 0 0 0 0\nf 1 2 3");
    const auto bytes = import_obj("v 0 0 0 255 0 128\nv 1 0 0 255 0 128\nv 0 1 0 0 0 0\nf 1 2 3");
    ASSERT_TRUE(unit && bytes);
    EXPECT_EQ(unit->mesh.colours, bytes->mesh.colours);
    EXPECT_EQ(unit->mesh.materials.at(0).colour, (Rgb{255, 0, 128}));  // two of three corners
}

TEST(ObjImport, NumbersFourToSixOfAVertexAreItsColourWhateverFollows) {
    const auto rgba = import_obj("v 0 0 0 0 0 1 1\nv 1 0 0 1 0 0 1\nv 0 1 0 1 0 0 0.5\nf 1 2 3");
    ASSERT_TRUE(rgba) << rgba.error().line();
    EXPECT_EQ(rgba->mesh.colours, (std::vector<Rgb>{{0, 0, 255}, {255, 0, 0}, {255, 0, 0}}));
    const auto bytes = import_obj("v 0 0 0 9 0 255 255\nv 1 0 0 255 0 0 255\nv 0 1 0 1 0 0 0\nf 1 2 3");
    ASSERT_TRUE(bytes) << bytes.error().line();
    EXPECT_EQ(bytes->mesh.colours, (std::vector<Rgb>{{9, 0, 255}, {255, 0, 0}, {1, 0, 0}}));
    EXPECT_EQ(bytes->report.remarks,
              (std::vector<std::string>{"3 vertices have 7 numbers, the first in line 1: 4 to 6 were taken for a "
                                        "colour, and the last for its alpha, ignored"}));
    EXPECT_TRUE(import_obj("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3")->report.remarks.empty());
    EXPECT_TRUE(import_obj("v 0 0 0 1 0 0 nan\nv 1 0 0 1 0 0 1\nv 0 1 0 1 0 0 1\nf 1 2 3"));
    const auto weighted = import_obj("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3");
    ASSERT_TRUE(weighted);
    EXPECT_TRUE(weighted->mesh.colours.empty());
}

TEST(ObjImport, AColourALittleOutsideItsRangeIsClampedAndTold) {
    const auto bright = import_obj("v 0 0 0 1.02 0.6 0.2\nv 1 0 0 0.95 0.6 -0.01\nv 0 1 0 0.95 0.6 0.2\nf 1 2 3");
    ASSERT_TRUE(bright) << bright.error().line();
    EXPECT_EQ(bright->mesh.colours, (std::vector<Rgb>{{255, 153, 51}, {242, 153, 0}, {242, 153, 51}}));
    ASSERT_EQ(bright->report.remarks.size(), 1u);
    EXPECT_EQ(bright->report.remarks[0], "2 vertex colours lie outside 0 to 1 and were clamped, the first in line 1");
    const auto bytes = import_obj("v 0 0 0 0 0 0\nv 1 0 0 300 0 -1\nv 0 1 0 0 0 0\nf 1 2 3");
    ASSERT_TRUE(bytes) << bytes.error().line();
    EXPECT_EQ(bytes->mesh.colours[1], (Rgb{255, 0, 0}));
    ASSERT_EQ(bytes->report.remarks.size(), 1u);
    EXPECT_EQ(bytes->report.remarks[0], "1 vertex colours lie outside 0 to 255 and were clamped, the first in line 2");
    const auto none = import_obj("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 inf 0\nf 1 2 3");
    ASSERT_TRUE(none) << none.error().line();
    EXPECT_EQ(none->mesh.colours, (std::vector<Rgb>{{255, 0, 0}, {255, 0, 0}, {200, 200, 200}}));
    EXPECT_EQ(none->report.remarks,
              std::vector<std::string>{"1 vertex colours are not numbers and were left out, the first in line 3"});
}

TEST(ObjImport, MaterialColoursFollowTheSameRule) {
    const auto first_colour = [](const std::string& kd) {
        const auto read = geometry::import_mesh(
            bytes_of(std::string(kTriangle) + "mtllib m\nusemtl a\nf 1 2 3\n"), MeshFormat::obj, "test.obj",
            [&](std::string_view) -> Result<std::string> { return "newmtl a\n" + kd; });
        EXPECT_TRUE(read);
        return std::pair(read->mesh.materials.at(0).colour, read->report.remarks.size());
    };
    EXPECT_EQ(first_colour("Kd 1.02 0.6 -0.1\n"), (std::pair(Rgb{255, 153, 0}, std::size_t{1})));
    EXPECT_EQ(first_colour("Kd 255 128 0\n"), (std::pair(Rgb{255, 128, 0}, std::size_t{0})));
    EXPECT_EQ(first_colour("Kd 1 0 0\n"), (std::pair(Rgb{255, 0, 0}, std::size_t{0})));
}

TEST(ObjImport, ALineMayNameSeveralMaterialFilesOrOneWithABlankInItsName) {
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl A\nKd 1 0 0\n");
    folder.write("b.mtl", "newmtl B\nKd 0 0 1\n");
    folder.write("c d.mtl", "newmtl C\nKd 0 1 0\n");
    const auto obj = folder.write("part.obj", "mtllib a.mtl b.mtl\r\nmtllib c d.mtl\r\n" + std::string(kTriangle) +
                                                  "usemtl A\nf 1 2 3\nusemtl B\nf 1 2 3\nusemtl C\nf 1 2 3\n");
    const auto read = geometry::import_mesh(obj);
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_TRUE(read->report.remarks.empty()) << read->report.remarks[0];
    EXPECT_EQ(read->mesh.materials.at(0).colour, (Rgb{255, 0, 0}));
    EXPECT_EQ(read->mesh.materials.at(1).colour, (Rgb{0, 0, 255}));
    EXPECT_EQ(read->mesh.materials.at(2).colour, (Rgb{0, 255, 0}));
    // What is read may not be overwritten.
    const std::vector<std::filesystem::path> files = files_of_mesh(obj);
    for (const char* name : {"a.mtl", "b.mtl", "c d.mtl"})
        EXPECT_NE(std::ranges::find(files, folder.path() / name), files.end()) << name;
}

TEST(ObjImport, NamesTheLineAndTheRemedyOfWhatIsWrong) {
    const std::string start(kTriangle);  // 3 lines
    for (const char* bad : {"f 1 2 4", "f 0 1 2", "f 1 2 -4", "f 1 2", "f 1 2 x", "f 1 2 3.5",
                            "f 1 2 99999999999999999999", "v 1 2", "v 1 2 3 4 5 6 7 8", "v 1,5 2 3"}) {
        const std::string message = refused_obj(start + bad + "\nf 1 2 3\n");
        EXPECT_EQ(message.substr(0, 11), "test.obj:4:") << bad << " -> " << message;
        EXPECT_NE(message.find("; "), std::string::npos) << message;
    }
}

TEST(ObjImport, AVertexThatNoMeshCanHaveIsLeftOutUnlessAFaceNamesIt) {
    const std::string start(kTriangle);  // 3 lines
    for (const char* const bad : {"v 1 2 nan", "v 1 -inf 2", "v 1 2 1e400", "v 1 2 2e9"}) {
        EXPECT_EQ(refused_obj(start + bad + "\nf 1 2 4\n").substr(0, 11), "test.obj:4:") << bad;
        const auto read = import_obj(start + bad + "\nv 0 0 1\nf 1 2 5\nf -1 2 3\n");
        ASSERT_TRUE(read) << read.error().line();
        EXPECT_EQ(read->mesh.positions_m.size(), 4u) << bad;
        EXPECT_EQ(read->mesh.triangles, (std::vector<Corners3>{{0, 1, 3}, {3, 1, 2}})) << bad;
        ASSERT_EQ(read->report.remarks.size(), 1u);
        EXPECT_TRUE(read->report.remarks[0].starts_with(
            "1 vertices that no face names were left out, the first in line 4: a coordinate "))
            << bad;
    }
    const auto coloured = import_obj("v nan 0 0 9 9 9\nv 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 0 1 0 0 0 255\nf 2 3 4\n");
    ASSERT_TRUE(coloured) << coloured.error().line();
    EXPECT_EQ(coloured->mesh.colours, (std::vector<Rgb>{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}));
}

TEST(ObjImport, WhiteVerticesHideNoMaterials) {
    const auto read = [](const std::string& last) {
        return geometry::import_mesh(
            bytes_of("mtllib m\nv 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0 " + last + "\nusemtl a\nf 1 2 3\n"),
            MeshFormat::obj, "test.obj",
            [](std::string_view) -> Result<std::string> { return "newmtl a\nKd 1 0 0\n"; });
    };
    EXPECT_TRUE(read("1 1 1")->mesh.colours.empty());
    EXPECT_EQ(read("1 1 1")->mesh.materials.at(0).colour, (Rgb{255, 0, 0}));
    EXPECT_EQ(read("0 1 1")->mesh.colours.at(2), (Rgb{0, 255, 255}));
}

TEST(ObjImport, NamesOfMaterialsAndFilesMayHaveQuotesCommentsAndOtherCapitals) {
    const TemporaryFolder folder;
    folder.write("paints.mtl",
                 "newmtl red # the lid\nKd 1 0 0\nnewmtl Material #25\nKd 0 0 1\nnewmtl Material #26\nKd 0 1 0\n");
    const std::string rest = std::string(kTriangle) +
                             "usemtl red\nf 1 2 3\nusemtl Material #25\nf 1 2 3\nusemtl Material #26 # too\nf 1 2 3\n";
    for (const char* const name : {"paints.mtl", "PAINTS.MTL", "\"paints.mtl\"", "paints.mtl # of the lid",
                                   ".\\Paints.mtl", "C:\\models\\paints.mtl", "\"paints.mtl\" # both"}) {
        const auto obj = folder.write("part.obj", "mtllib " + std::string(name) + "\n" + rest);
        const auto read = geometry::import_mesh(obj);
        ASSERT_TRUE(read) << read.error().line();
        EXPECT_TRUE(read->report.remarks.empty()) << name << ": " << read->report.remarks[0];
        const auto colour = [&](std::size_t t) {
            return read->mesh.materials.at(read->mesh.triangle_materials.at(t)).colour;
        };
        EXPECT_EQ(colour(0), (Rgb{255, 0, 0})) << name;
        EXPECT_EQ(colour(1), (Rgb{0, 0, 255})) << name;
        EXPECT_EQ(colour(2), (Rgb{0, 255, 0})) << name;
        const std::vector<std::filesystem::path> files = files_of_mesh(obj);
        EXPECT_NE(std::ranges::find(files, folder.path() / "paints.mtl"), files.end()) << name;
    }
}

TEST(ObjImport, RefusesAFileWithoutFaces) {
    EXPECT_NE(refused_obj(std::string(kTriangle)).find("has no triangles"), std::string::npos);
    EXPECT_NE(refused_obj("\x7f\x45LF rubbish\n\n").find("has no triangles"), std::string::npos);
}

TEST(ObjImport, CountsWhatIsNotAPolygonInARemark) {
    const auto result = import_obj(std::string(kTriangle) + "l 1 2 3\np 1\ncurv 0 1 1 2\nf 1 2 3\n");
    ASSERT_TRUE(result);
    ASSERT_EQ(result->report.remarks.size(), 1u);
    EXPECT_EQ(result->report.remarks[0], "3 statements other than polygons were ignored, the first ('l') in line 4");
}

TEST(ObjImport, ReadsNumbersTooSmallForADoubleAsZero) {
    const auto result = import_obj("v 1e-400 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.positions_m[0], Vec3(0.0));
}

}  // namespace
}  // namespace burin::geometry::test

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "geometry/mesh/mesh_health.hpp"
#include "tests/geometry/mesh_samples.hpp"
#include "tests/geometry/picture_samples.hpp"

namespace burin::geometry::test {
namespace {

using Corners3 = std::array<std::uint32_t, 3>;
using Rgb = std::array<std::uint8_t, 3>;

Result<ImportedMesh> import_ply(std::string_view text) { return import_text(text, MeshFormat::ply); }
std::string refused_ply(const std::string& text) { return refusal(text, MeshFormat::ply); }

const std::string kVertexHeader = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaceHeader = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPlainPly =
    "ply\nformat ascii 1.0\n" + kVertexHeader + kFaceHeader + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

template <typename T>
void put(std::string& out, T value, std::endian order) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
}

// Properties of many types in an odd order, a list to skip in front of the coordinates, an element to skip in between.
std::string binary_ply(std::endian order) {
    std::string out =
        std::string("ply\r\nformat ") + (order == std::endian::little ? "binary_little_endian" : "binary_big_endian") +
        " 1.0\r\ncomment by hand, units m\r\n"
        "element vertex 4\r\nproperty list ushort short ring\r\nproperty double z\r\n"
        "property uint8 red\r\nproperty uchar green\r\nproperty uchar blue\r\nproperty float32 x\r\nproperty int16 "
        "y\r\n"
        "element edge 2\r\nproperty int vertex1\r\nproperty uint vertex2\r\n"
        "element face 2\r\nproperty int8 flags\r\nproperty list uint uint16 vertex_index\r\nend_header\r\n";
    for (int v = 0; v < 4; ++v) {
        put(out, static_cast<std::uint16_t>(v), order);
        for (int k = 0; k < v; ++k) put(out, std::int16_t{-1}, order);
        put(out, 0.1 * v, order);
        for (const int c : {10, 20, 30 + v}) put(out, static_cast<std::uint8_t>(c), order);
        put(out, 0.5f * static_cast<float>(v), order);
        put(out, static_cast<std::int16_t>(-v * v), order);
    }
    for (std::uint32_t e = 0; e < 4; ++e) put(out, e, order);
    for (std::uint16_t f = 0; f < 2; ++f) {
        put(out, std::int8_t{-5}, order);
        put(out, std::uint32_t{3} + f, order);
        for (std::uint16_t k = 0; k < 3 + f; ++k) put(out, k, order);
    }
    return out;
}

TEST(PlyImport, ReadsBinaryOfBothByteOrdersWithMixedTypes) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const auto result = import_ply(binary_ply(order));
        ASSERT_TRUE(result) << result.error().line();
        ASSERT_EQ(result->mesh.positions_m.size(), 4u);
        EXPECT_EQ(result->mesh.positions_m[3], Vec3(1.5, -9.0, 0.1 * 3));
        EXPECT_EQ(result->mesh.colours[3], (Rgb{10, 20, 33}));
        EXPECT_EQ(result->report.faces_in_file, 2u);
        EXPECT_EQ(result->mesh.triangles.size(), 3u);  // a triangle and a quadrangle
        ASSERT_EQ(result->report.remarks.size(), 1u);  // the element edge
    }
}

TEST(PlyImport, RefusesABinaryFileCutAnywhere) {
    const std::string whole = binary_ply(std::endian::big);
    for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(refused_ply(whole.substr(0, size)), "") << size;
}

TEST(PlyImport, RefusesAnAsciiFileCutAfterAnyWord) {
    for (std::size_t at = kPlainPly.find('\n'); at + 2 < kPlainPly.size();
         at = kPlainPly.find_first_of(" \n", at + 1)) {
        EXPECT_NE(refused_ply(kPlainPly.substr(0, at)), "") << kPlainPly.substr(0, at);
    }
    EXPECT_EQ(refused_ply(kPlainPly), "");
}

TEST(PlyImport, ReadsCarriageReturnsAndOddCase) {
    std::string text = kPlainPly;
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
    EXPECT_EQ(refused_ply(text), "");
    EXPECT_EQ(refused_ply("PLY\nFormat ASCII 1.0\nobj_info none\nElement Vertex 3\nProperty Float32 X\nproperty FLOAT "
                          "y\nproperty float z\n" +
                          kFaceHeader + "END_HEADER\n0 0 0 1 0 0 0 1 0 3 0 1 2"),
              "");
}

TEST(PlyImport, TurnsFaceColoursIntoMaterials) {
    const auto result = import_ply(
        "ply\nformat ascii 1.0\n" + kVertexHeader +
        "element face 3\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
        "property uchar blue\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 1 2 0 0 255\n3 0 1 2 255 0 0\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangle_materials, (std::vector<std::uint8_t>{0, 1, 0}));
    EXPECT_EQ(result->mesh.materials.at(1).colour, (Rgb{0, 0, 255}));
    EXPECT_TRUE(result->mesh.colours.empty());
}

TEST(PlyImport, ReadsFloatColoursFromZeroToOne) {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float red\nproperty float green\nproperty float blue\n" +
        kFaceHeader + "end_header\n";
    const auto result = import_ply(head + "0 0 0 1 .5 0\n1 0 0 1 .5 0\n0 1 0 1 .5 0\n3 0 1 2\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.colours[0], (Rgb{255, 128, 0}));
    const auto bright = import_ply(head + "0 0 0 1.02 .5 -.01\n1 0 0 1 .5 0\n0 1 0 1 .5 0\n3 0 1 2\n");
    ASSERT_TRUE(bright) << bright.error().line();
    EXPECT_EQ(bright->mesh.colours[0], (Rgb{255, 128, 0}));
    ASSERT_EQ(bright->report.remarks.size(), 1u);
    EXPECT_NE(bright->report.remarks[0].find("1 colours lie outside 0 to 1 and were clamped, the first in line "),
              std::string::npos);
    const auto whole = import_ply(head + "0 0 0 255 128 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2\n");
    ASSERT_TRUE(whole) << whole.error().line();
    EXPECT_EQ(whole->mesh.colours[0], (Rgb{255, 128, 0}));
    EXPECT_EQ(whole->mesh.colours[1], (Rgb{1, 0, 0}));
    const auto none = import_ply(head + "0 0 0 1 .5 0\n1 0 0 1 nan 0\n0 1 0 1 .5 0\n3 0 1 2\n");
    ASSERT_TRUE(none) << none.error().line();
    EXPECT_EQ(none->mesh.colours, (std::vector<Rgb>{{255, 128, 0}, {200, 200, 200}, {255, 128, 0}}));
    EXPECT_EQ(none->report.remarks,
              std::vector<std::string>{"1 colours are not numbers and were left out, the first in line 14"});
}

TEST(PlyImport, GivesAFaceTheColourThatTwoOfItsCornersShare) {
    const auto result = import_ply(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 9 0 0\n1 0 0 0 9 0\n0 1 0 0 9 0\n0 0 1 0 0 9\n3 0 1 2\n3 1 0 2\n3 1 2 3\n3 3 0 1\n");
    ASSERT_TRUE(result) << result.error().line();
    const auto colour = [&](std::size_t face) {
        return result->mesh.materials.at(result->mesh.triangle_materials.at(face)).colour;
    };
    EXPECT_EQ(colour(0), (Rgb{0, 9, 0})) << "the second and the third";
    EXPECT_EQ(colour(1), (Rgb{0, 9, 0})) << "the first and the third";
    EXPECT_EQ(colour(2), (Rgb{0, 9, 0})) << "the first and the second";
    EXPECT_EQ(colour(3), (Rgb{3, 3, 3})) << "all differ: their mean";
}

// 257 steps of 16 bits are one of 8: 65535 is 255.
TEST(PlyImport, ReadsColoursOfSixteenBits) {
    const auto result = import_ply(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property ushort red\nproperty ushort green\nproperty ushort blue\n" +
        kFaceHeader + "end_header\n0 0 0 65535 0 257\n1 0 0 25700 128 129\n0 1 0 0 0 0\n3 0 1 2\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.colours[0], (Rgb{255, 0, 1}));
    EXPECT_EQ(result->mesh.colours[1], (Rgb{100, 0, 1})) << "rounded to the nearest";
}

TEST(PlyImport, NamesTheLineOfWhatIsWrong) {
    const auto with = [](const std::string& from, const std::string& to) {
        std::string text = kPlainPly;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_EQ(refused_ply(with("3 0 1 2", "3 0 1 3")).substr(0, 12), "test.ply:13:");
    EXPECT_EQ(refused_ply(with("3 0 1 2", "3 0 -1 2")).substr(0, 12), "test.ply:13:");
    EXPECT_EQ(refused_ply(with("3 0 1 2", "3 0 .5 2")).substr(0, 12), "test.ply:13:");
    EXPECT_EQ(refused_ply(with("3 0 1 2", "-3 0 1 2")).substr(0, 12), "test.ply:13:");
    EXPECT_EQ(refused_ply(with("3 0 1 2", "nan 0 1 2")).substr(0, 12), "test.ply:13:");
    EXPECT_EQ(refused_ply(with("1 0 0", "1 nan 0")).substr(0, 12), "test.ply:11:");
    EXPECT_EQ(refused_ply(with("1 0 0", "1 0,5 0")).substr(0, 12), "test.ply:11:");
    EXPECT_EQ(refused_ply(with("float y", "float q")).substr(0, 8), "test.ply");
    EXPECT_EQ(refused_ply(with("float y", "half y")).substr(0, 11), "test.ply:5:");
    EXPECT_EQ(refused_ply(with("float y", "float x")).substr(0, 11), "test.ply:5:");
    EXPECT_EQ(refused_ply(with("ascii", "utf8")).substr(0, 11), "test.ply:2:");
    EXPECT_EQ(refused_ply(with("vertex 3", "vertex -3")).substr(0, 11), "test.ply:3:");
    EXPECT_EQ(refused_ply(with("element face", "element Vertex 0\nproperty float x\nelement face")).substr(0, 11),
              "test.ply:7:");
    EXPECT_EQ(refused_ply(with("vertex_indices", "corners")).substr(0, 8), "test.ply");
}

TEST(PlyImport, AnIntegerWithADecimalPointIsAnErrorAtItsLineAndAnAlphaIsIgnored) {
    const auto coloured = [](const std::string& type, const std::string& colour, const std::string& alpha) {
        return "ply\nformat ascii 1.0\n" + kVertexHeader + "property " + type + " red\nproperty " + type +
               " green\nproperty " + type + " blue\nproperty " + type + " alpha\n" + kFaceHeader +
               "end_header\n0 0 0 1 0 0 " + alpha + "\n1 0 0 " + colour + " " + alpha + "\n0 1 0 1 1 1 " + alpha +
               "\n3 0 1 2\n";
    };
    for (const std::string type : {"uchar", "char", "ushort", "int", "uint"}) {
        EXPECT_EQ(refused_ply(coloured(type, "0.5 0.5 0.5", "1")).substr(0, 12), "test.ply:15:") << type;
        EXPECT_EQ(refused_ply(coloured(type, "9 9 nan", "1")), "") << type;
        EXPECT_EQ(refused_ply(coloured(type, "9 9 9", "0.5")), "") << type;
        EXPECT_EQ(refused_ply(coloured(type, "9 9 9", "nan")), "") << type;
    }
    EXPECT_NE(refused_ply(coloured("uchar", "0.5 1 1", "1")).find("'0.5' stands where a whole number should"),
              std::string::npos);
    EXPECT_EQ(refused_ply(coloured("float", "0.5 0.5 0.5", "nan")), "");
    EXPECT_EQ(import_ply(coloured("uchar", "255.0 1 2", "1"))->mesh.colours.at(1), (Rgb{255, 1, 2}));
}

TEST(PlyImport, LeavesOutAVertexThatNoFaceNamesAndNamesItsPlace) {
    std::string text = kPlainPly;
    text.replace(text.find("vertex 3"), 8, "vertex 4").replace(text.find("0 0 0"), 5, "5 nan 1e99\n0 0 0");
    text.replace(text.find("3 0 1 2"), 7, "3 1 2 3");
    const auto read = import_ply(text);
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->mesh.positions_m.size(), 3u);
    EXPECT_EQ(read->report.vertices_in_file, 4u);
    EXPECT_EQ(read->mesh.triangles, (std::vector<Corners3>{{0, 1, 2}}));
    EXPECT_EQ(read->report.remarks,
              std::vector<std::string>{
                  "1 vertices that no face names were left out, the first in line 10: a coordinate is not a number"});
}

// Those that one program writes: a picture of two pixels' height, blue below and red above.
TEST(PlyImport, WearsThePictureThatACommentNames) {
    const std::string picture = png_file(2, 2, {255, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0, 255});
    const MaterialFileReader pictures = [&](std::string_view name) -> Result<std::string> {
        return name == "skin.png" ? Result<std::string>(picture) : fail(std::string(name), "is not there", "look");
    };
    const std::string faces =
        "ply\nformat ascii 1.0\n%" + kVertexHeader +
        "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
        "property int texnumber\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 .1 1 .1 .5 .1 0\n"
        "3 2 1 0 6 0 .9 1 .9 .5 .9 0\n";
    const std::string vertices =
        "ply\nformat ascii 1.0\n%element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float s\nproperty float t\n" +
        kFaceHeader + "end_header\n0 0 0 0 .1\n1 0 0 1 .1\n0 1 0 .5 .1\n3 0 1 2\n";
    const std::array texts{faces, vertices};
    const auto read = [&](std::string text, const std::string& comment) {
        text.replace(text.find('%'), 1, comment);
        return geometry::import_mesh(bytes_of(text), MeshFormat::ply, "test.ply", {}, std::nullopt, pictures);
    };
    for (const std::string& text : texts) {
        for (const char* const name : {"skin.png", "\"skin.png\"", "C:\\scans\\skin.png"}) {
            const auto worn = read(text, "comment TextureFile " + std::string(name) + "\n");
            ASSERT_TRUE(worn) << worn.error().line();
            ASSERT_FALSE(worn->corner_colours.empty()) << name;
            for (const auto& corner : worn->corner_colours[0]) EXPECT_GT(corner[2], 150);
            if (&text == texts.data()) {
                EXPECT_GT(worn->corner_colours.at(1)[0][0], 150);
            }
            ASSERT_EQ(worn->report.pictures.size(), 1u);
            EXPECT_TRUE(worn->report.pictures[0].ends_with("skin.png"));
        }
        const auto lost = read(text, "comment TextureFile lost.png\n");
        ASSERT_EQ(lost->report.remarks.size(), 1u);
        EXPECT_TRUE(lost->report.remarks[0].contains("lost.png")) << lost->report.remarks[0];
        const auto unnamed = read(text, "");
        EXPECT_EQ(unnamed->report.remarks, std::vector<std::string>{"its texture coordinates were ignored: no comment "
                                                                    "TextureFile names a picture"});
    }
    const auto nowhere =
        read(std::string(kPlainPly).insert(kPlainPly.find("element"), "%"), "comment TextureFile a.png\n");
    ASSERT_TRUE(nowhere) << nowhere.error().line();
    EXPECT_EQ(nowhere->report.remarks,
              std::vector<std::string>{"picture 'a.png' is not shown: there are no texture coordinates"});
}

TEST(PlyImport, FacesCountWhereVerticesOfOneColourStandBesideThem) {
    const auto coloured = [&](const std::string& vertex, const std::string& other) {
        return import_ply("ply\nformat ascii 1.0\n" + kVertexHeader +
                          "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
                          "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
                          "property uchar blue\nend_header\n0 0 0 " +
                          vertex + "\n1 0 0 " + vertex + "\n0 1 0 " + other + "\n3 0 1 2 255 0 0\n3 2 1 0 0 0 255\n");
    };
    const auto faces = coloured("255 0 0", "255 0 0");
    ASSERT_TRUE(faces) << faces.error().line();
    EXPECT_TRUE(faces->mesh.colours.empty());
    EXPECT_EQ(faces->mesh.materials.at(faces->mesh.triangle_materials.at(1)).colour, (Rgb{0, 0, 255}));
    const auto vertices = coloured("255 0 0", "0 9 0");
    EXPECT_EQ(vertices->mesh.colours.size(), 3u);
    EXPECT_EQ(vertices->mesh.materials.at(vertices->mesh.triangle_materials.at(1)).colour, (Rgb{255, 0, 0}));
    EXPECT_EQ(vertices->report.remarks,
              std::vector<std::string>{"its vertices have colours, which hide those of its faces"});
}

TEST(PlyImport, RefusesTriangleStripsRatherThanLosingThem) {
    const std::string message = refused_ply(
        "ply\nformat ascii 1.0\n" + kVertexHeader +
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_NE(message.find("triangle strips"), std::string::npos) << message;
}

TEST(PlyImport, RefusesCountsThatTheFileCannotHold) {
    for (const char* count : {"4", "1000000", "4294967295", "18446744073709551615", "99999999999999999999"}) {
        for (const char* element : {"vertex 3", "face 1"}) {
            std::string text = kPlainPly;
            text.replace(text.find(element), std::strlen(element),
                         std::string(element, std::strchr(element, ' ')) + " " + count);
            EXPECT_NE(refused_ply(text), "") << element << " " << count;
        }
    }
}

TEST(PlyImport, CountsFacesOfFewerThanThreeCorners) {
    const auto result = import_ply(
        "ply\nformat ascii 1.0\n" + kVertexHeader +
        "element face 3\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n0\n3 0 1 2\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->report.faces_without_area, 2u);
    EXPECT_EQ(result->mesh.triangles, (std::vector<Corners3>{{0, 1, 2}}));
    EXPECT_EQ(result->report.remarks.size(), 1u);
}

TEST(PlyImport, SkipsAnElementWithoutPropertiesWhateverItsCount) {
    EXPECT_EQ(refused_ply("ply\nformat ascii 1.0\nelement nothing 18446744073709551615\n" +
                          kPlainPly.substr(kPlainPly.find("element"))),
              "");
}

// A box of 300 x 200 x 100 mm, a row a line.
const std::string kPlyBox =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n300 0 0\n0 200 0\n300 200 0\n0 0 100\n300 0 100\n0 200 100\n300 200 100\n"
    "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";

// Returns the box with something behind the rows of a kind.
std::string ply_box_with(const std::string& behind_vertices, const std::string& behind_faces) {
    std::string text;
    std::size_t line = 0, from = 0;
    for (std::size_t at = 0; (at = kPlyBox.find('\n', from)) != std::string::npos; from = at + 1, ++line) {
        text += kPlyBox.substr(from, at - from);
        text += line < 9 ? "" : line < 17 ? behind_vertices : behind_faces;
        text += "\n";
    }
    return text;
}

double ply_volume_m3(const Result<ImportedMesh>& read) {
    if (!read) return 0.0;
    const MeshHealth health = examine(read->mesh);
    return health.closed ? health.signed_volume_m3 : 0.0;
}

TEST(PlyImport, ARowIsALineAndWhatIsTooMuchInItIsSkippedAndNamed) {
    struct Case {
        const char *behind_vertices, *behind_faces, *remark;
    };
    for (const auto& [vertices, faces, remark] :
         {Case{"", " 1 1 1", "6 rows have more numbers than the header says, the first in line 18"},
          Case{"", " 1", "6 rows have more numbers than the header says, the first in line 18"},
          Case{" 0 0 1", "", "8 rows have more numbers than the header says, the first in line 10"},
          Case{" 7", " 255 0 0 255", "14 rows have more numbers than the header says, the first in line 10"},
          Case{" # a corner", "", "8 rows have more numbers than the header says, the first in line 10"}}) {
        const auto read = import_ply(ply_box_with(vertices, faces));
        ASSERT_TRUE(read) << read.error().line();
        EXPECT_NEAR(ply_volume_m3(read), 6e-3, 1e-12) << vertices << faces;
        ASSERT_EQ(read->report.remarks.size(), 1u) << vertices << faces;
        EXPECT_EQ(read->report.remarks[0], std::string(remark) + "; what is too much was skipped");
    }
}

TEST(PlyImport, ARowThatLacksANumberIsAnErrorAtItsLineAndNeverAnotherMesh) {
    const auto with = [](const std::string& from, const std::string& to, const std::string& behind) {
        std::string text = kPlyBox + behind;
        return refused_ply(text.replace(text.find(from), from.size(), to));
    };
    for (const char* behind : {"", "\n\n", "3 0 1 2\n", "7\n"}) {
        EXPECT_EQ(with("4 4 5 7 6", "4 4 5 7", behind).substr(0, 12), "test.ply:19:") << behind;
        EXPECT_EQ(with("300 0 0\n", "300 0\n", behind).substr(0, 12), "test.ply:11:") << behind;
        EXPECT_EQ(with("4 1 3 7 5", "5 1 3 7 5", behind).substr(0, 12), "test.ply:23:") << behind;
    }
    EXPECT_EQ(with("300 0 0\n0", "300 0\n0 0", "").substr(0, 12), "test.ply:11:") << "the next has one too many";
}

TEST(PlyImport, ReadsABoxWhoseRowsDoNotKeepToLines) {
    const std::size_t data = kPlyBox.find("0 0 0\n");
    for (const std::size_t words_a_line : {1, 2, 7, 12, 1000}) {
        std::string text = kPlyBox;
        std::size_t words = 0;
        for (std::size_t at = data; at < text.size(); ++at)
            if (text[at] == ' ' || text[at] == '\n') text[at] = ++words % words_a_line == 0 ? '\n' : ' ';
        const auto read = import_ply(text);
        ASSERT_TRUE(read) << words_a_line << ": " << read.error().line();
        EXPECT_NEAR(ply_volume_m3(read), 6e-3, 1e-12) << words_a_line;
    }
}

// Packed vertices swallow the lines of faces, of which the last then look whole.
TEST(PlyImport, ReadsFacesInLinesBehindVerticesThatShareSome) {
    for (const char* const vertices : {"0 0 0 1 0 0 0 1 0 0 0 1\n", "0 0 0 1 0 0 0 1 0\n0 0 1\n",
                                       "0 0 0 1 0 0\n0 1 0 0 0 1\n", "0 0 0 1 0\n0 0 1 0\n0 0 1\n"}) {
        const auto read = import_ply(
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 4\nproperty list uchar int vertex_indices\nend_header\n" +
            std::string(vertices) + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
        ASSERT_TRUE(read) << vertices << read.error().line();
        EXPECT_NEAR(ply_volume_m3(read), 1.0 / 6.0, 1e-9) << vertices;
    }
}

}  // namespace
}  // namespace burin::geometry::test

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "geometry/mesh/mesh_health.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

using Corners3 = std::array<std::uint32_t, 3>;
using Rgb = std::array<std::uint8_t, 3>;

Result<ImportedMesh> import_off(std::string_view text) { return import_text(text, MeshFormat::off); }
std::string refused_off(const std::string& text) { return refusal(text, MeshFormat::off); }

const std::string kPlainOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(OffImport, ReadsCommentsCarriageReturnsAndFacesOfAnySize) {
    const auto result = import_off(
        "off # a kite\r\n# and an edge\r\n4 3 0\r\n0 0 0 1 0 0\r\n1 1 0 # three\r\n0 1 0\r\n3 0 1 2\r\n4 0 1 2 3\r\n2 "
        "0 1");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles, (std::vector<Corners3>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
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
    EXPECT_EQ(refused_off(with("3 0 1 2", "3 0 1 2 red 0 0")).substr(0, 11), "test.off:6:");
    EXPECT_EQ(refused_off(with("3 0 1 2", "3 0 1 2 9 0")).substr(0, 11), "test.off:6:");
    EXPECT_EQ(refused_off(with("1 0 0", "1 0")).substr(0, 11), "test.off:4:");
    EXPECT_EQ(refused_off(with("1 0 0", "1 0 0 255 0 0")).substr(0, 11), "test.off:4:");
    EXPECT_EQ(refused_off(with("3 1 0", "3")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("3 1 0", "3 1 0 4")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("3 0 1 2", "4000000000 0 1 2")).substr(0, 9), "test.off:");
    EXPECT_EQ(refused_off(with("1 0 0", "1 nan 0")).substr(0, 11), "test.off:4:");
    EXPECT_EQ(refused_off(with("1 0 0", "1 0x0 0")).substr(0, 11), "test.off:4:");
    EXPECT_EQ(refused_off(with("3 1 0", "3 x 0")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("3 1 0", "4000000000 1 0")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("3 1 0", "3 18446744073709551615 0")).substr(0, 11), "test.off:2:");
    EXPECT_EQ(refused_off(with("OFF", "4OFF")).substr(0, 11), "test.off:1:");
    EXPECT_EQ(refused_off(with("OFF", "OFF BINARY")).substr(0, 11), "test.off:1:");
}

// A box of 300 x 200 x 100 mm: what stands behind the counts, with a line end of its own.
const std::string kOffBox =
    "0 0 0\n0.3 0 0\n0.3 0.2 0\n0 0.2 0\n0 0 0.1\n0.3 0 0.1\n0.3 0.2 0.1\n0 0.2 0.1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

void expect_off_box(const std::string& text) {
    const auto read = import_off(text);
    ASSERT_TRUE(read) << text.substr(0, 20) << ": " << read.error().line();
    const MeshHealth health = examine(read->mesh);
    EXPECT_EQ(health.triangles, 12u) << text.substr(0, 20);
    EXPECT_TRUE(health.closed) << text.substr(0, 20);
    EXPECT_NEAR(health.signed_volume_m3, 6e-3, 1e-12) << text.substr(0, 20);
}

TEST(OffImport, ReadsABoxWhetherEdgesAreCountedOrNotAndBehindTheKeywordAtOnce) {
    for (const char* head :
         {"OFF\n8 6 0\n", "OFF\n8 6\n", "OFF8 6 0\n", "OFF8 6\n", "OFF 8 6\n", "off # box\n\n8 6 12\n"})
        expect_off_box(head + kOffBox);
}

TEST(OffImport, ReadsNormalsColoursAndTextureInAnyOrderOfTheirLetters) {
    std::string faces = kOffBox.substr(kOffBox.find("4 0 3 2 1"));
    const auto box = [&](const std::string& keyword, const std::string& behind) {
        std::string vertices = kOffBox.substr(0, kOffBox.size() - faces.size()), text = keyword + "\n8 6\n";
        for (std::size_t at = 0; (at = vertices.find('\n', at)) != std::string::npos; at += behind.size() + 1)
            vertices.insert(at, behind);
        return text + vertices + faces;
    };
    for (const char* keyword : {"NOFF", "noff"}) expect_off_box(box(keyword, " 0 0 1"));
    for (const char* keyword : {"CNOFF", "NCOFF"}) {
        expect_off_box(box(keyword, " 0 0 1 0 0 255 255"));
        EXPECT_EQ(import_off(box(keyword, " 0 0 1 0 0 255 255"))->mesh.colours.at(7), (Rgb{0, 0, 255})) << keyword;
    }
    for (const char* keyword : {"STCNOFF", "NCSTOFF", "CSTNOFF"}) expect_off_box(box(keyword, " 0 0 1 1 0 0 1 .5 .5"));
    EXPECT_EQ(refused_off(box("CCOFF", " 0 0 1 1 0 0")).substr(0, 11), "test.off:1:");
}

// Geomview's definition: numbers may stand in lines as they like, only a face's colour ends with its line.
TEST(OffImport, ReadsAFaceThatGoesOverLines) {
    const std::string vertices = "OFF\n8 6 12\n" + kOffBox.substr(0, kOffBox.find("4 0 3 2 1"));
    std::string parted, coloured;
    for (const char* face : {"0 3 2 1", "4 5 6 7", "0 1 5 4", "1 2 6 5", "2 3 7 6", "3 0 4 7"}) {
        std::string words = face;
        for (const std::size_t at : {3, 5}) words[at] = '\n';
        parted += "4 " + words + "\n";
        coloured += "4\n" + words + " 255 0 0 # red\n";
    }
    expect_off_box(vertices + parted);
    expect_off_box(vertices + coloured);
    EXPECT_EQ(import_off(vertices + coloured)->mesh.materials.at(0).colour, (Rgb{255, 0, 0}));
}

TEST(OffImport, ReadsABoxHoweverItsLinesEnd) {
    const auto with_lines_of = [](std::size_t words_a_line, std::string text) {
        std::size_t words = 0;
        for (char& c : text)
            if (c == ' ' || c == '\n') c = ++words % words_a_line == 0 ? '\n' : ' ';
        return text;
    };
    const std::string faces = kOffBox.substr(kOffBox.find("4 0 3 2 1"));
    const std::string vertices = kOffBox.substr(0, kOffBox.size() - faces.size());
    for (const std::size_t words : {1, 2, 5, 6, 12, 24}) {
        expect_off_box("OFF\n8 6 12\n" + with_lines_of(words, vertices) + "\n" + faces);
        expect_off_box("OFF " + with_lines_of(words, "8 6 12 " + vertices) + "\n" + with_lines_of(1, faces));
    }
}

TEST(OffImport, ReadsColoursOfVerticesThatGoOverLines) {
    const auto with_blue_of = [](const std::string& red, const std::string& blue) {
        return import_off("COFF 3 1 0\n0 0 0 " + red + "\n1 0 0 " + red + "\n0 1 0\n" + blue + "\n3 0 1 2\n");
    };
    for (const auto& read : {with_blue_of("255 0 0", "0 0 255"), with_blue_of("255 0 0 9", "0\n0 255 9")}) {
        ASSERT_TRUE(read) << read.error().line();
        EXPECT_EQ(read->mesh.positions_m.at(2), Vec3(0, 1, 0));
        EXPECT_EQ(read->mesh.colours.at(2), (Rgb{0, 0, 255}));
    }
}

TEST(OffImport, ReadsAFileWithoutTheKeyword) { expect_off_box("# box\n8 6 12\n" + kOffBox); }

TEST(OffImport, ACornerOrACoordinateTooFewIsAnErrorAtItsLineAndNeverAnotherMesh) {
    const auto with = [](const std::string& from, const std::string& to, const std::string& behind = "") {
        std::string text = "OFF\n8 6 12\n" + kOffBox + behind;
        return refused_off(text.replace(text.find(from), from.size(), to));
    };
    for (const char* behind : {"", "# the end\n", "3 1 2 3\n", "1 0 0\n"}) {
        EXPECT_EQ(with("4 4 5 6 7", "4 4 5 6", behind).substr(0, 12), "test.off:12:") << behind;
        EXPECT_EQ(with("0.3 0 0\n", "0.3 0\n", behind).substr(0, 11), "test.off:4:") << behind;
        EXPECT_EQ(with("0.3 0 0\n", "0.3 0 0 1\n", behind).substr(0, 11), "test.off:4:") << behind;
    }
    EXPECT_EQ(with("0.3 0 0\n0.3 0.2 0", "0.3 0\n0 0.3 0.2 0").substr(0, 11), "test.off:4:") << "a row with a fault";
    EXPECT_EQ(with("4 0 3 2 1\n4 4", "4 0 3 2\n1 4 4").substr(0, 12), "test.off:12:") << "no colour is so long";
}

TEST(OffImport, AColourOutsideItsRangeIsClampedAndNamedAtItsLine) {
    const auto head = [](const std::string& faces) { return import_off("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n" + faces); };
    const auto bytes = head("3 0 1 2 1 0 0\n3 0 1 2 300 0 -1\n");
    ASSERT_TRUE(bytes) << bytes.error().line();
    EXPECT_EQ(bytes->mesh.materials.at(0).colour, (Rgb{1, 0, 0})) << "one of the file is above 1";
    EXPECT_EQ(bytes->mesh.materials.at(1).colour, (Rgb{255, 0, 0}));
    EXPECT_EQ(bytes->report.remarks,
              (std::vector<std::string>{"1 colours lie outside 0 to 255 and were clamped, the first in line 7"}));
    const auto whole = head("3 0 1 2 1 0 0\n3 0 1 2 0 0 1\n");
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->mesh.materials.at(0).colour, (Rgb{255, 0, 0})) << "none of the file is above 1";
    const auto points = head("3 0 1 2 1.02 0.6 0.2\n3 0 1 2 -0.01 1 0\n");
    ASSERT_TRUE(points);
    EXPECT_EQ(points->mesh.materials.at(0).colour, (Rgb{255, 153, 51}));
    EXPECT_EQ(points->mesh.materials.at(1).colour, (Rgb{0, 255, 0}));
}

TEST(OffImport, AColourThatIsAWordIsAnErrorAtItsLineAndAnAlphaIsIgnored) {
    const auto face = [](const std::string& colour) {
        return refused_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " + colour + "\n");
    };
    for (const char* colour : {"red", "0xff0000", "red green blue", "1 0 0 opaque"}) {
        EXPECT_EQ(face(colour).substr(0, 11), "test.off:6:") << colour;
    }
    EXPECT_EQ(face("1 0 0 nan"), "");
    EXPECT_EQ(face("3"), "");
    const auto vertex = [](const std::string& colour) {
        return refused_off("COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 " + colour + "\n0 1 0 1 0 0 1\n3 0 1 2\n");
    };
    EXPECT_EQ(vertex("red").substr(0, 11), "test.off:4:");
    EXPECT_EQ(vertex("1 0 0 nan"), "");
}

TEST(OffImport, LeavesOutAColourThatIsNoNumberAndAVertexThatNoFaceNames) {
    const auto read = import_off(
        "COFF\n4 2 0\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 inf 1 0 0 9\n0 1 0 255 0 0\n3 0 1 3 1 0 nan\n3 0 1 3 9 8 7\n");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->mesh.positions_m.size(), 3u);
    EXPECT_EQ(read->mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_EQ(read->mesh.materials.at(read->mesh.triangle_materials.at(0)).colour, (Rgb{200, 200, 200}));
    EXPECT_EQ(read->mesh.materials.at(read->mesh.triangle_materials.at(1)).colour, (Rgb{9, 8, 7}));
    const std::vector<std::string> expected{
        "1 colours are not numbers and were left out, the first in line 7",
        "1 vertices that no face names were left out, the first in line 5: a coordinate is infinite"};
    for (const std::string& remark : expected)
        EXPECT_NE(std::ranges::find(read->report.remarks, remark), read->report.remarks.end()) << remark;
    const auto placed = import_off("STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
    ASSERT_TRUE(placed) << placed.error().line();
    EXPECT_EQ(placed->report.remarks,
              std::vector<std::string>{"its texture coordinates were ignored: an OFF names no picture"});
}

TEST(OffImport, SaysThatTextAfterTheLastFaceWasIgnored) {
    const auto result = import_off(kPlainOff + "1 0\n");
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->report.remarks.size(), 1u);
}

}  // namespace
}  // namespace burin::geometry::test

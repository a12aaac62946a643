// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

constexpr float kTwoTriangles[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, /**/ 1, 0, 0, 1, 1, 0, 0, 1, 0};

Result<ImportedMesh> import_bytes(const std::vector<std::byte>& bytes) {
    return import_mesh(bytes, MeshFormat::stl, "test.stl");
}

std::string facet(const char* a, const char* b, const char* c) {
    return std::string("facet normal 0 0 1\n outer loop\n  vertex ") + a + "\n  vertex " + b + "\n  vertex " + c +
           "\n endloop\nendfacet\n";
}

TEST(StlImport, WeldsEqualCornersOfBinaryTriangles) {
    const auto result = import_bytes(binary_stl(kTwoTriangles, 2));
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->report.format, "STL, binary");
    EXPECT_EQ(result->mesh.positions_m.size(), 4u);
    EXPECT_EQ(result->report.vertices_merged, 2u);
    EXPECT_EQ(result->report.vertices_in_file, 6u);
    ASSERT_EQ(result->mesh.triangles.size(), 2u);
    EXPECT_EQ(result->mesh.triangles[1], (std::array<std::uint32_t, 3>{1, 3, 2}));
}

TEST(StlImport, TakesMinusZeroForZeroButNothingElseForEqual) {
    const float next = std::nextafter(1.0f, 2.0f);
    const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, /**/ -0.0f, 0, -0.0f, next, 0, 0, 0, 1, 0};
    const auto result = import_bytes(binary_stl(corners, 2));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.positions_m.size(), 4u);  // 0 merged, 1 and its successor not
}

TEST(StlImport, KeepsTrianglesWithEqualCornersForTheHealthReport) {
    const float corners[] = {0, 0, 0, 0, 0, 0, 0, 1, 0, /**/ 0, 0, 0, 1, 0, 0, 0, 1, 0};
    const auto result = import_bytes(binary_stl(corners, 2));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.triangles.size(), 2u);
}

TEST(StlImport, ReadsABinaryFileWhoseHeaderSaysSolid) {
    auto bytes = binary_stl(kTwoTriangles, 2);
    const auto title = bytes_of("solid of an exporter that says so in binary files, too");
    std::copy(title.begin(), title.end(), bytes.begin());
    const auto result = import_bytes(bytes);
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles.size(), 2u);
}

TEST(StlImport, RefusesACountThatTheFileCannotHold) {
    for (const std::uint32_t claimed : {3u, 1000000u, 0xFFFFFFFFu}) {
        const auto result = import_bytes(binary_stl(kTwoTriangles, claimed));
        ASSERT_FALSE(result);
        EXPECT_NE(result.error().what.find("claims " + std::to_string(claimed)), std::string::npos)
            << result.error().line();
    }
}

// It was read as binary: "claims 1936287860 triangles".
TEST(StlImport, SaysOfATextThatItIsNone) {
    std::string text;
    while (text.size() < 800) text += "this is not a mesh at all\r\n";
    const auto result = import_bytes(bytes_of(text));
    ASSERT_FALSE(result);
    EXPECT_TRUE(result.error().what.contains("is a text, but no STL file")) << result.error().line();
}

TEST(StlImport, RefusesABinaryFileCutAnywhere) {
    const auto whole = binary_stl(kTwoTriangles, 2);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(import_bytes({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    }
}

// Materialise Magics and VisCAM write the same colours, with their channels and the highest bit the other way round.
TEST(StlImport, ReadsTheColoursOfBothProgramsThatWriteSome) {
    const auto coloured = [](const std::string& title, std::uint16_t first, std::uint16_t second) {
        std::vector<std::byte> bytes = binary_stl(kTwoTriangles, 2);
        std::memcpy(bytes.data(), title.data(), title.size());
        std::memcpy(bytes.data() + 84 + 48, &first, 2);
        std::memcpy(bytes.data() + 84 + 98, &second, 2);
        const auto read = import_bytes(bytes);
        EXPECT_TRUE(read) << read.error().line();
        std::vector<std::array<std::uint8_t, 3>> colours;
        for (const std::uint8_t material : read->mesh.triangle_materials)
            colours.push_back(read->mesh.materials.at(material).colour);
        return std::pair(colours, read->report.remarks);
    };
    using Colours = std::vector<std::array<std::uint8_t, 3>>;
    const std::string magics("COLOR=\x0a\x14\x1e\xff,MATERIAL=", 20);
    EXPECT_EQ(coloured(magics, 31 | 16 << 5, 0x8000).first, (Colours{{255, 132, 0}, {10, 20, 30}}));
    EXPECT_EQ(coloured("viscam", 0x8000 | 31 << 10 | 16 << 5, 0).first, (Colours{{255, 132, 0}, {200, 200, 200}}));
    EXPECT_TRUE(coloured(magics, 0, 0x8000).second.empty());
    const auto other = coloured("another", 7, 0);
    EXPECT_TRUE(other.first.empty());
    EXPECT_EQ(other.second, std::vector<std::string>{"the attributes of 1 triangles were ignored: they are no colours "
                                                     "that Burin knows"});
}

TEST(StlImport, SaysThatBytesAfterTheLastTriangleWereIgnored) {
    const auto result = import_bytes(binary_stl(kTwoTriangles, 1));
    ASSERT_TRUE(result);
    ASSERT_EQ(result->report.remarks.size(), 1u);
    EXPECT_EQ(result->report.remarks[0], "50 bytes after the last triangle were ignored");
}

TEST(StlImport, ReadsTheTrianglesBehindACountOfNoneAndSaysSo) {
    const auto read = import_bytes(binary_stl(kTwoTriangles, 0));
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->mesh.triangles.size(), 2u);
    ASSERT_EQ(read->report.remarks.size(), 1u);
    EXPECT_EQ(read->report.remarks[0], "its header counts 0 triangles, and 2 follow: all of them were read");
    auto cut = binary_stl(kTwoTriangles, 0);
    cut.pop_back();
    const auto refused = import_bytes(cut);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().what.contains("counts 0 triangles in its header, and the 99 bytes behind it"))
        << refused.error().line();
    EXPECT_FALSE(import_bytes(binary_stl({}, 0))) << "there are none";
}

TEST(StlImport, NamesTheByteOfANonFiniteCoordinate) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -3e38f}) {
        std::vector<float> corners(std::begin(kTwoTriangles), std::end(kTwoTriangles));
        corners[10] = bad;  // y of the second triangle's first corner
        const auto result = import_bytes(binary_stl(corners, 2));
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().where, "test.stl, byte 150");  // 84 + 50 + 12 + 4
    }
}

TEST(StlImport, RefusesAFileWithoutTriangles) {
    EXPECT_FALSE(import_bytes(binary_stl({}, 0)));
    EXPECT_NE(refusal("solid nothing\nendsolid nothing\n", MeshFormat::stl).find("has no triangles"),
              std::string::npos);
    EXPECT_NE(refusal("", MeshFormat::stl).find("is empty"), std::string::npos);
}

TEST(StlImport, ReadsAsciiOfAnyCaseAndLineEndAndNumberForm) {
    const auto result = import_text(
        "SOLID My Part facet\r\n  Facet Normal nan 0 1e0\r\nOUTER loop\r\nvertex +1.5 -2E-3 .25\r\nVERTEX 1 0 0\r\n"
        "vertex 0 1 0\r\nendloop\r\nEndFacet\r\nENDSOLID My Part\r\n",
        MeshFormat::stl);
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->report.format, "STL, ASCII");
    EXPECT_EQ(result->mesh.positions_m[0], Vec3(1.5, -0.002, 0.25));
}

TEST(StlImport, ReadsSeveralSolidsOfOneAsciiFile) {
    const auto result = import_text("solid a\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid a\nsolid b\n" +
                                        facet("0 0 1", "1 0 0", "0 1 0") + "endsolid b\n",
                                    MeshFormat::stl);
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles.size(), 2u);
}

TEST(StlImport, NamesTheLineOfWhatIsWrongInAscii) {
    const std::string head = "solid\n" + facet("0 0 0", "1 0 0", "0 1 0");  // 8 lines
    EXPECT_EQ(refusal(head + facet("0 0 0", "x 0 0", "0 1 0"), MeshFormat::stl).substr(0, 12), "test.stl:12:");
    EXPECT_EQ(refusal(head + facet("0 0 0", "inf 0 0", "0 1 0"), MeshFormat::stl).substr(0, 12), "test.stl:12:");
    EXPECT_EQ(refusal(head + facet("0 0 0", "1e999 0 0", "0 1 0"), MeshFormat::stl).substr(0, 12), "test.stl:12:");
    EXPECT_EQ(refusal(head + "rubbish\n", MeshFormat::stl).substr(0, 11), "test.stl:9:");
}

TEST(StlImport, RefusesAnAsciiFileCutAfterAnyWord) {
    const std::string whole = "solid x\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid";
    for (std::size_t at = whole.find('\n'); at < whole.size(); at = whole.find_first_of(" \n", at + 1)) {
        EXPECT_NE(refusal(whole.substr(0, at), MeshFormat::stl), "") << whole.substr(0, at);
    }
    EXPECT_EQ(refusal(whole, MeshFormat::stl), "");
}

TEST(StlImport, ReadsTheEndOfLoopsFacetsAndSolidsInTwoWords) {
    std::string text =
        "solid brick\n" + facet("0 0 0", "1 0 0", "0 1 0") + facet("0 0 0", "1 0 0", "0 0 1") + "end solid brick\n";
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>("endloop", "end loop"), {"endfacet", "End Facet"}}) {
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
            text.replace(at, from.size(), to);
    }
    const auto result = import_text(text, MeshFormat::stl);
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles.size(), 2u);
    EXPECT_NE(refusal("solid\n" + facet("0 0 0", "1 0 0", "0 1 0") + "end\n", MeshFormat::stl), "");
}

TEST(StlImport, AFileByAnotherNameIsCalledWhatItIs) {
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const auto bytes = binary_stl(corners, 1);
    for (const MeshFormat format : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply}) {
        const auto read = import_mesh(bytes, format, "test");
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().line(), "test: is binary STL by another name; rename it to end in .stl");
    }
    const std::string stl = "solid a\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid\n";
    EXPECT_NE(refusal(stl, MeshFormat::off).find("is ASCII STL"), std::string::npos);
    EXPECT_NE(refusal("OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", MeshFormat::stl).find("is OFF"), std::string::npos);
    EXPECT_NE(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", MeshFormat::off).find("is OBJ"), std::string::npos);
    EXPECT_NE(refusal("ply\nformat ascii 1.0\n", MeshFormat::off).find("is PLY"), std::string::npos);
}

TEST(StlImport, SplitsAsciiFacetsOfFourCorners) {
    const auto result = import_text(
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid",
        MeshFormat::stl);
    ASSERT_TRUE(result) << result.error().line();
    EXPECT_EQ(result->mesh.triangles.size(), 2u);
    EXPECT_EQ(result->report.polygons_fanned, 1u);
}

}  // namespace
}  // namespace burin::geometry::test

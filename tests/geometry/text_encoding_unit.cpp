// SPDX-License-Identifier: MIT
// The bytes around the text of a mesh file: byte-order marks, UTF-16, line ends; and binary files that look like them.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

using namespace std::string_literals;

constexpr const char* kMark = "\xEF\xBB\xBF";

struct Sample {
    MeshFormat format;
    std::string text;  // a triangle with the corners (0,0,0), (1,0,0), (0,1,0)
};

const Sample kSamples[] = {
    {MeshFormat::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n"},
    {MeshFormat::off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {MeshFormat::ply,
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
     "1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {MeshFormat::stl,
     "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"},
};

std::string with_line_ends(const std::string& text, const std::string& end) {
    std::string result;
    for (const char c : text) result += c == '\n' ? end : std::string(1, c);
    return result;
}

std::string as_utf16(const std::string& text, bool little_endian) {
    std::string result;
    for (const char c : text) result += little_endian ? std::string{c, '\0'} : std::string{'\0', c};
    return result;
}

void expect_the_triangle(std::string_view bytes, MeshFormat format) {
    const auto read = import_text(bytes, format);
    ASSERT_TRUE(read) << read.error().line();
    ASSERT_EQ(read->mesh.triangles.size(), 1u);
    const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(read->mesh.positions_m[read->mesh.triangles[0][k]], corners[k]) << read->report.format;
    EXPECT_TRUE(read->report.remarks.empty()) << read->report.remarks[0];
}

TEST(MeshText, AByteOrderMarkHidesNoFirstLine) {
    for (const Sample& sample : kSamples) expect_the_triangle(kMark + sample.text, sample.format);
}

TEST(MeshText, LinesEndWithAnyOfTheThreeEnds) {
    for (const Sample& sample : kSamples) {
        for (const char* mark : {"", kMark}) {
            for (const char* end : {"\r\n", "\r"})
                expect_the_triangle(mark + with_line_ends(sample.text, end), sample.format);
        }
    }
}

TEST(MeshText, Utf16IsRefusedByNameAndWithTheRemedy) {
    for (const Sample& sample : kSamples) {
        for (const char* end : {"\n", "\r\n"}) {
            const std::string text = with_line_ends(sample.text, end);
            for (const std::string& bytes : {"\xFF\xFE" + as_utf16(text, true), "\xFE\xFF" + as_utf16(text, false),
                                             as_utf16(text, true), as_utf16(text, false)}) {
                EXPECT_NE(refusal(bytes, sample.format).find("is UTF-16 text; save it as UTF-8"), std::string::npos)
                    << refusal(bytes, sample.format);
            }
        }
    }
}

TEST(MeshText, AMarkBeforeAMaterialFileHidesNoMaterial) {
    const TemporaryFolder folder;
    folder.write("paint.mtl", kMark + "newmtl red\r\nKd 1 0 0\r\n"s);
    const std::string text = "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    const auto read = import_mesh(folder.write("a.obj", text));
    ASSERT_TRUE(read);
    ASSERT_EQ(read->mesh.materials.size(), 1u);
    EXPECT_EQ(read->mesh.materials[0].colour, (std::array<std::uint8_t, 3>{255, 0, 0}));
    EXPECT_TRUE(read->report.remarks.empty());
    folder.write("paint.mtl", "\xFF\xFE" + as_utf16("newmtl red\nKd 1 0 0\n", true));
    const auto grey = import_mesh(folder.path() / "a.obj");
    ASSERT_TRUE(grey);
    ASSERT_FALSE(grey->report.remarks.empty());
    EXPECT_NE(grey->report.remarks[0].find("is UTF-16 text; save it as UTF-8"), std::string::npos);
}

TEST(MeshText, ABinaryStlIsReadWhateverItsHeaderLooksLike) {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (const std::string& start : {kMark + "solid in a binary header"s, "\xFF\xFE"s, "\xFE\xFF"s, "\xFF\xFE\0\0"s,
                                     "s\0o\0l\0i\0d\0"s, "\0s\0o"s, std::string(kMark)}) {
        std::vector<std::byte> bytes = binary_stl(corners, 1);
        std::memcpy(bytes.data(), start.data(), start.size());
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        expect_the_triangle(text, MeshFormat::stl);
        // Bytes after the last triangle are told, and are no reason to take the file for text.
        const auto longer = import_text(std::string(text) + "more", MeshFormat::stl);
        ASSERT_TRUE(longer) << longer.error().line();
        EXPECT_EQ(longer->mesh.triangles.size(), 1u);
        EXPECT_EQ(longer->report.remarks.size(), 1u);
    }
}

// A binary PLY of one vertex byte-coded (x, y, z as uchar) three times and a face, its header's lines ended as asked.
std::string byte_ply(const std::string& end, char first_x) {
    std::string text = with_line_ends(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar "
        "z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n",
        end);
    text += {first_x, 0, 0, 1, 0, 0, 0, 1, 0, /**/ 3, 0, 1, 2};
    return text;
}

TEST(MeshText, ABinaryPlyIsReadToTheByteAfterAMarkAndAnyLineEnd) {
    for (const char* mark : {"", kMark}) {
        for (const char* end : {"\n", "\r\n", "\r"}) {
            // A coordinate of 10 has the code of a line feed; it belongs to the data even behind a lone CR.
            for (const char x : {'\0', '\n'}) {
                const auto read = import_text(mark + byte_ply(end, x), MeshFormat::ply, LengthUnit::m);
                ASSERT_TRUE(read) << read.error().line();
                EXPECT_EQ(read->mesh.positions_m[0], Vec3(x, 0, 0));
                EXPECT_EQ(read->mesh.positions_m[2], Vec3(0, 1, 0));
                EXPECT_TRUE(read->report.remarks.empty());
            }
        }
    }
}

TEST(MeshText, PlacesInMessagesCountTheMark) {
    const std::string whole = byte_ply("\n", 0), cut = whole.substr(0, whole.size() - 1);
    const auto byte_named = [](const std::string& message) {
        const std::size_t at = message.find(", byte ");
        return at == std::string::npos ? -1 : std::stol(message.substr(at + 7));
    };
    EXPECT_GT(byte_named(refusal(cut, MeshFormat::ply)), 0);
    EXPECT_EQ(byte_named(refusal(kMark + cut, MeshFormat::ply)), byte_named(refusal(cut, MeshFormat::ply)) + 3);
    EXPECT_NE(refusal(kMark + "v 0 0 0\nv 1 0 x\n"s, MeshFormat::obj).find("test.obj:2"), std::string::npos);
}

}  // namespace
}  // namespace burin::geometry::test

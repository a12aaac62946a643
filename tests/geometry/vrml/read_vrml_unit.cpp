// SPDX-License-Identifier: MIT
// What a text may look like, what is refused, and what each file of the corpus in bad/ is refused for.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/file_io.hpp"
#include "tests/geometry/mesh_samples.hpp"
#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry::test {
namespace {

namespace fs = std::filesystem;

const fs::path kBadWorlds = "tests/geometry/vrml/bad";

std::string repeated(const std::string& text, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += text;
    return all;
}

// The faults that a bad world says it has: "# expect LINE:COLUMN words of the message".
struct ExpectedFault {
    std::string place, words;
};

std::vector<ExpectedFault> expected_faults(const std::string& text) {
    std::vector<ExpectedFault> expected;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        constexpr std::string_view kMark = "# expect ";
        const std::size_t at = line.find(kMark);
        if (at == std::string::npos) continue;
        const std::string rest = line.substr(at + kMark.size());
        const std::size_t blank = rest.find(' ');
        expected.push_back({rest.substr(0, blank), rest.substr(blank + 1)});
    }
    return expected;
}

std::vector<Error> faults_of_file(const fs::path& path) {
    const auto file = read_vrml_file(path);
    if (!file) return {file.error()};
    const auto world = shapes_of(*file);
    return world ? std::vector<Error>{} : world.error();
}

}  // namespace

TEST(ReadVrml, TellsEachFaultOfTheBadWorldsWithLineAndColumn) {
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(kBadWorlds)) {
        if (entry.path().extension() != ".wrl") continue;
        ++files;
        SCOPED_TRACE(entry.path().string());
        const std::vector<ExpectedFault> expected = expected_faults(text_of_file(entry.path()));
        const std::vector<Error> found = faults_of_file(entry.path());
        EXPECT_FALSE(expected.empty());
        std::string lines;
        for (const Error& error : found) lines += error.line() + "\n";
        EXPECT_EQ(found.size(), expected.size()) << lines;
        for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
            EXPECT_EQ(found[i].where, entry.path().string() + ":" + expected[i].place) << found[i].line();
            EXPECT_NE(found[i].what.find(expected[i].words), std::string::npos) << found[i].line();
            EXPECT_FALSE(found[i].remedy.empty());
        }
    }
    EXPECT_GE(files, 30u);
}

TEST(ReadVrml, TakesAnyLineEndsAndAByteOrderMark) {
    const std::string text = "#VRML V2.0 utf8 made by hand\n# a comment\n\nShape {\n  geometry Bax }\n";
    for (const std::string end : {"\n", "\r", "\r\n"}) {
        std::string other = "\xEF\xBB\xBF";
        for (const char c : text) other += c == '\n' ? end : std::string(1, c);
        const auto faults = vrml_faults(other);
        ASSERT_EQ(faults.size(), 1u);
        EXPECT_TRUE(faults[0].starts_with("test.wrl:5:12: 'Bax' is not a value of field 'geometry'")) << faults[0];
    }
}

TEST(ReadVrml, CountsColumnsInCharacters) {
    const auto faults = vrml_faults(kVrmlHead + "WorldInfo { title \"\xC3\xA4\xE2\x82\xAC\" } ]");
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_TRUE(faults[0].starts_with("test.wrl:2:26: ")) << faults[0];
}

TEST(ReadVrml, TakesNumbersCommasAndCommentsAsTheStandardHasThem) {
    const VrmlWorld world = vrml_world("Shape{geometry Box{size#a comment\n+1.,.5e1,,0x10}}#end");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_EQ(examine(world.shapes[0].surface->mesh).bounds_m.hi, Vec3(0.5, 2.5, 8));
}

TEST(ReadVrml, RefusesOtherFormatsByName) {
    const auto refusal = [](const std::string& text) {
        const auto file = read_vrml(text, "test.wrl");
        return file ? std::string() : file.error().line();
    };
    EXPECT_TRUE(refusal("#VRML V1.0 ascii\n").starts_with("test.wrl:1:1: is VRML 1.0; convert it"));
    EXPECT_TRUE(refusal("#X3D V3.0 utf8\n").starts_with("test.wrl:1:1: is X3D"));
    EXPECT_TRUE(refusal("<?xml version=\"1.0\"?>\n").starts_with("test.wrl:1:1: is XML, as X3D is; export it"));
    EXPECT_TRUE(refusal("\x1f\x8b\x08").starts_with("test.wrl:1:1: is packed with gzip, and cut short"));
    EXPECT_TRUE(refusal("").starts_with("test.wrl:1:1: is empty"));
    EXPECT_TRUE(refusal("Shape { }").starts_with("test.wrl:1:1: does not begin with '#VRML V2.0 utf8'"));
    EXPECT_TRUE(refusal("#VRML V2.0 utf80").starts_with("test.wrl:1:1: does not begin"));
    EXPECT_TRUE(refusal(std::string("\xFF\xFE#\0V\0", 6)).find("UTF-16") != std::string::npos);
    EXPECT_TRUE(vrml_faults("#VRML V2.0 utf8").empty());
}

TEST(ReadVrml, NestsNoDeeperThanItsBound) {
    const auto nested = [](std::size_t depth) {
        return kVrmlHead + repeated("Group { children [\n", depth) + repeated("] }", depth);
    };
    EXPECT_TRUE(vrml_faults(nested(200)).empty());
    for (const std::size_t depth : {201u, 20'000u}) {
        const auto faults = vrml_faults(nested(depth));
        ASSERT_EQ(faults.size(), 1u);
        EXPECT_TRUE(faults[0].starts_with("test.wrl:202:1: nodes are nested more than 200 deep")) << faults[0];
    }
}

TEST(ReadVrml, CountsWhatUsesMultiply) {
    std::string doubling = kVrmlHead + "DEF N0 Group { }\n";
    for (int i = 1; i <= 29; ++i) {
        const std::string below = "USE N" + std::to_string(i - 1) + " ";
        doubling += "DEF N" + std::to_string(i) + " Group { children [ " + below + below + "] }\n";
    }
    const auto faults = vrml_faults(doubling);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_NE(faults[0].find("more than 1000000 nodes"), std::string::npos) << faults[0];
}

TEST(ReadVrml, CountsTrianglesBeforeTheyTakeMemory) {
    const std::string points = repeated("0 1 ", 10'000), spine = repeated("0 1 0 0 2 0 ", 5'000);
    const auto faults = vrml_faults(kVrmlHead + "Shape { geometry Extrusion { crossSection [ " + points + "] spine [ " +
                                    spine + "] } }");
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_NE(faults[0].find("more than 10000000 triangles"), std::string::npos) << faults[0];
}

TEST(ReadVrml, AChainOfPrototypesIsNoDeeperThanItsBound) {
    std::string chain = kVrmlHead + "PROTO P0 [ ] { Group { } }\n";
    for (int i = 1; i <= 300; ++i)
        chain += "PROTO P" + std::to_string(i) + " [ ] { P" + std::to_string(i - 1) + " { } }\n";
    EXPECT_EQ(vrml_faults(chain + "P300 { }").size(), 1u);
    EXPECT_EQ(vrml_faults(chain + "Shape { geometry P300 { } }").size(), 1u);
    EXPECT_TRUE(vrml_faults(chain + "P150 { }").empty());
}

TEST(ReadVrml, ListsNoMoreFaultsThanItsBound) {
    const auto faults = vrml_faults(kVrmlHead + repeated("] Group { } ", 5'000));
    EXPECT_LE(faults.size(), kMostVrmlFaults + 1);
    EXPECT_GE(faults.size(), kMostVrmlFaults);
}

TEST(ReadVrml, ListsNoMoreTypesThanItsBound) {
    std::string text;
    for (int i = 0; i < 5'000; ++i) text += "A" + std::to_string(i) + "{}";
    const VrmlWorld world = vrml_world(text);
    ASSERT_EQ(world.skipped.size(), kMostVrmlFaults + 1);
    EXPECT_EQ(world.skipped.back().count, 5'000 - kMostVrmlFaults);
}

TEST(ReadVrml, TenThousandWrongIndicesOfAListAreAFewFaults) {
    const auto faults =
        vrml_faults(kVrmlHead + "Shape { geometry IndexedFaceSet { coord Coordinate { point 0 0 0 }\ncoordIndex [ " +
                    repeated("7 ", 10'000) + "] } }");
    ASSERT_EQ(faults.size(), 9u);
    EXPECT_TRUE(faults[0].starts_with("test.wrl:3:12: 10000 indices of this list are wrong")) << faults[0];
    EXPECT_TRUE(faults[1].starts_with("test.wrl:3:14: index 7 names none of the 1 points")) << faults[1];
    EXPECT_TRUE(faults[2].starts_with("test.wrl:3:16: ")) << faults[2];
}

TEST(ReadVrml, InlineOpensNothingOutsideOfTheFoldersFile) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "world");
    static_cast<void>(folder.write("secret.wrl", kVrmlHead + "Shape { geometry Box { } }"));
    fs::create_symlink("../secret.wrl", folder.path() / "world/link.wrl");
    const auto fault_for = [&](const std::string& url) {
        const fs::path path = folder.write("world/w.wrl", kVrmlHead + "Inline { url \"" + url + "\" }");
        const std::vector<Error> faults = faults_of_file(path);
        EXPECT_EQ(faults.size(), 1u) << url;
        if (faults.empty()) return std::string();
        EXPECT_EQ(faults[0].where, path.string() + ":2:14");
        return faults[0].what;
    };
    for (const char* const url : {"../secret.wrl", "/etc/passwd", "a/../../secret.wrl", "..", "sub/", "C:\\\\x.wrl"})
        EXPECT_NE(fault_for(url).find("Inline"), std::string::npos) << url;
    EXPECT_NE(fault_for("http://example.org/a.wrl").find("which is no file of this folder"), std::string::npos);
    EXPECT_NE(fault_for("link.wrl").find("is a link that leads out"), std::string::npos);
    EXPECT_NE(fault_for("lost.wrl").find("cannot be read"), std::string::npos);
    EXPECT_NE(fault_for("w.wrl").find("leads back to 'w.wrl'"), std::string::npos);
}

TEST(ReadVrml, ACycleOfInlinesIsAFaultWhereItCloses) {
    const VrmlOpener opener = [](const std::string& name) -> Result<std::string> {
        return kVrmlHead + "Inline { url \"" + (name == "b.wrl" ? "sub/c.wrl" : "../test.wrl") + "\" }";
    };
    const auto faults = vrml_faults(kVrmlHead + "Inline { url \"b.wrl\" }", opener);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_TRUE(faults[0].starts_with("sub/c.wrl:2:14: an Inline leads back to 'test.wrl'")) << faults[0];
    const VrmlOpener endless = [](const std::string& name) -> Result<std::string> {
        return kVrmlHead + "Inline { url \"x" + name + "\" }";
    };
    EXPECT_EQ(vrml_faults(kVrmlHead + "Inline { url \"x\" }", endless).size(), 1u);
}

TEST(ReadVrml, FaultsOfAnInlinedFileNameThatFile) {
    const VrmlOpener opener = [](const std::string&) -> Result<std::string> {
        return kVrmlHead + "\nShape { geometry Sphere { radius 1 2 } }";
    };
    const auto faults = vrml_faults(kVrmlHead + "Inline { url \"ball.wrl\" }", opener);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_TRUE(faults[0].starts_with("ball.wrl:3:34: 'radius' takes 1 number, and has 2")) << faults[0];
}

TEST(ReadVrml, TheTreeKeepsNamesFieldsAndPlaces) {
    const auto file =
        read_vrml(kVrmlHead + "DEF A Group {\n  children [ USE A1 DEF B Shape { } USE B ] size 1 2 3 }", "t");
    ASSERT_TRUE(file);
    ASSERT_EQ(file->nodes.size(), 2u);
    EXPECT_EQ(file->name_of(file->nodes[0]), "A");
    EXPECT_EQ(file->type_of(file->nodes[1]), "Shape");
    EXPECT_EQ(file->where({0, file->nodes[1].at}), "t:3:27");
    const auto fields = file->fields_of(file->nodes[0]);
    ASSERT_EQ(fields.size(), 2u);
    EXPECT_EQ(fields[0].count, 2u);
    EXPECT_EQ(fields[1].kind, VrmlKind::numbers);
    EXPECT_EQ(file->where(file->place_of_value(0, fields[1], 2)), "t:3:54");
    EXPECT_EQ(file->faults.size(), 1u);  // A1
}

}  // namespace burin::geometry::test

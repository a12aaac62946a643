// SPDX-License-Identifier: MIT
// Worlds that other programs show and that are not what the standard says: one detail loses no file. What is read
// otherwise than it stands there is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "geometry/vrml/vrml_text.hpp"
#include "tests/geometry/vrml/vrml_samples.hpp"
#include "tests/support/run_command.hpp"

namespace burin::geometry::test {
namespace {

const std::string kBox = "Shape { geometry Box { size .1 .1 .1 } }";

bool tells(const VrmlWorld& world, const std::string& words) {
    return std::ranges::any_of(world.remarks, [&](const Error& e) { return e.line().contains(words); });
}

// "DEF Part Shape ..." with gzip -9n.
std::string packed_world() {
    const Workplace place;
    place.write("w.wrl", kVrmlHead + kBox);
    EXPECT_EQ(place.run("gzip -9n w.wrl").status, 0);
    return place.read("w.wrl.gz");
}

}  // namespace

// The second was dropped without a word.
TEST(OddWorlds, PackedInSeveralMembersAreReadWhole) {
    const Workplace place;
    place.write("w.wrl", kVrmlHead + kBox);
    place.write("more.wrl", "\nDEF Second " + kBox);
    ASSERT_EQ(place.run("gzip -9n w.wrl more.wrl && cat w.wrl.gz more.wrl.gz > both.wrl.gz").status, 0);
    for (const std::string& tail : {std::string(), std::string("not packed")}) {
        const auto file = read_vrml(place.read("both.wrl.gz") + tail, "both.wrl.gz");
        ASSERT_TRUE(file) << file.error().line();
        const auto world = shapes_of(*file);
        ASSERT_TRUE(world);
        EXPECT_EQ(world->shapes.size(), 2u) << tail;
    }
    const std::string whole = place.read("both.wrl.gz");
    EXPECT_FALSE(read_vrml(whole.substr(0, whole.size() - 12), "both.wrl.gz")) << "the second is cut short";
}

TEST(OddWorlds, WithARouteAmongNodesAreShown) {
    const VrmlWorld world =
        vrml_world("DEF G Group { children [ DEF X " + kBox + " ROUTE X.a TO X.b ] ROUTE G.a TO G.b }");
    EXPECT_EQ(world.shapes.size(), 1u);
    EXPECT_TRUE(world.remarks.empty());
}

TEST(OddWorlds, WithAnEmptyProtoAreShown) {
    const VrmlWorld world = vrml_world(
        "PROTO Link [ field SFString name \"\" field SFVec3f axis 0 0 1 ] { }\n"
        "DEF Part " +
        kBox + " Link { name \"a\" } Link { }");
    EXPECT_EQ(world.shapes.size(), 1u);
    ASSERT_EQ(world.skipped.size(), 1u);
    EXPECT_EQ(world.skipped[0].type, "Link");
    EXPECT_EQ(world.skipped[0].count, 2u);
}

TEST(OddWorlds, WithABoxWithoutThicknessShowAPlateOfBothSides) {
    const std::pair<const char*, Vec3> flat[] = {{"2 0 2", {1, 0, 1}}, {"0 2 2", {0, 1, 1}}, {"2 2 0", {1, 1, 0}}};
    for (const auto& [size, half] : flat) {
        const VrmlWorld world = vrml_world("Shape { geometry Box { size " + std::string(size) + " } }");
        ASSERT_EQ(world.shapes.size(), 1u) << size;
        const VrmlSurface& plate = *world.shapes[0].surface;
        EXPECT_EQ(plate.mesh.triangles.size(), 2u);
        EXPECT_TRUE(plate.two_sided);
        const MeshHealth health = examine(plate.mesh);
        EXPECT_EQ(health.degenerate_triangles, 0u);
        EXPECT_EQ(health.bounds_m.hi, half) << size;
        EXPECT_TRUE(tells(world, "shown as a plate")) << size;
    }
}

TEST(OddWorlds, WithASizeOfNothingLeaveThatShapeOutAndTell) {
    for (const char* const geometry :
         {"Box { size 1 -2 3 }", "Box { size 1 0 0 }", "Sphere { radius 0 }", "Cone { bottomRadius -1 }",
          "Cone { height 0 }", "Cylinder { radius 0 }", "Cylinder { height -1 }",
          "ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ] xSpacing 0 }"}) {
        const VrmlWorld world = vrml_world(kBox + " Shape { geometry " + geometry + " }");
        EXPECT_EQ(world.shapes.size(), 1u) << geometry;
        EXPECT_TRUE(tells(world, "not above zero")) << geometry;
        EXPECT_TRUE(tells(world, "left out")) << geometry;
    }
}

TEST(OddWorlds, WithColoursALittleAboveOneAreShownInTheNearestAndTell) {
    const VrmlWorld world = vrml_world(
        "Shape { appearance Appearance { material Material { diffuseColor 1.0001 -0.5 0.5 transparency 2 } }\n"
        "  geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 2 ]\n"
        "    color Color { color [ 1.00001 0 0, 0 1 0, 0 0 -1e-7 ] } } }");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_EQ(world.shapes[0].colour, (VrmlColour{255, 0, 128}));
    EXPECT_EQ(world.shapes[0].transparency, 1.0);
    ASSERT_EQ(world.shapes[0].surface->corner_colours.size(), 1u);
    EXPECT_EQ(world.shapes[0].surface->corner_colours[0],
              (std::array<VrmlColour, 3>{{{255, 0, 0}, {0, 255, 0}, {0, 0, 0}}}));
    EXPECT_EQ(std::ranges::count_if(world.remarks, [](const Error& e) { return e.what.contains("not from 0 to 1"); }),
              5);
    EXPECT_TRUE(tells(world, "1.0001, not from 0 to 1; it is taken for 1")) << world.remarks[0].line();
}

TEST(OddWorlds, OfAPrototypeInAnotherFileShowIt) {
    const std::string parts = kVrmlHead +
                              "PROTO Ball [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }\n"
                              "PROTO Block [ ] { " +
                              kBox + " }";
    const VrmlWorld world = vrml_world(
        "EXTERNPROTO Mine [ field SFFloat r ] [ \"http://x.org/a.wrl#Ball\" \"parts/p.wrl#Ball\" ]\n"
        "EXTERNPROTO Block [ ] \"parts/p.wrl\"\nMine { r 0.25 } Mine { } Block { }",
        {{"parts/p.wrl", parts}});
    ASSERT_EQ(world.shapes.size(), 3u);
    EXPECT_EQ(examine(world.shapes[0].surface->mesh).bounds_m.hi.y, 0.25);
    EXPECT_EQ(examine(world.shapes[1].surface->mesh).bounds_m.hi.y, 1.0) << "the other file's default";
    EXPECT_EQ(world.shapes[2].surface->mesh.triangles.size(), 12u);
}

TEST(OddWorlds, OfAPrototypeThatIsNowhereShowTheRestAndTell) {
    const std::string own = "EXTERNPROTO Mine [ ] ";
    const std::map<std::string, std::string> files{{"p.wrl", kVrmlHead + kBox}, {"me.wrl", kVrmlHead}};
    for (const auto& [url, words] : {std::pair{"\"none.wrl\"", "does not exist"},
                                     {"\"p.wrl#Mine\"", "has no PROTO"},
                                     {"\"../p.wrl\"", "--root"},
                                     {"\"urn:inet:x:Mine\"", "no file of this folder"}}) {
        const VrmlWorld world = vrml_world(own + url + "\n" + kBox + " Mine { }", files);
        EXPECT_EQ(world.shapes.size(), 1u) << url;
        EXPECT_TRUE(tells(world, words)) << url;
        EXPECT_EQ(world.skipped.size(), 1u) << url;
    }
}

TEST(OddWorlds, InlinedFromAFolderAboveAreRefusedUnlessTheRootAllowsIt) {
    const Workplace place;
    std::filesystem::create_directories(place / "all/world");
    place.write("all/world/w.wrl", kVrmlHead + "Inline { url \"../parts.wrl\" }");
    place.write("all/parts.wrl", kVrmlHead + kBox);
    place.write("secret.wrl", kVrmlHead + kBox);
    const auto refused = read_vrml_file(place / "all/world/w.wrl");
    ASSERT_TRUE(refused);
    ASSERT_EQ(refused->faults.size(), 1u);
    EXPECT_TRUE(refused->error_of(refused->faults[0]).line().contains("--root"));
    const auto allowed = read_vrml_file(place / "all/world/w.wrl", place / "all");
    ASSERT_TRUE(allowed) << allowed.error().line();
    const auto world = shapes_of(*allowed);
    ASSERT_TRUE(world) << world.error()[0].line();
    EXPECT_EQ(world->shapes.size(), 1u);
    place.write("all/world/w.wrl", kVrmlHead + "Inline { url \"../../secret.wrl\" }");
    const auto beyond = read_vrml_file(place / "all/world/w.wrl", place / "all");
    ASSERT_TRUE(beyond);
    EXPECT_EQ(beyond->faults.size(), 1u) << "the root is the end";
    const auto elsewhere = read_vrml_file(place / "secret.wrl", place / "all");
    ASSERT_FALSE(elsewhere);
    EXPECT_TRUE(elsewhere.error().line().contains("is no folder in which")) << elsewhere.error().line();
}

TEST(OddWorlds, InlinedWithABackslashAreToldToWriteASlash) {
    const auto faults = vrml_faults(kVrmlHead + "Inline { url \"sub folder\\\\part.wrl\" }",
                                    [](const std::string&) -> Result<std::string> { return ""; });
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_TRUE(faults[0].contains("write / between folder and file")) << faults[0];
}

TEST(OddWorlds, PackedWithGzipAreRead) {
    const std::string packed = packed_world();
    const auto file = read_vrml(packed, "w.wrz");
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(shapes_of(*file)->shapes.size(), 1u);
    const auto cut = read_vrml(packed.substr(0, packed.size() / 2), "w.wrz");
    ASSERT_FALSE(cut);
    EXPECT_TRUE(cut.error().line().contains("cut short")) << cut.error().line();
    std::string broken = packed;
    broken[packed.size() / 2] ^= 0x55;
    const auto damaged = read_vrml(broken, "w.wrz");
    ASSERT_FALSE(damaged);
    EXPECT_TRUE(damaged.error().line().contains("w.wrz:1:1: is packed with gzip")) << damaged.error().line();
    const auto many = gunzipped(packed, 20, "w.wrz");
    ASSERT_FALSE(many);
    EXPECT_TRUE(many.error().line().contains("more than 20 bytes")) << many.error().line();
}

TEST(OddWorlds, InLatin1HaveTheirNamesInUtf8) {
    const VrmlWorld world = vrml_world("# M\xfcller\nDEF T\xfcr " + kBox);
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_EQ(world.shapes[0].name, "T\xc3\xbcr");
    EXPECT_TRUE(tells(world, "read as Latin-1"));
    EXPECT_FALSE(tells(vrml_world("DEF T\xc3\xbcr " + kBox), "Latin-1"));
}

// A point that no face names, a colour, a normal: the shape does not depend on these.
TEST(OddWorlds, LeaveOutWhatIsNoNumberWhereTheShapeDoesNotNeedIt) {
    const std::string start =
        "Shape { appearance Appearance { material Material { diffuseColor nan 0 0 } } geometry IndexedFaceSet { "
        "coordIndex [0 1 2] coord Coordinate { point [0 0 0, 1 0 0, 0 1 0, ";
    const std::string rest =
        "] } color Color { color [1 0 0, nan 0 1, 0 0 1, 0 0 1] } normal Normal { vector [nan nan nan] } } }";
    for (const char* const point : {"nan 0 0", "0 -inf 0", "0 0 2e9", "-nan 1e999 0"}) {
        const VrmlWorld world = vrml_world(start + point + rest);
        ASSERT_EQ(world.shapes.size(), 1u) << point;
        const VrmlSurface& surface = *world.shapes[0].surface;
        ASSERT_EQ(surface.corner_colours.size(), 1u);
        EXPECT_EQ(surface.corner_colours[0][0], (VrmlColour{255, 0, 0}));
        EXPECT_EQ(surface.corner_colours[0][1], (VrmlColour{204, 204, 204}));
        EXPECT_EQ(examine(surface.mesh).bounds_m.extent(), Vec3(1.0, 1.0, 0.0)) << point;
        EXPECT_TRUE(tells(world, "no face names the point"));
        EXPECT_TRUE(tells(world, "a colour is no number"));
        EXPECT_TRUE(tells(world, "'diffuseColor' has a colour that is no number"));
    }
    std::string used = start + "nan 0 0" + rest;
    const auto faults = vrml_faults(kVrmlHead + used.replace(used.find("[0 1 2]"), 7, "[0 1 3]"));
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_TRUE(faults[0].contains("is not a finite number")) << faults[0];
}

TEST(OddWorlds, OfAnyBytesAreUtf8OrLatin1) {
    for (const char* const sound : {"", "a", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xef\xbf\xbf",
                                    "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
        EXPECT_TRUE(is_utf8(sound)) << sound;
    for (const char* const broken : {"\x80", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf",
                                     "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "a\xc3", "\xe2\x82", "\xfc r"})
        EXPECT_FALSE(is_utf8(broken)) << broken;
    EXPECT_EQ(utf8_of_latin1("\x7f\x80\xbf\xc0\xff"), "\x7f\xc2\x80\xc2\xbf\xc3\x80\xc3\xbf");
}

}  // namespace burin::geometry::test

// SPDX-License-Identifier: MIT
// World files as people write them, right and wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/mesh_part.hpp"
#include "scene/world_file.hpp"
#include "tests/geometry/touch_samples.hpp"
#include "tests/support/run_command.hpp"

namespace burin::scene {
namespace {

// Meshes by name: "cube.obj" is sound, "open.obj" lacks a triangle, "inside.obj" faces inwards.
Result<geometry::ImportedMesh> sample_mesh(const std::string& name, std::optional<LengthUnit> unit) {
    geometry::ImportedMesh imported;
    imported.mesh = geometry::test::cube(unit == LengthUnit::mm ? 0.00001 : 0.01);
    if (name == "open.obj") imported.mesh.triangles.pop_back();
    if (name == "inside.obj")
        for (auto& t : imported.mesh.triangles) std::swap(t[0], t[1]);
    if (name == "huge.obj")
        for (Vec3& p : imported.mesh.positions_m) p *= 1e6;
    if (name == "lost.obj") return fail("lost.obj", "cannot be read", "check its name");
    return imported;
}

WorldOrProblems parsed(const std::string& text) { return parse_world(text, "w.toml", sample_mesh); }

// The problems of a text, a line each.
std::vector<std::string> faults_of(const std::string& text) {
    std::vector<std::string> lines;
    const WorldOrProblems world = parsed(text);
    if (!world)
        for (const Error& error : world.error()) lines.push_back(error.where + ": " + error.what);
    return lines;
}
using Lines = std::vector<std::string>;

const std::string kCube = "[[object]]\nname = \"a\"\nmesh = \"cube.obj\"\n";

TEST(WorldFile, HoldsWhatItSays) {
    const WorldOrProblems world = parsed(R"(name = "Yard"
[[object]]
name = "stone"
mesh = "cube.obj"
mesh_units = "mm"
position = [1, 2, 3]
orientation = [0, 1, 0, 0]
scale = 2
colour = "#8a0fFF"
seen = false
felt = true
both_sides = true
material = { stiffness = 900, damping = 2, static_friction = 0.5, dynamic_friction = 0.25, coulomb_velocity = 0.02 }
repeat = false
[[object.path]]
time = 0
[[object.path]]
time = 1
position = [0, 0.5, 0]
[[object]]
name = "leaf"
mesh = "cube.obj"
[object.material]
dynamic_friction = 0.3
)");
    ASSERT_TRUE(world.has_value()) << world.error().front().line();
    EXPECT_EQ(world->name, "Yard");
    ASSERT_EQ(world->objects.size(), 2u);
    const SceneObject &stone = world->objects[0], &leaf = world->objects[1];
    EXPECT_EQ(stone.id, 1u);
    EXPECT_EQ(stone.name, "stone");
    EXPECT_EQ(stone.mesh->positions_m[0], geometry::test::cube(0.00001).positions_m[0]);
    EXPECT_EQ(stone.pose.position_m, Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(stone.pose.orientation, Quat(0.0, 0.0, 1.0, 0.0));
    EXPECT_EQ(stone.scale, 2.0);
    EXPECT_EQ(stone.colour, (Colour{0x8a, 0x0f, 0xff}));
    EXPECT_FALSE(stone.seen);
    EXPECT_TRUE(stone.both_sides);
    EXPECT_EQ(stone.material, (HapticMaterial{900.0, 2.0, 0.5, 0.25, 0.02}));
    const PathMotion path{{{0.0, {}}, {1.0, {{0.0, 0.5, 0.0}}}}, false};
    EXPECT_EQ(std::get<PathMotion>(stone.motion), path);
    EXPECT_EQ(leaf.id, 2u);
    EXPECT_TRUE(leaf.seen && leaf.felt && !leaf.both_sides);
    EXPECT_EQ(leaf.material, (HapticMaterial{.static_friction = 0.3, .dynamic_friction = 0.3}));
    EXPECT_TRUE(std::holds_alternative<FixedMotion>(leaf.motion));
}

TEST(WorldFile, AllProblemsOfAFileAreListedAtOnce) {
    EXPECT_EQ(faults_of(R"([[object]]
name = "a"
mesh = "lost.obj"
scale = -1
[[object]]
name = "a"
mesh = "open.obj"
colour = "red"
weight = 3
[[object]]
mesh = "inside.obj"
material = { stiffness = 0, hardness = 3 }
[[object.path]]
time = 0
[[object.path]]
time = 0.1
position = [1, 0, 0]
[[object]]
name = "c"
mesh = "huge.obj"
repeat = true
)"),
              (Lines{"w.toml:3: mesh cannot be used: lost.obj: cannot be read", "w.toml:4: scale is -1",
                     "w.toml:6: name \"a\" is also that of the object in line 2",
                     "w.toml:7: mesh is open: 3 edges have a triangle on one side only", "w.toml:8: colour is red",
                     "w.toml:9: [[object]] has no key named weight", "w.toml:10: [[object]] has no name",
                     "w.toml:11: mesh is inside out: its triangles face inwards",
                     "w.toml:12: [object.material] has no key named hardness", "w.toml:12: stiffness is 0",
                     "w.toml:15: path[1] jumps: 1 m in 0.1 s", "w.toml:20: mesh reaches 1.73e+04 m from its origin",
                     "w.toml:21: repeat stands where there is no path"}));
}

TEST(WorldFile, AnOpacityOutOfBoundsIsToldWithAllItsDigits) {
    EXPECT_EQ(faults_of(kCube + "opacity = 1.0000001\n"), Lines{"w.toml:4: opacity is 1.0000001"});
    EXPECT_EQ(faults_of(kCube + "opacity = -0.5\n"), Lines{"w.toml:4: opacity is -0.5"});
    const WorldOrProblems over = parsed(kCube + "opacity = 2\n"), word = parsed(kCube + "opacity = \"half\"\n");
    ASSERT_FALSE(over || word);
    EXPECT_EQ(over.error().front().remedy, "give a number from 0, clear as glass, to 1, which hides what is behind");
    EXPECT_EQ(word.error().front().remedy, "write opacity = 0.5, say") << "an example within the bounds";
    EXPECT_EQ(faults_of(kCube + "[object.material]\nstiffness = 100000.5\n"), Lines{"w.toml:5: stiffness is 100000.5"});
}

// They reach terminals and recordings: an escape sequence in a file of somebody else's would be carried out.
TEST(WorldFile, NamesAreWordsOnALine) {
    for (const char* name : {"a\\nb", "\\u001b[31m", "\\u0000", "\\u007f", "a\\tb"})
        EXPECT_EQ(faults_of("[[object]]\nname = \"" + std::string(name) + "\"\nmesh = \"cube.obj\"\n"),
                  Lines{"w.toml:2: name holds control characters"})
            << name;
    EXPECT_EQ(faults_of("[[object]]\nname = \"  \"\nmesh = \"cube.obj\"\n"), Lines{"w.toml:2: name is empty"});
    EXPECT_EQ(faults_of("[[object]]\nname = \"" + std::string(201, 'x') + "\"\nmesh = \"cube.obj\"\n"),
              Lines{"w.toml:2: name has 201 bytes"});
    EXPECT_EQ(faults_of("name = \"\\u001b]0;x\"\n" + kCube), Lines{"w.toml:1: name holds control characters"});
    EXPECT_TRUE(parsed("name = \"Gärten\"\n[[object]]\nname = \"der Stein\"\nmesh = \"cube.obj\"\n"));
}

TEST(WorldFile, AnOpenMeshIsFeltFromBothSidesOrNotAtAll) {
    for (const char* mesh : {"open.obj", "inside.obj"}) {
        const std::string object = "[[object]]\nname = \"a\"\nmesh = \"" + std::string(mesh) + "\"\n";
        EXPECT_EQ(faults_of(object).size(), 1u) << mesh;
        EXPECT_EQ(faults_of(object + "both_sides = true"), Lines{}) << mesh;
        EXPECT_EQ(faults_of(object + "felt = false"), Lines{}) << mesh;
    }
}

TEST(WorldFile, WhatIsNoWorldIsNamed) {
    EXPECT_EQ(faults_of("[[object"),
              (Lines{parsed("[[object").error().front().where + ": " + parsed("[[object").error().front().what}));
    EXPECT_EQ(faults_of(""), Lines{"w.toml:1: the file has no object"});
    EXPECT_EQ(faults_of("object = 3"), Lines{"w.toml:1: object is not a list of tables"});
    EXPECT_EQ(faults_of("object = []"), Lines{"w.toml:1: object is not a list of tables"});
    EXPECT_EQ(faults_of(kCube + "position = [1, 2]\norientation = [0, 0, 0, 0]"),
              (Lines{"w.toml:4: position is not a list of 3 numbers", "w.toml:5: orientation has no length"}));
    EXPECT_EQ(faults_of(kCube + "position = [1, nan, 0]"), Lines{"w.toml:4: position is not a list of 3 numbers"});
    EXPECT_EQ(faults_of(kCube + "path = []"), Lines{"w.toml:4: path is not a list of tables"});
    EXPECT_EQ(faults_of(kCube + "mesh_units = \"miles\""), Lines{"w.toml:4: mesh_units is miles"});
}

TEST(WorldFile, OneMoreMaterialThanThereIsRoomForIsNamed) {
    std::string text;
    for (std::size_t i = 0; i <= kMaxWorldMaterials; ++i)
        text += "[[object]]\nname = \"" + std::to_string(i) +
                "\"\nmesh = \"cube.obj\"\nmaterial = { stiffness = " + std::to_string(100 + i) + " }\n";
    EXPECT_EQ(faults_of(text).size(), 1u);
    EXPECT_EQ(faults_of(text).front().substr(0, 10), "w.toml:" + std::to_string(4 * kMaxWorldMaterials + 1) + ":");
}

TEST(WorldFile, AThousandObjectsShareOneMesh) {
    int reads = 0;
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text +=
            "[[object]]\nname = \"" + std::to_string(i) + "\"\nmesh = \"" + (i % 2 == 0 ? "" : "./") + "cube.obj\"\n";
    const WorldOrProblems world = parse_world(text, "w.toml", [&](const std::string& name, auto unit) {
        ++reads;
        return sample_mesh(name, unit);
    });
    ASSERT_TRUE(world.has_value());
    EXPECT_EQ(world->objects.size(), 1000u);
    EXPECT_EQ(world->objects[0].mesh, world->objects[999].mesh);
    EXPECT_EQ(reads, 1);
    std::string many;
    for (std::size_t i = 0; i <= kMaxWorldObjects; ++i) many += "[[object]]\n";
    EXPECT_EQ(faults_of(many).size(), 1u) << "more objects than a world holds are not read at all";
}

TEST(WorldFile, TheGardenHasTenThingsOfDifferentFeel) {
    const WorldOrProblems world = read_world("assets/worlds/garden.toml");
    ASSERT_TRUE(world.has_value()) << world.error().front().line();
    EXPECT_EQ(world->objects.size(), 10u);
    EXPECT_TRUE(world->remarks.empty()) << world->remarks.front();
    int moving = 0, unseen = 0;
    for (const SceneObject& object : world->objects) {
        moving += std::holds_alternative<PathMotion>(object.motion) ? 1 : 0;
        unseen += object.seen ? 0 : 1;
        EXPECT_TRUE(object.felt) << object.name;
        const auto alike = std::ranges::count(world->objects, object.material, &SceneObject::material);
        EXPECT_EQ(alike, 1) << object.name;
        // The box that the file and the README speak of.
        for (const Vec3& p : object.mesh->positions_m) {
            const Vec3 at = object.pose * (object.scale * p);
            EXPECT_LE(std::abs(at.x), 0.1701) << object.name;
            EXPECT_LE(std::abs(at.z), 0.1201) << object.name;
            EXPECT_GE(at.y, -0.0201) << object.name;
            EXPECT_LE(at.y, 0.14) << object.name;
        }
    }
    EXPECT_EQ(moving, 1);
    EXPECT_EQ(unseen, 1);
    MaterialTable materials(1);
    EXPECT_TRUE(MeshPart::create(world->objects, materials).has_value());
}

// A world knows no --units.
TEST(WorldFile, TellsHowItReadAMeshAndWhatToWriteIfThatIsWrong) {
    const Workplace place;
    place.write("tetra.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    place.write("w.toml", "[[object]]\nname = \"a\"\nmesh = \"tetra.off\"\n");
    const WorldOrProblems world = read_world(place / "w.toml");
    ASSERT_TRUE(world);
    EXPECT_EQ(world->remarks,
              Lines{"tetra.off: 1000 x 1000 x 1000 mm (no unit that Burin knows is given in the file; read as metres, "
                    "since its longest side is at most 5; mesh_units = \"mm\" in the [[object]] of a world reads it as "
                    "millimetres)"});
}

// They were read for a workpiece alone.
TEST(WorldFile, AnObjectHasTheFirstColourOfItsMaterialFile) {
    const Workplace place;
    place.write("crate.mtl", "newmtl wood\nKd 0.8 0.4 0.2\nnewmtl iron\nKd 0 0 0\n");
    place.write("crate.obj",
                "mtllib crate.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl wood\nf 1 3 2\nf 1 2 4\n"
                "usemtl iron\nf 1 4 3\nf 2 3 4\n");
    place.write("w.toml",
                "[[object]]\nname = \"a\"\nmesh = \"crate.obj\"\n[[object]]\nname = \"b\"\nmesh = \"crate.obj\"\n"
                "colour = \"#010203\"\n");
    const WorldOrProblems world = read_world(place / "w.toml");
    ASSERT_TRUE(world);
    EXPECT_EQ(world->objects[0].colour, (Colour{204, 102, 51}));
    EXPECT_EQ(world->objects[1].colour, (Colour{1, 2, 3}));
}

TEST(WorldFile, ReadsMeshesInItsFolderAndNoOthers) {
    const Workplace place;
    std::filesystem::create_directory(place / "yard");
    const std::string off = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    place.write("secret.off", off);
    place.write("yard/tetra.off", off);
    std::filesystem::create_symlink(place / "secret.off", place / "yard" / "link.off");
    const auto faults = [&](const std::string& mesh) {
        place.write("yard/w.toml", "[[object]]\nname = \"a\"\nmesh = '" + mesh + "'\n");
        const WorldOrProblems world = read_world(place / "yard" / "w.toml");
        return world ? std::string() : world.error().front().what;
    };
    EXPECT_EQ(faults("tetra.off"), "");
    EXPECT_EQ(faults("../yard/tetra.off"), "mesh cannot be used: ../yard/tetra.off: is not in the world's folder");
    for (const std::string& name : {std::string("../secret.off"), (place / "secret.off").string(), std::string(),
                                    std::string("link.off"), std::string("."), std::string("lost.off")})
        EXPECT_NE(faults(name), "") << name;
    EXPECT_FALSE(read_world(place / "yard").has_value());
    EXPECT_FALSE(read_world(place / "lost.toml").has_value());
}

}  // namespace
}  // namespace burin::scene

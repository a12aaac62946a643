// SPDX-License-Identifier: MIT
// Settings beside a world in VRML.
#include "scene/world_settings.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/vrml_world.hpp"
#include "tests/support/run_command.hpp"

namespace burin::scene {
namespace {

constexpr const char* kTwoBoxes =
    "#VRML V2.0 utf8\n"
    "DEF Rock Shape { geometry Box { size .1 .1 .1 } }\n"
    "Transform { translation 1 0 0 children DEF Moss Shape { geometry Box { size .2 .2 .2 } } }\n";

WorldOrProblems two_boxes_with(const std::string& settings) {
    const Workplace place;
    place.write("yard.wrl", kTwoBoxes);
    place.write("yard.toml", settings);
    return read_any_world(place / "yard.wrl");
}

// Returns all problems as lines, the folder left out.
std::string told(const std::string& settings) {
    const WorldOrProblems world = two_boxes_with(settings);
    std::string lines;
    if (!world)
        for (Error problem : world.error()) {
            problem.where = std::filesystem::path(problem.where).filename().string();
            lines += problem.line() + "\n";
        }
    return lines;
}

}  // namespace

// It was taken without a word, and one could push through the sheet from behind.
TEST(WorldSettings, AnOpenSheetFeltFromOneSideIsRemarkedOn) {
    const Workplace place;
    place.write(
        "sheet.wrl",
        "#VRML V2.0 utf8\nDEF Sheet Shape { geometry IndexedFaceSet { solid FALSE coord Coordinate { point [0 0 "
        "0, .1 0 0, .1 .1 0] } coordIndex [0 1 2 -1] } }\n");
    const auto remarks = [&](const std::string& settings) {
        place.write("sheet.toml", "[[object]]\nname = \"Sheet\"\n" + settings);
        const WorldOrProblems world = read_any_world(place / "sheet.wrl");
        return world ? world->remarks : std::vector<std::string>{"refused"};
    };
    EXPECT_TRUE(remarks("both_sides = true\n").empty());
    ASSERT_EQ(remarks("both_sides = false\n").size(), 1u);
    EXPECT_TRUE(remarks("both_sides = false\n")[0].contains("sheet.toml:3: Sheet is open"));
    EXPECT_TRUE(remarks("felt = false\nboth_sides = false\n").empty()) << "nobody feels it";
}

TEST(WorldSettings, GivenForAWorldNameTheWorld) {
    const Workplace place;
    place.write("yard.wrl", kTwoBoxes);
    place.write("yard.toml", "[[object]]\nname = \"Moss\"\nscale = 2\n");
    const WorldOrProblems world = read_any_world(place / "yard.toml");
    ASSERT_FALSE(world);
    EXPECT_TRUE(world.error().front().line().contains("yard.wrl: its settings are read with it"))
        << world.error().front().line();
}

TEST(WorldSettings, ChangeWhatTheyNameAndLeaveTheRest) {
    const WorldOrProblems world = two_boxes_with(
        "name = \"A yard\"\n[[object]]\nname = \"Moss\"\nposition = [0, 0.5, 0]\nscale = 2\ncolour = \"#10ff20\"\n"
        "seen = false\n[object.material]\nstiffness = 150\nstatic_friction = 0.4\n");
    ASSERT_TRUE(world) << world.error().front().line();
    EXPECT_EQ(world->name, "A yard");
    ASSERT_EQ(world->objects.size(), 2u);
    const SceneObject &rock = world->objects[0], &moss = world->objects[1];
    EXPECT_EQ(displacement_m(moss), Vec3(0.0, 0.5, 0.0));
    EXPECT_EQ(moss.scale, 2.0);
    EXPECT_EQ(moss.colour, (Colour{0x10, 0xff, 0x20}));
    EXPECT_FALSE(moss.seen);
    EXPECT_TRUE(moss.felt);
    EXPECT_EQ(moss.material.stiffness_N_per_m, 150.0);
    EXPECT_EQ(moss.material.damping_Ns_per_m, HapticMaterial{}.damping_Ns_per_m);
    EXPECT_EQ(moss.material.dynamic_friction, 0.4) << "one friction stands for both";
    EXPECT_EQ(rock.material, HapticMaterial{});
    EXPECT_EQ(rock.pose, Pose{});
    EXPECT_TRUE(rock.seen && rock.felt);
}

TEST(WorldSettings, GiveAnObjectAPath) {
    const WorldOrProblems world = two_boxes_with(
        "[[object]]\nname = \"Rock\"\nrepeat = false\n[[object.path]]\ntime = 0\n[[object.path]]\ntime = 2\n"
        "position = [0, 0, 0.1]\n");
    ASSERT_TRUE(world) << world.error().front().line();
    const auto* path = std::get_if<PathMotion>(&world->objects[0].motion);
    ASSERT_NE(path, nullptr);
    EXPECT_EQ(path->keys.size(), 2u);
    EXPECT_FALSE(path->repeats);
}

TEST(WorldSettings, TellEveryProblemAtItsLine) {
    EXPECT_EQ(told("[[object]]\nname = \"Mos\"\nfelt = false\n"
                   "[[object]]\nname = \"Rock\"\nscale = -1\ncolour = \"red\"\nmesh = \"rock.stl\"\n"
                   "[object.material]\nstiffness = 0\n"
                   "[[object]]\nname = \"Rock\"\nsen = true\n"),
              "yard.toml:2: name is Mos, which the world does not have; did you mean Moss? It has: Rock, Moss\n"
              "yard.toml:6: scale is -1; give a factor from 1e-6 to 1e6\n"
              "yard.toml:7: colour is red; write red, green and blue as \"#c08040\", say\n"
              "yard.toml:8: mesh has no place here, since the shape is the world's; leave it out\n"
              "yard.toml:10: stiffness is 0; give N/m above 0 and up to 1e+05, such as 600; felt = false makes "
              "an object that is not felt\n"
              "yard.toml:12: name is Rock again, after line 5; write all of an object into one table\n"
              "yard.toml:13: [[object]] has no key named sen; did you mean seen?\n");
    EXPECT_NE(told("[[object]]\nfelt = false\n").find("[[object]] has no name"), std::string::npos);
    EXPECT_NE(told("[object\n").find("is not TOML"), std::string::npos);
}

TEST(WorldSettings, AWorldWithoutThemIsAsItsFileSays) {
    const Workplace place;
    place.write("yard.wrl", kTwoBoxes);
    const WorldOrProblems world = read_any_world(place / "yard.wrl");
    ASSERT_TRUE(world);
    EXPECT_EQ(world->objects[1].material, HapticMaterial{});
}

// A link whose file has been moved away was taken for no settings at all.
TEST(WorldSettings, ALinkToNothingIsTold) {
    const Workplace place;
    place.write("yard.wrl", kTwoBoxes);
    std::filesystem::create_symlink("moved-away.toml", place / "yard.toml");
    const WorldOrProblems world = read_any_world(place / "yard.wrl");
    ASSERT_FALSE(world);
    EXPECT_TRUE(world.error().front().line().contains("yard.toml: cannot be read")) << world.error().front().line();
}

TEST(WorldSettings, OfTheTubeMakeItsCapsSeenAndNotFelt) {
    const WorldOrProblems world = read_any_world("assets/worlds/tube.wrl");
    ASSERT_TRUE(world) << world.error().front().line();
    for (const SceneObject& object : world->objects) {
        EXPECT_TRUE(object.seen);
        EXPECT_EQ(object.felt, !object.name.ends_with("Cap")) << object.name;
    }
}

}  // namespace burin::scene

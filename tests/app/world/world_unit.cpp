// SPDX-License-Identifier: MIT
// burin world, as a user's shell runs it.
#include <gtest/gtest.h>

#include "base/json.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kWorldBurin = kBurinCommand;
const std::string kWorldHead = "#VRML V2.0 utf8\n";

bool tells(const Workplace::Outcome& outcome, const std::string& text) {
    return outcome.output.find(text) != std::string::npos;
}

}  // namespace

TEST(WorldCommand, TellsWhatIsInAWorld) {
    const Workplace place;
    place.write("w.wrl", kWorldHead +
                             "DEF Table Transform { translation 0 1 0 children Shape {\n"
                             "appearance Appearance { material Material { diffuseColor 1 0 0 } }\n"
                             "geometry Box { size 0.1 0.2 0.3 } } }\nViewpoint { }");
    const auto outcome = place.run(kWorldBurin + " world check w.wrl --json r.json");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(tells(outcome, "w.wrl: 1 shape, 12 triangles, 100 x 200 x 300 mm")) << outcome.output;
    EXPECT_TRUE(tells(outcome, "Table  12 triangles, 100 x 200 x 300 mm, #ff0000")) << outcome.output;
    EXPECT_TRUE(tells(outcome, "skipped: 1 Viewpoint, the first at w.wrl:5:1")) << outcome.output;
    const Json report = Json::parse(place.read("r.json"));
    const Json& file = report["files"][0];
    EXPECT_EQ(file["triangles"], 12);
    EXPECT_EQ(file["objects"][0]["name"], "Table");
    EXPECT_EQ(file["objects"][0]["lowest_m"][1], 0.9);
    EXPECT_TRUE(file["faults"].empty());
}

TEST(WorldCommand, MirrorsAWorkpieceAndRefusesToWhereThereIsNone) {
    const Workplace place;
    place.write("w.wrl", kWorldHead + "Shape { geometry Box { size 0.1 0.2 0.3 } }");
    place.write("s.txt", "burin-input 1 test\n0.05 command quit\n");
    const std::string world = kWorldBurin + " world w.wrl --mirror xz --offscreen --input s.txt";
    const auto without = place.run(world);
    EXPECT_EQ(without.status, 1) << without.output;
    EXPECT_TRUE(tells(without, "--mirror") && tells(without, "--workpiece")) << without.output;
    const auto with = place.run(world + " --workpiece ball:0.03 --resolution 16");
    EXPECT_EQ(with.status, 0) << with.output;
}

TEST(WorldCommand, TellsEveryFaultOfEveryFileAndFails) {
    const Workplace place;
    place.write("a.wrl", kWorldHead + "Shape { geometry Sphere { radius 1 2 } }\nUSE Nobody");
    place.write("b.wrl", "#VRML V1.0 ascii\n");
    place.write("c.wrl", kWorldHead + "Shape { geometry Box { size .1 .1 .1 } }");
    const auto outcome = place.run(kWorldBurin + " world check a.wrl b.wrl c.wrl lost.wrl --json r.json");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(tells(outcome, "a.wrl:2:34: 'radius' takes 1 number, and has 2; ")) << outcome.output;
    EXPECT_TRUE(tells(outcome, "a.wrl:3:5: no node is named 'Nobody' before this place; ")) << outcome.output;
    EXPECT_TRUE(tells(outcome, "b.wrl:1:1: is VRML 1.0; ")) << outcome.output;
    EXPECT_TRUE(tells(outcome, "lost.wrl: cannot be read")) << outcome.output;
    EXPECT_TRUE(tells(outcome, "burin: 3 of 4 files: 4 faults; correct them and check again")) << outcome.output;
    EXPECT_EQ(Json::parse(place.read("r.json"))["files"][0]["faults"][1]["where"], "a.wrl:3:5");
}

// It said that no command could reach them, and commands reached them.
TEST(WorldCommand, SaysWhatShapesWithoutANameAreCalled) {
    const Workplace place;
    const std::string box = "Shape { geometry Box { size .1 .1 .1 } }\n";
    place.write("w.wrl", "#VRML V2.0 utf8\n" + box + "DEF Named " + box + box);
    place.write("w.toml", "[[object]]\nname = \"shape-2\"\nscale = 2\n");
    const auto outcome = place.run(kWorldBurin + " world check w.wrl");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(tells(outcome, "2 shapes without a name; commands and settings know them as shape-1 to shape-2"))
        << outcome.output;
}

TEST(WorldCommand, TellsWhatIsInAWorldInToml) {
    const Workplace place;
    place.write("cube.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    place.write("w.toml",
                "name = \"Yard\"\n[[object]]\nname = \"rock\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\n"
                "scale = 0.1\ncolour = \"#102030\"\nmaterial = { stiffness = 900, static_friction = 0.5, "
                "coulomb_velocity = 0.02 }\n");
    const auto outcome = place.run(kWorldBurin + " world check w.toml --json r.json");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(tells(outcome, "w.toml: 1 object, 4 triangles, Yard")) << outcome.output;
    EXPECT_TRUE(tells(outcome,
                      "rock  4 triangles, 100 x 100 x 100 mm, #102030, 900 N/m, 0.5 N s/m, friction 0.5 and "
                      "0.5, growing up to 20 mm/s"))
        << outcome.output;
    const Json object = Json::parse(place.read("r.json"))["files"][0]["objects"][0];
    EXPECT_EQ(object["highest_m"][1], 0.1);
    EXPECT_EQ(object["stiffness_N_per_m"], 900.0);
    EXPECT_EQ(object["coulomb_velocity_m_per_s"], 0.02);
    EXPECT_TRUE(object["path_s"].is_null());
    place.write("bad.toml",
                "[[object]]\nname = \"rock\"\nmesh = \"lost.off\"\nscale = 0\nmaterial = { coulomb_velocity = -1 }\n");
    const auto bad = place.run(kWorldBurin + " world check bad.toml w.toml");
    EXPECT_EQ(bad.status, 1);
    EXPECT_TRUE(tells(bad, "bad.toml:3: mesh cannot be used: ")) << bad.output;
    EXPECT_TRUE(tells(bad, "bad.toml:4: scale is 0; give a factor from 1e-6 to 1e6")) << bad.output;
    EXPECT_TRUE(tells(bad, "bad.toml:5: coulomb_velocity is -1; give a number from 0 to 1")) << bad.output;
    EXPECT_TRUE(tells(bad, "burin: 1 of 2 files: 3 faults; correct them and check again")) << bad.output;
}

// Nobody said that a stylus makes 700 N/m of 1200, and an end of a wand 857.7.
TEST(WorldCommand, TellsWhatIsRenderedOfAMaterial) {
    const Workplace place;
    place.write("w.wrl", kWorldHead +
                             "Transform { translation 0 0.2 -0.05 children DEF Plane Shape { geometry Box { "
                             "size 0.4 0.4 0.1 } } }");
    place.write("w.toml", "[[object]]\nname = \"Plane\"\nmaterial = { stiffness = 1200, damping = 0.5 }\n");
    const auto checked = place.run(kWorldBurin + " world check w.wrl --json r.json");
    EXPECT_EQ(checked.status, 0) << checked.output;
    EXPECT_TRUE(tells(checked, "simulated: 700 N/m, 0.44 N s/m (its maker's limit)")) << checked.output;
    EXPECT_TRUE(tells(checked, "simulated-wand, each end of two: 857.7 N/m")) << checked.output;
    const Json rendered = Json::parse(place.read("r.json"))["files"][0]["felt_objects"][0]["rendered"];
    ASSERT_EQ(rendered.size(), 3u);
    EXPECT_EQ(rendered[0]["stiffness_N_per_m"], 700.0);
    EXPECT_EQ(rendered[0]["limited_by"], "its maker's limit");
    EXPECT_EQ(rendered[2]["points"], 2);
    EXPECT_NEAR(rendered[2]["stiffness_N_per_m"].get<double>(), 857.66, 0.01);

    place.write("s.csv",
                "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n0,0,0.21,0.02,0,0,0,1,0\n1,0,0.21,0.001,0,0,0,1,0\n"
                "2,0,0.21,0.001,0,0,0,1,0\n");
    const auto stylus = place.run(kWorldBurin + " world w.wrl --stroke s.csv --report stylus.json");
    EXPECT_TRUE(tells(stylus, "w.wrl: 1 of 1 objects asks for more than simulated PHANTOM Omni renders, such as Plane"))
        << stylus.output;
    const Json touch = Json::parse(place.read("stylus.json"))["objects"][0];
    EXPECT_EQ(touch["asked"]["stiffness_N_per_m"], 1200.0);
    EXPECT_EQ(touch["rendered"]["stiffness_N_per_m"], 700.0);
    EXPECT_EQ(touch["limited_by"], "its maker's limit");
    EXPECT_NEAR(touch["felt_N_per_m"].get<double>(), 700.0, 21.0);
    const auto wand = place.run(kWorldBurin + " world w.wrl --stroke s.csv --device simulated-wand --report wand.json");
    EXPECT_TRUE(tells(wand, "1200 -> 857.7 -> ")) << wand.output;
    const Json end = Json::parse(place.read("wand.json"))["touches"][0];
    EXPECT_EQ(end["asked"]["damping_Ns_per_m"], 0.5);
    EXPECT_NEAR(end["rendered"]["stiffness_N_per_m"].get<double>(), 857.66, 0.01);
    EXPECT_EQ(end["rendered"]["damping_Ns_per_m"], 0.0);
}

// What one sees through was told neither of a world in TOML nor of settings.
TEST(WorldCommand, TellsHowOpaqueThingsAre) {
    const Workplace place;
    place.write("cube.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    place.write("w.toml",
                "[[object]]\nname = \"glass\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\ncolour = \"#102030\"\n"
                "opacity = 0.25\n[[object]]\nname = \"rock\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\n");
    const auto outcome = place.run(kWorldBurin + " world check w.toml --json r.json");
    EXPECT_TRUE(tells(outcome, "#102030, opacity 0.25, 600 N/m")) << outcome.output;
    EXPECT_FALSE(tells(outcome, "opacity 1")) << outcome.output;
    const Json objects = Json::parse(place.read("r.json"))["files"][0]["objects"];
    EXPECT_EQ(objects[0]["opacity"], 0.25);
    EXPECT_EQ(objects[1]["opacity"], 1.0);
    place.write("v.wrl", kWorldHead + "DEF Pane Shape { geometry Box { size 0.1 0.1 0.1 } }");
    place.write("v.toml", "[[object]]\nname = \"Pane\"\nopacity = 0.5\n");
    const auto set = place.run(kWorldBurin + " world check v.wrl --json s.json");
    EXPECT_TRUE(tells(set, "Pane: #cccccc, opacity 0.5, 600 N/m")) << set.output;
    EXPECT_EQ(Json::parse(place.read("s.json"))["files"][0]["felt_objects"][0]["opacity"], 0.5);
}

// What world opens, check reads: it said that a mesh is no world.
TEST(WorldCommand, ChecksAMeshAsTheWorldThatItIs) {
    const Workplace place;
    place.write("crate.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const auto outcome = place.run(kWorldBurin + " world check crate.obj --json new/r.json");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(tells(outcome, "crate.obj: 1 object, 4 triangles")) << outcome.output;
    EXPECT_TRUE(tells(outcome, "mesh_units = \"mm\"")) << outcome.output;
    EXPECT_EQ(Json::parse(place.read("new/r.json"))["files"][0]["objects"][0]["name"], "crate");
}

// A report's folder was asked for, and that of pictures made.
TEST(WorldCommand, MakesTheFolderOfAReport) {
    const Workplace place;
    place.write("w.wrl", kWorldHead + "DEF Pane Shape { geometry Box { size 0.1 0.1 0.1 } }");
    place.write("s.csv", "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n0,0,0.2,0,0,0,0,1,0\n0.1,0,0.2,0,0,0,0,1,0\n");
    for (const std::string device : {"", " --device simulated-wand"}) {
        const std::string folder = device.empty() ? "of/stylus" : "of/wand";
        const auto outcome =
            place.run(kWorldBurin + " world w.wrl --stroke s.csv" + device + " --report " + folder + "/r.json");
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(Json::parse(place.read(folder + "/r.json"))["world"], "w.wrl");
        EXPECT_FALSE(tells(outcome, "motion scaled")) << outcome.output;
    }
    const auto in_a_file = place.run(kWorldBurin + " world w.wrl --stroke s.csv --report s.csv/r.json");
    EXPECT_EQ(in_a_file.status, 1) << in_a_file.output;
}

TEST(WorldCommand, TellsThatTheHandMovesLessThanTheTool) {
    const Workplace place;
    place.write("w.wrl", kWorldHead + "DEF Pane Shape { geometry Box { size 0.1 0.1 0.1 } }");
    place.write("s.csv", "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n0,-1,0.2,0,0,0,0,1,0\n1,1,0.2,0,0,0,0,1,0\n");
    const auto outcome = place.run(kWorldBurin + " world w.wrl --stroke s.csv --report r.json");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(tells(outcome, "motion scaled by ")) << outcome.output;
    EXPECT_GT(Json::parse(place.read("r.json"))["motion_scaled"].get<double>(), 2.0);
}

// A pipe that nobody writes to was waited for, for ever.
TEST(WorldCommand, APipeIsNoInput) {
    const Workplace place;
    place.write("v.wrl", kWorldHead + "DEF Pane Shape { geometry Box { size 0.1 0.1 0.1 } }");
    ASSERT_EQ(place.run("mkfifo pipe").status, 0);
    for (const char* command : {"world --input pipe", "world v.wrl --input pipe --offscreen", "seek v.wrl --input pipe",
                                "sculpt --input pipe --offscreen", "profile --input pipe"}) {
        const auto outcome = place.run("timeout 60 " + kWorldBurin + " " + command);
        EXPECT_EQ(outcome.status, 1) << command << "\n" << outcome.output;
        EXPECT_TRUE(tells(outcome, "pipe: is not a regular file")) << command << "\n" << outcome.output;
    }
}

TEST(WorldCommand, RefusesEmptyWorldsAndWrongUsage) {
    const Workplace place;
    place.write("w.wrl", kWorldHead);
    place.write("in.txt", "burin-input 1 nothing\n0.1 command quit\n");
    const auto opened = place.run(kWorldBurin + " world w.wrl --input in.txt --offscreen");
    EXPECT_EQ(opened.status, 1) << "a world without a shape";
    EXPECT_TRUE(tells(opened, "w.wrl")) << opened.output;
    const auto of_none = place.run(kWorldBurin + " world --input in.txt --offscreen");
    EXPECT_EQ(of_none.status, 1) << "a script does not say of which world it is";
    EXPECT_TRUE(tells(of_none, "there is no world; name one")) << of_none.output;
    place.write("s.csv", "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n0,0,0,0,0,0,0,1,0\n");
    const auto empty = place.run(kWorldBurin + " world w.wrl --stroke s.csv");
    EXPECT_EQ(empty.status, 1) << "a world without a shape";
    EXPECT_TRUE(tells(empty, "w.wrl")) << empty.output;
    EXPECT_EQ(place.run(kWorldBurin + " world").status, 2);
    EXPECT_EQ(place.run(kWorldBurin + " world check").status, 2);
    EXPECT_EQ(place.run(kWorldBurin + " world check w.wrl --json w.wrl").status, 1);
    EXPECT_EQ(place.read("w.wrl"), kWorldHead);
}

// "holds nothing" alone hid why.
TEST(WorldCommand, SaysWhatWasLeftOutOfAWorldInWhichNothingIsLeft) {
    const Workplace place;
    place.write("one.wrl", "#VRML V2.0 utf8\nShape { geometry Cilinder { } }\n");
    const auto outcome = place.run(std::string(kBurinCommand) + " world check one.wrl");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("one.wrl:2:18: 'Cilinder' is no node of VRML 2.0")) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("holds nothing to touch or see")) << outcome.output;
}

}  // namespace burin::app

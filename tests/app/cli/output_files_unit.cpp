// SPDX-License-Identifier: MIT
// Places of output files are checked before the first long step, not after it.
#include "app/cli/output_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <utility>
#include <vector>

#include "session/record/input_files.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {

TEST(OutputFiles, AreRefusedBeforeAnythingIsWrittenWhereTheyCannotBe) {
    const Workplace place;
    const std::string missing = (place / "no/such/folder").string();
    const std::array good{(place / "a.stl").string(), (place / "b.ply").string()};
    const std::string report = (place / "report.json").string();
    EXPECT_TRUE(check_outputs(good, report));
    EXPECT_TRUE(check_outputs({}, ""));
    const auto refused = [&](std::span<const std::string> exports, const std::string& report_at) {
        const auto checked = check_outputs(exports, report_at);
        return checked ? "" : checked.error().line();
    };
    EXPECT_NE(refused(good, missing + "/report.json").find(missing), std::string::npos);
    EXPECT_NE(refused(good, place / ".").find("is a folder"), std::string::npos);
    EXPECT_NE(refused(std::array{good[0], missing + "/c.ply"}, report).find(missing), std::string::npos);
    EXPECT_NE(refused(std::array{good[0], (place / "c.off").string()}, report).find("c.off"), std::string::npos);
    EXPECT_EQ(place.files(), 0u);
}

// All of these were noticed only when the file was written, which may be hours later.
TEST(OutputFiles, AreRefusedBeforehandWhereNoFileCanBeReplaced) {
    const Workplace place;
    const auto refused = [&](const std::string& report) {
        const auto checked = check_outputs({}, report);
        return checked ? "" : checked.error().line();
    };
    std::filesystem::create_symlink(place / "loop.json", place / "loop.json");
    std::filesystem::create_symlink("/dev/full", place / "full.json");
    place.write("good.json", "");
    std::filesystem::create_symlink(place / "good.json", place / "link.json");
    EXPECT_TRUE(refused("/dev/full").contains("not a regular file"));
    EXPECT_TRUE(refused(place / "full.json").contains("not a regular file"));
    EXPECT_TRUE(refused(place / "loop.json").contains("symbolic link")) << refused(place / "loop.json");
    EXPECT_EQ(refused(place / "link.json"), "");
    EXPECT_EQ(refused(place / "new.json"), "");
    if (geteuid() == 0) return;  // who may write everywhere
    std::filesystem::permissions(place / "good.json", std::filesystem::perms::owner_read);
    EXPECT_TRUE(refused(place / "good.json").contains("write-protected"));
}

TEST(OutputFiles, OverwriteNeitherAnInputNorEachOther) {
    const Workplace place;
    place.write("in.csv", "x");
    place.write("in.stl", "x");
    const std::array inputs{(place / "in.stl").string(), (place / "in.csv").string(), std::string("block:1,1,1")};
    const auto refused = [&](const std::vector<std::string>& exports, const std::string& report) {
        const auto checked = check_outputs(exports, report, inputs);
        return checked ? "" : checked.error().line();
    };
    EXPECT_EQ(refused({(place / "a.stl").string()}, (place / "r.json").string()), "");
    EXPECT_TRUE(refused({(place / "./in.stl").string()}, "").contains("is a file that this command reads"));
    EXPECT_TRUE(refused({}, (place / "in.csv").string()).contains("is a file that this command reads"));
    EXPECT_TRUE(refused({(place / "a.stl").string(), (place / "./a.stl").string()}, "").contains("two outputs"));
}

// A log names what it was recorded with in its first line.
TEST(OutputFiles, OverwriteNoFileThatARecordingNames) {
    const Workplace place;
    const auto path = [&](const std::string& name) { return (place / name).string(); };
    place.write("a.log", "burin-input 2 burin sculpt --workpiece " + path("part.stl") + " --world " + path("w.toml") +
                             " --tool mesh:" + path("tip.stl") + " --device simulated-wand:" + path("wand.toml") +
                             " --wall " + path("wall.toml") + "\n0.1 mouse 1 2\n");
    place.write("script.txt", "burin-input 1 somebody's --world " + path("w.toml") + "\n");
    const auto refused = [&](const std::string& input, const std::string& output) {
        const auto checked = check_overwrites_none(output, std::array{path(input)});
        return checked ? "" : checked.error().line();
    };
    for (const std::string name : {"part.stl", "w.toml", "tip.stl", "wand.toml", "wall.toml"})
        EXPECT_TRUE(refused("a.log", path(name)).contains("is a file of the recording")) << name;
    EXPECT_EQ(refused("a.log", path("r.json")), "");
    EXPECT_EQ(refused("script.txt", path("w.toml")), "") << "it is no recording";
    EXPECT_EQ(refused("none.log", path("w.toml")), "");
}

// Neither is there yet, and one of the names begins at the folder: they were taken for two.
TEST(OutputFiles, AreTheSameByWhateverNameBeforeTheyAreThere) {
    EXPECT_TRUE(session::is_same_file("not-there.json", "./not-there.json"));
    EXPECT_TRUE(session::is_same_file("not-there.json", std::filesystem::absolute("x/../not-there.json")));
    EXPECT_FALSE(session::is_same_file("not-there.json", "x/not-there.json"));
    EXPECT_FALSE(session::is_same_file("", "."));
}

namespace {

const std::string kBurinThatWrites = kBurinCommand;
const std::string kTetrahedron = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string kBoxShape = "Shape { geometry Box { size 0.1 0.1 0.1 } }\n";

// A world of each kind, and what they name.
void write_worlds(const Workplace& place) {
    place.write("w.toml",
                "[[object]]\nname = \"a\"\nmesh = \"a.off\"\nmesh_units = \"m\"\nscale = 0.1\n"
                "[[object]]\nname = \"b\"\nmesh = \"b.obj\"\nmesh_units = \"m\"\nscale = 0.1\n");
    place.write("a.off", kTetrahedron);
    place.write("b.obj", "mtllib b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    place.write("b.mtl", "newmtl m\nKd 1 0 0\n");
    place.write("w.wrl", "#VRML V2.0 utf8\nInline { url \"part.wrl\" }\n" + kBoxShape);
    place.write("part.wrl", "#VRML V2.0 utf8\n" + kBoxShape);
    place.write("wand.toml", "name = \"mine\"\n");
    place.write("s.csv", kStrokeHeader + "0,0,0,1,0,0,0,1,0\n0.1,0,0,1,0,0,0,1,0\n");
    place.write("in.txt", "burin-input 1 x\n0.05 command tool mesh:a.off\n0.1 command quit\n");
}

}  // namespace

// Only the files that a command line names itself were guarded: what these name in turn was overwritten.
TEST(OutputFiles, OverwriteNothingThatAnInputNames) {
    const Workplace place;
    write_worlds(place);
    const std::array<std::pair<const char*, const char*>, 17> commands{{
        {"world check w.toml --json a.off", "a.off"},
        {"world check w.toml --json ./b.mtl", "b.mtl"},
        {"world check w.wrl --json part.wrl", "part.wrl"},
        {"world check w.wrl --json w.toml", "w.toml"},
        {"world w.toml --stroke s.csv --report b.obj", "b.obj"},
        {"world w.wrl --stroke s.csv --report w.toml", "w.toml"},
        {"world w.toml --stroke s.csv --device simulated-wand:wand.toml --report wand.toml", "wand.toml"},
        {"world w.toml --stroke s.csv --device simulated-wand --report a.off", "a.off"},
        {"seek w.toml --input in.txt --offscreen --report b.mtl", "b.mtl"},
        {"seek w.wrl --input in.txt --offscreen --report a.off", "a.off"},
        {"sculpt --workpiece block:1,1,1 --resolution 16 --tool mesh:a.off --units m --report a.off", "a.off"},
        {"sculpt --workpiece b.obj --units m --resolution 16 --export b.obj", "b.obj"},
        {"sculpt --workpiece b.obj --units m --resolution 16 --report b.mtl", "b.mtl"},
        {"convert b.obj b.obj", "b.obj"},
        {"bench stroke --scene mesh:b.obj --json b.mtl", "b.mtl"},
        {"bench world w.wrl --without-coin --json part.wrl", "part.wrl"},
        {"profile --input in.txt --json a.off", "a.off"},
    }};
    for (const auto& [command, input] : commands) {
        const std::string before = place.read(input);
        const auto outcome = place.run(kBurinThatWrites + " " + command);
        EXPECT_EQ(outcome.status, 1) << command << "\n" << outcome.output;
        EXPECT_TRUE(outcome.output.contains(std::string(input) + ": is a file that this command reads"))
            << command << "\n"
            << outcome.output;
        EXPECT_EQ(place.read(input), before) << command;
    }
}

// A plot or table beside a report is an output like the report.
TEST(OutputFiles, BesideAReportOverwriteNoInput) {
    const Workplace place;
    write_worlds(place);
    place.write("r-felt.csv", place.read("s.csv"));
    for (const std::string device : {"simulated", "simulated-wand"}) {
        const auto outcome =
            place.run(kBurinThatWrites + " world w.toml --stroke r-felt.csv --report r.json --device " + device);
        EXPECT_EQ(outcome.status, 1) << outcome.output;
        EXPECT_TRUE(outcome.output.contains("r-felt.csv: is a file that this command reads")) << outcome.output;
    }
    EXPECT_EQ(place.read("r-felt.csv"), place.read("s.csv"));
}

// A script's export took the place of the world's own mesh, where --outputs was the world's folder.
TEST(OutputFiles, OfACommandInADeletedFolderHaveNoPlaceAndItSaysSoInALine) {
    const Workplace place;
    place.write("part.obj", "# units mm\nv 0 0 0\nv 40 0 0\nv 0 30 0\nv 0 0 20\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string mesh = (place / "part.obj").string(), burin = kBurinCommand;
    for (const std::string& command :
         {burin + " convert " + mesh + " x.stl", burin + " convert x.obj " + mesh + ".stl",
          burin + " combine " + mesh + " " + mesh + " --operation union --export x.stl", burin + " film pictures x.png",
          burin + " sculpt block:0.01,0.01,0.01 --tool ball:0.002 --export x.stl --resolution 16",
          burin + " study analyse x.csv --json x.json", burin + " bench document --json x.json"}) {
        const auto outcome = place.run("mkdir -p gone && cd gone && rmdir ../gone && " + command);
        EXPECT_EQ(outcome.status, 1) << command << "\n" << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << command << "\n" << outcome.output;
        EXPECT_NE(outcome.output.find("working folder"), std::string::npos) << command << "\n" << outcome.output;
    }
    const auto whole =
        place.run("mkdir -p gone && cd gone && rmdir ../gone && " + burin + " convert " + mesh + " " + mesh + ".stl");
    EXPECT_EQ(whole.status, 0) << whole.output;
}

TEST(Remedies, NameNoEngineThatWasAskedForWherePicturesNeedADriver) {
    const Workplace place;
    place.write("quit.txt", "burin-input 1\n0.2 command screenshot a.png\n0.5 command quit\n");
    const auto session = [&](const std::string& engine) {
        return place.run("VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent " + std::string(kBurinCommand) +
                         " sculpt ball:0.05 " + engine + " --resolution 16 --offscreen --input quit.txt");
    };
    const auto refused = session("--engine cpu");
    EXPECT_EQ(refused.status, 1) << refused.output;
    EXPECT_TRUE(refused.output.contains("install mesa-vulkan-drivers")) << refused.output;
    EXPECT_FALSE(refused.output.contains("--engine")) << refused.output;
    place.write("stroke.csv", kStrokeHeader + "0,0,0,0,0,0,0,1,1\n");
    const std::string stroke = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent " +
                               std::string(kBurinCommand) +
                               " sculpt --workpiece ball:0.05 --resolution 16 --stroke stroke.csv --export x.obj ";
    const auto on_gpu = place.run(stroke + "--engine vulkan");
    EXPECT_EQ(on_gpu.status, 0) << on_gpu.output;
    EXPECT_TRUE(on_gpu.output.contains("install mesa-vulkan-drivers")) << on_gpu.output;
    EXPECT_TRUE(on_gpu.output.contains("the processor carves instead")) << on_gpu.output;
    EXPECT_EQ(place.run(stroke + "--engine cpu").status, 0) << "a stroke needs no driver";
}

TEST(OutputFiles, OfAScriptOverwriteNothingThatTheSessionReads) {
    const Workplace place;
    write_worlds(place);
    place.write("out.txt", "burin-input 1 x\n0.1 command export b.obj\n0.2 command quit\n");
    const std::string before = place.read("b.obj");
    const auto outcome = place.run(kBurinThatWrites +
                                   " sculpt --world w.toml --workpiece block:0.1,0.1,0.1 --resolution 16 --input "
                                   "out.txt --offscreen --outputs .");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("out.txt:2: b.obj: is a file that this session reads")) << outcome.output;
    EXPECT_EQ(place.read("b.obj"), before);
}

TEST(OutputFiles, OverwriteNoFileOfAStudy) {
    const Workplace place;
    ASSERT_EQ(place.run(kBurinThatWrites + " study init kinesthetic-path study --participants 2 --seed 1").status, 0);
    const std::string before = place.read("study/journal.jsonl");
    for (const char* file : {"study/journal.jsonl", "study/trials.csv", "study/data/journal.json"}) {
        const auto outcome = place.run(kBurinThatWrites + " study analyse study --json " + file);
        EXPECT_EQ(outcome.status, 1) << outcome.output;
        EXPECT_TRUE(outcome.output.contains(std::string(file) + ": is a file ")) << outcome.output;
    }
    EXPECT_EQ(place.read("study/journal.jsonl"), before);
}

}  // namespace burin::app

// SPDX-License-Identifier: MIT
// The command as its user meets it: exit status, one clear line, and no partial output.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/json.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"
#include "toolbox/tool_kinds.hpp"

namespace burin::app {
namespace {

const std::string kBurin = kBurinCommand;

// A tetrahedron with corners at the origin and one metre along each axis; `faces` of its four.
std::string tetrahedron_off(int faces) {
    const char* const kFaces[] = {"3 0 2 1\n", "3 0 1 3\n", "3 0 3 2\n", "3 1 2 3\n"};
    std::string text = "OFF\n4 " + std::to_string(faces) + " 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    for (int i = 0; i < faces; ++i) text += kFaces[i];
    return text;
}

// One line that starts with the program's name and holds every given part; nothing written beside the inputs.
void expect_refused(const Workplace& place, const std::string& arguments, int status,
                    const std::vector<std::string>& parts) {
    const std::size_t files_before = place.files();
    const auto outcome = place.run(kBurin + " " + arguments);
    EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.output;
    EXPECT_EQ(outcome.output.rfind("burin: ", 0), 0u) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    for (const std::string& part : parts) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << "expected '" << part << "' in: " << outcome.output;
    }
    EXPECT_EQ(place.files(), files_before) << arguments;
}

}  // namespace

TEST(Command, ANameThatIsEmptyIsRefusedByItsOption) {
    Workplace place;
    for (const std::string option :
         {"sculpt --record", "rehab putty --hand scripted --results", "world garden --report",
          "rehab putty --hand scripted --settings", "sculpt --export"})
        expect_refused(place, option + " ''", 2, {option.substr(option.rfind(' ') + 1), "is empty"});
}

TEST(Command, RefusesWrongUsageWithStatusTwo) {
    Workplace place;
    expect_refused(place, "sculpt --workpiece ball:1 --resolution 8", 2, {"--resolution", "16", "2048"});
    expect_refused(place, "sculpt --workpiece ball:1 --resolution 4096", 2, {"--resolution", "2048"});
    expect_refused(place, "sculpt --workpiece ball:1 --resolution many", 2, {"--resolution"});
    expect_refused(place, "sculpt --workpiece ball:1 --engine gpu", 2, {"--engine"});
    expect_refused(place, "sculpt --workpiece ball:1 --hand mine", 2, {"--hand"});
    expect_refused(place, "sculpt --workpiece ball:1 --bogus", 2, {"--bogus"});
    expect_refused(place, "sculpt --workpiece ball:1 --undo -1", 2, {"--undo", "'-1' is no whole number from 0 to"});
    expect_refused(place, "sculpt --workpiece ball:1 --sweep-tolerance nan", 2, {"--sweep-tolerance", "nan"});
    expect_refused(place, "fly", 2, {"fly"});
}

TEST(Command, SaysWhatAMisspeltWordWasMeantToBe) {
    const Workplace place;
    expect_refused(place, "scuplt", 2, {"scuplt is no command; did you mean sculpt?"});
    expect_refused(place, "convrt a.stl b.ply", 2, {"did you mean convert?"});
    expect_refused(place, "world chek a.wrl", 2, {"did you mean check? See burin world --help"});
    expect_refused(place, "sculpt --resoluton 64", 2, {"--resoluton is no option; did you mean --resolution?"});
    expect_refused(place, "convert --centre a.stl b.ply", 2, {"did you mean --center?"});
    expect_refused(place, "convert --plac=1,2,3 a.stl b.ply", 2, {"did you mean --place?"});
    // What is far from any is left to the usual message.
    expect_refused(place, "sculpt --bogus", 2, {"--bogus"});
    expect_refused(place, "fly", 2, {"fly"});
}

// The seed was clipped, 010 was eight, 0x10 sixteen and 1'000 a thousand, without a word.
TEST(Command, TakesEveryNumberByOneRule) {
    const Workplace place;
    const std::string most = "from 0 to 18446744073709551615";
    for (const char* seed : {"18446744073709551616", "99999999999999999999999", "0x10", "1e3", "1'000", "+1", "-1",
                             "1.0", "' 1'", "''", "1_000"})
        expect_refused(place,
                       std::string("seek w.toml --seed ") + (seed[0] == '\'' ? seed : "\"" + std::string(seed) + "\""),
                       2, {"--seed", "is no whole number " + most});
    expect_refused(place, "seek w.toml --seed 010", 2,
                   {"--seed", "'010' is no whole number", "without zeros before it"});
    expect_refused(place, "seek w.toml --targets 4294967296", 2, {"--targets", "from 0 to 4294967295"});
    expect_refused(place, "sculpt --resolution 0256", 2,
                   {"--resolution", "'0256'", "from 16 to 2048", "without zeros"});
    expect_refused(place, "sculpt --threads 0x2", 2, {"--threads", "from 0 to 1024"});
    expect_refused(place, "sculpt --friction nan", 2, {"--friction", "'nan' is no number"});
    expect_refused(place, "sculpt --press 1e400", 2, {"--press", "'1e400' is no number"});
    expect_refused(place, "sculpt --grip 0100", 2, {"--grip", "'0100' is no number", "without zeros before it"});
    expect_refused(place, "world w.toml --radius 0x1p-8", 2, {"--radius", "is no number from 1e-05 to 1"});
    expect_refused(place, "bench stroke --resolution 64.0", 2, {"--resolution"});
    // Both ends of a range, and what is usual.
    expect_refused(place, "seek w.toml --seed 18446744073709551615", 1, {"w.toml"});
    expect_refused(place, "sculpt --workpiece none.stl --resolution 16 --sweep-tolerance 1e-3 --report r.json", 1,
                   {"none.stl"});
}

// They were ignored: what was asked for was not done, and nobody was told.
TEST(Command, RefusesOptionsThatWouldHaveNoEffect) {
    const Workplace place;
    place.write("s.csv", kStrokeHeader + "0,0,0,1,0,0,0,1,0\n0.1,0,0,1,0,0,0,1,0\n");
    place.write("a.off", tetrahedron_off(4));
    const std::string carve = "sculpt --workpiece ball:0.1 --resolution 16 --stroke s.csv --report r.json ";
    expect_refused(place, carve + "--world a.off", 1, {"--world", "belongs to a session"});
    expect_refused(place, carve + "--no-workpiece", 1, {"--no-workpiece", "nothing to carve"});
    expect_refused(place, carve + "--points top", 1, {"--points"});
    expect_refused(place, carve + "--device simulated-wand", 1, {"--device simulated-wand"});
    const std::string explore = "world a.off --stroke s.csv ";
    expect_refused(place, explore + "--workpiece ball:0.1", 2, {"--workpiece", "nothing is carved"});
    expect_refused(place, explore + "--tool ball:0.1", 2, {"--tool", "--radius"});
    expect_refused(place, explore + "--input in.txt", 2, {"--input", "give one"});
    expect_refused(place, "world a.off --report r.json", 2, {"--report belongs to a --stroke"});
    expect_refused(place, "world a.off --pictures p", 2, {"--pictures belongs to a --stroke"});
}

// It made a file of that name.
TEST(Command, AReportWithATableIsAFile) {
    const Workplace place;
    place.write("s.csv", kStrokeHeader + "0,0,0,1,0,0,0,1,0\n0.1,0,0,1,0,0,0,1,0\n");
    place.write("a.off", tetrahedron_off(4));
    expect_refused(place, "sculpt --workpiece ball:0.1 --resolution 16 --stroke s.csv --report -", 1, {"--report -"});
    expect_refused(place, "world a.off --stroke s.csv --report -", 1, {"--report -", "name a file"});
    expect_refused(place, "world a.off --stroke s.csv --device simulated-wand --report -", 1, {"--report -"});
}

TEST(Command, RefusesBadWorkpiecesNamingFileAndRemedy) {
    Workplace place;
    place.write("open.off", tetrahedron_off(3));
    place.write("empty.stl", "");
    place.write("notes.txt", "hello");
    place.write("lies.ply",
                "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
                "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                "end_header\n");
    place.write("nan.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n");
    place.write("none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
    const std::string low = " --resolution 32 --export out.stl";
    expect_refused(place, "sculpt --workpiece missing.stl" + low, 1, {"missing.stl"});
    expect_refused(place, "sculpt --workpiece ." + low, 1, {"."});
    expect_refused(place, "sculpt --workpiece open.off" + low, 1, {"open.off", "closed", "--close-holes"});
    expect_refused(place, "sculpt --workpiece empty.stl" + low, 1, {"empty.stl"});
    expect_refused(place, "sculpt --workpiece notes.txt" + low, 1, {"notes.txt"});
    expect_refused(place, "sculpt --workpiece lies.ply" + low, 1, {"lies.ply"});
    expect_refused(place, "sculpt --workpiece nan.off" + low, 1, {"nan.off"});
    expect_refused(place, "sculpt --workpiece none.off" + low, 1, {"none.off", "triangle"});
    expect_refused(place, "sculpt --workpiece block:1,2" + low, 1, {"block:1,2", "3 numbers"});
    expect_refused(place, "sculpt --workpiece block:1,2,-3" + low, 1, {"above zero"});
    expect_refused(place, "sculpt --workpiece ball:nan" + low, 1, {"ball:nan"});
    expect_refused(place, "sculpt --workpiece ball:" + low, 1, {"ball:"});
}

TEST(Command, RefusesBadToolsStrokesAndPlacesBeforeCarving) {
    Workplace place;
    place.write("late.csv", kStrokeHeader + "1,0,0,0,0,0,0,1,1\n0,0,0,0,0,0,0,1,1\n");
    place.write("file", "in the way");
    const std::string ball = "sculpt --workpiece ball:0.1 --resolution 32 ";
    expect_refused(place, ball + "--tool cube:1", 1, {"cube:1", "ball:R"});
    expect_refused(place, ball + "--export out.stl --tool ball:0", 1, {"ball:0", "above zero"});
    expect_refused(place, ball + "--stroke late.csv", 1, {"late.csv:3", "time"});
    expect_refused(place, ball + "--stroke missing.csv", 1, {"missing.csv"});
    expect_refused(place, ball + "--export no/such/folder/out.stl", 1, {"no/such/folder"});
    expect_refused(place, ball + "--export out.step", 1, {"out.step", ".stl"});
    expect_refused(place, ball + "--export out.stl --report no/such/folder/r.json", 1, {"no/such/folder"});
    expect_refused(place, ball + "--pictures file", 1, {"file", "--pictures"});
}

TEST(Command, RefusesBadToolSizesColoursAndUses) {
    Workplace place;
    place.write("open.off", tetrahedron_off(3));
    const std::string ball = "sculpt --workpiece ball:0.1 --resolution 32 --export out.ply ";
    expect_refused(place, ball + "--tool cylinder:0.1", 1, {"cylinder:0.1", "2 numbers"});
    expect_refused(place, ball + "--tool cylinder:0.1,0", 1, {"cylinder:0.1,0", "above zero"});
    expect_refused(place, ball + "--tool cone:0,0,1", 1, {"cone:0,0,1", "radius"});
    expect_refused(place, ball + "--tool bullnose:0.01,0.02,1", 1, {"corner"});
    expect_refused(place, ball + "--tool box:0.1,0.1,1e9", 1, {"larger than 10 m"});
    expect_refused(place, "sculpt --workpiece ball:0.01 --resolution 32 --export out.ply --tool box:0.1,0.1,9", 1,
                   {"too large", "4096"});
    expect_refused(place, ball + "--tool mesh:missing.stl", 1, {"missing.stl"});
    expect_refused(place, ball + "--tool mesh:open.off", 1, {"open.off", "closed"});
    expect_refused(place, ball + "--tool box:9,9,9 --operation smooth", 1, {"too large", "100 lattice cells"});
    expect_refused(place, ball + "--material 1,2", 1, {"--material 1,2", "3 numbers"});
    expect_refused(place, ball + "--material 1,2,256", 1, {"--material 1,2,256", "255"});
    expect_refused(place, ball + "--operation melt", 2, {"--operation"});
    expect_refused(place, ball + "--sweep-tolerance 0", 2, {"--sweep-tolerance"});
    expect_refused(place, "combine open.off open.off --operation union --export out.ply", 1, {"open.off", "closed"});
    expect_refused(place, "combine open.off open.off", 2, {"--operation"});
}

TEST(Command, EveryToolCutsFillsAndPaintsAndTheJudgeFindsNothing) {
    Workplace place;
    place.write("tool.off", tetrahedron_off(4));
    // Pressed, moved along, then turned.
    place.write("s.csv", kStrokeHeader + "0,0.4,0.5,0.9,0,0,0,1,1\n1,0.5,0.5,0.9,0,0,0,1,1\n2,0.6,0.5,0.9,0,0,0,1,1\n" +
                             "3,0.6,0.6,0.9,0.1,0.2,0,1,1\n");
    for (const toolbox::ToolDescriptor& kind : toolbox::tool_kinds()) {
        toolbox::ToolSpec spec{kind.kind, {}, kind.used_sizes().empty() ? "tool.off" : ""};
        for (std::size_t i = 0; i < spec.sizes_m.size(); ++i) spec.sizes_m.at(i) = 0.2 * kind.proportions.at(i);
        const std::string tool = toolbox::text_of(spec);
        for (const std::string operation : {"cut", "fill", "paint"}) {
            const auto outcome = place.run(kBurin + " sculpt --workpiece block:1,1,1 --tool " + tool + " --operation " +
                                           operation + " --material 10,250,20 --stroke s.csv --resolution 32" +
                                           " --sweep-tolerance 0.5 --export out.ply --report r.json");
            ASSERT_EQ(outcome.status, 0) << tool << ' ' << operation << '\n' << outcome.output;
            const auto audit = place.run(std::string(kMeshAudit) + " out.ply");
            EXPECT_EQ(audit.status, 0) << tool << ' ' << operation << '\n' << audit.output;
            const auto report = Json::parse(place.read("r.json"));
            const auto removed_m3 = report["carving"]["volume_removed_m3"].get<double>();
            EXPECT_EQ(report["tool"]["operation"], operation);
            const bool as_expected = operation == "cut"    ? removed_m3 > 1e-4
                                     : operation == "fill" ? removed_m3 < -1e-5
                                                           : removed_m3 == 0.0;
            EXPECT_TRUE(as_expected) << tool << ' ' << operation << ' ' << removed_m3;
            // The colour of what the tool left is in the file.
            EXPECT_NE(place.read("out.ply").find(std::string("\x0a\xfa\x14", 3)), std::string::npos)
                << tool << ' ' << operation;
        }
    }
}

TEST(Command, StraightRunsOfRowsAreOneSweepUnlessToldOtherwise) {
    Workplace place;
    std::string stroke = kStrokeHeader;
    for (int i = 0; i <= 20; ++i)
        stroke += std::to_string(i) + "," + std::to_string(0.2 + 0.03 * i) + ",0.5,1,0,0,0,1,1\n";
    place.write("s.csv", stroke);
    const auto updates = [&](const std::string& flags) {
        const auto outcome =
            place.run(kBurin + " sculpt --workpiece block:1,1,1 --tool cylinder:0.1,0.3 --stroke s.csv " +
                      "--resolution 32 --export " + (flags.empty() ? "a" : "b") + ".ply --report r.json" + flags);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        return Json::parse(place.read("r.json"))["carving"]["updates"].get<int>();
    };
    EXPECT_EQ(updates(""), 1);
    EXPECT_EQ(updates(" --no-merge"), 21);
}

TEST(Command, CombinesTwoMeshesAndTheJudgeFindsNothing) {
    Workplace place;
    place.write("t.off", tetrahedron_off(4));
    ASSERT_EQ(place.run(kBurin + " sculpt --workpiece block:0.5,0.5,0.5 --resolution 32 --export b.obj").status, 0);
    for (const std::string operation : {"union", "difference", "intersection"}) {
        const auto outcome = place.run(kBurin + " combine t.off b.obj --operation " + operation +
                                       " --resolution 64 --export out.ply --report r.json");
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(place.run(std::string(kMeshAudit) + " out.ply").status, 0);
        const auto volume_m3 = Json::parse(place.read("r.json"))["mesh"]["volume_m3"].get<double>();
        // The tetrahedron holds 1/6, the block 1/8; beyond the slanting
        // face x + y + z = 1 lies a corner of the block with 1/48.
        const double common_m3 = 0.125 - 1.0 / 48.0;
        const double expected_m3 = operation == "union"        ? 1.0 / 6.0 + 0.125 - common_m3
                                   : operation == "difference" ? 1.0 / 6.0 - common_m3
                                                               : common_m3;
        EXPECT_NEAR(volume_m3, expected_m3, 2e-4) << operation;
    }
    expect_refused(place, "combine t.off t.off --operation difference --export none.ply", 1, {"empty"});
}

TEST(Command, SaysWhatToDoWithoutAVulkanDriver) {
    Workplace place;
    // A loader without any driver is what a machine without one has.
    const std::string blind = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent " + kBurin;
    const auto vulkan =
        place.run(blind + " sculpt --workpiece ball:0.1 --resolution 32 --engine vulkan --export out.stl");
    EXPECT_EQ(vulkan.status, 0) << vulkan.output;
    EXPECT_TRUE(vulkan.output.contains("mesa-vulkan-drivers")) << vulkan.output;
    EXPECT_TRUE(vulkan.output.contains("; the processor carves instead, and nothing is lost")) << vulkan.output;
    EXPECT_TRUE(std::filesystem::remove(place / "out.stl"));
    const auto automatic =
        place.run(blind + " sculpt --workpiece ball:0.1 --resolution 32 --engine auto --export out.stl");
    EXPECT_EQ(automatic.status, 0) << automatic.output;
    EXPECT_FALSE(automatic.output.contains("instead")) << "nobody asked for a device\n" << automatic.output;
    EXPECT_TRUE(std::filesystem::exists(place / "out.stl"));
}

TEST(Command, ClosesHolesOnRequestAndTheJudgeFindsNothing) {
    Workplace place;
    place.write("open.off", tetrahedron_off(3));
    place.write("s.csv", kStrokeHeader + "0,0.2,0.2,1,0,0,0,1,1\n1,0.2,0.2,0.1,0,0,0,1,1\n");
    for (const std::string name : {"out.stl", "out.ply", "out.obj"}) {
        const auto outcome = place.run(kBurin +
                                       " sculpt --workpiece open.off --close-holes --tool ball:0.1 --stroke s.csv "
                                       "--resolution 48 --export " +
                                       name + " --report r.json");
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        const auto audit = place.run(std::string(kMeshAudit) + " " + name);
        EXPECT_EQ(audit.status, 0) << audit.output;
    }
    const std::string report = place.read("r.json");
    EXPECT_NE(report.find("\"closed_holes\""), std::string::npos);
    EXPECT_NE(report.find("\"open_edges\": 0"), std::string::npos);
}

TEST(Command, AWorkpieceFarFromItsOriginIsExportedOnlyWhereNumbersSuffice) {
    Workplace place;
    place.write("far.off",
                "OFF\n4 4 0\n100000 0 0\n100001 0 0\n100000 1 0\n100000 0 1\n"
                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    expect_refused(place, "sculpt --workpiece far.off --resolution 48 --export out.stl", 1, {"out.stl", ".obj"});
    const auto outcome = place.run(kBurin + " sculpt --workpiece far.off --resolution 48 --export out.obj");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(place.run(std::string(kMeshAudit) + " out.obj").status, 0);
    place.write("tiny.off",
                "OFF\n4 4 0\n100000 0 0\n100000.001 0 0\n100000 1 0\n100000 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    const auto converted = place.run(kBurin + " convert tiny.off tiny.stl");
    EXPECT_EQ(converted.status, 1) << converted.output;
    EXPECT_TRUE(converted.output.contains("2 triangles have no area")) << converted.output;
    EXPECT_EQ(place.run(kBurin + " convert tiny.off tiny.obj").status, 0);
}

// What had no effect was taken in silence.
TEST(Command, RefusesOptionsThatContradictEachOtherAndSizesThatNoSessionTakes) {
    Workplace place;
    place.write("s.csv", kStrokeHeader + "0,0,0,0.06,0,0,0,1,1\n");
    place.write("s.txt", "burin-input 1 test\n0.1 close\n");
    const std::string stroke = "sculpt --workpiece ball:0.05 --resolution 32 --stroke s.csv --export o.stl ";
    expect_refused(place, "sculpt --live --offscreen --input s.txt", 1, {"--offscreen", "leave one of them out"});
    expect_refused(place, stroke + "--tool ball:1e9", 1, {"ball:1e9", "is larger than 10 m"});
    expect_refused(place, "sculpt --tool ball:10.1 --offscreen --input s.txt", 1, {"ball:10.1", "is larger than 10 m"});
    for (const std::string weld : {"-1", "0", "nan"})
        expect_refused(place, stroke + "--weld " + weld, 2, {"--weld", "is no number"});
}

TEST(Command, AnExistingFileSurvivesAFailedRun) {
    Workplace place;
    place.write("out.stl", "precious");
    place.write("all.csv", kStrokeHeader + "0,0,0,0,0,0,0,1,1\n");
    // A tool that takes everything away leaves nothing to export.
    const auto outcome = place.run(kBurin +
                                   " sculpt --workpiece ball:0.1 --tool ball:0.5 --stroke all.csv --resolution 32 "
                                   "--export out.stl");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_EQ(place.read("out.stl"), "precious");
}

TEST(Command, CarvesInRealTimeToo) {
    Workplace place;
    place.write("s.csv", kStrokeHeader + "0,0,0,0.06,0,0,0,1,0\n0.3,0,0,0.05,0,0,0,1,1\n0.6,0.01,0,0.05,0,0,0,1,1\n");
    const auto outcome = place.run(kBurin +
                                   " sculpt --workpiece ball:0.05 --tool ball:0.004 --stroke s.csv --resolution 48 "
                                   "--hand simulated --real-time --export out.stl --report r.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(place.run(std::string(kMeshAudit) + " out.stl").status, 0);
    EXPECT_NE(place.read("r.json").find("\"ticks\""), std::string::npos);
}

TEST(Command, ConvertsBetweenFormatsAndTellsHealth) {
    Workplace place;
    place.write("t.off", tetrahedron_off(4));
    const auto outcome = place.run(kBurin + " convert t.off t.ply");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("4 triangles"), std::string::npos) << outcome.output;
    EXPECT_EQ(place.run(std::string(kMeshAudit) + " t.ply").status, 0);
    expect_refused(place, "convert missing.off t.stl", 1, {"missing.off"});
    expect_refused(place, "convert t.off ./t.off", 1, {"t.off", "overwritten"});
}

// The input, which could not be read either, is not looked at before.
TEST(Command, RefusesAnOutputThatCannotBeWrittenBeforeTheWork) {
    Workplace place;
    std::filesystem::create_symlink("/dev/full", place / "full.stl");
    std::filesystem::create_symlink("loop.ply", place / "loop.ply");
    std::filesystem::create_directory(place / "shots");
    std::filesystem::create_symlink("/dev/full", place / "shots" / "after.png");
    std::filesystem::create_symlink("/dev/full", place / "r-felt.csv");
    place.write("s.csv", kStrokeHeader + "0,0,0,0.1,0,0,0,1,1\n");
    for (const auto& [output, why] : {std::pair{"full.stl", "not a regular file"}, {"loop.ply", "symbolic link"}}) {
        const std::string name = output;
        expect_refused(place, "convert missing.off " + name, 1, {name, why});
        expect_refused(place, "combine missing.off none.off --operation union --export " + name, 1, {name, why});
        expect_refused(place, "sculpt --workpiece missing.off --export " + name, 1, {name, why});
        expect_refused(place, "sculpt --workpiece missing.off --report " + name, 1, {name, why});
    }
    expect_refused(place, "convert missing.off t.step", 1, {"t.step", ".stl"});
    expect_refused(place, "sculpt --workpiece missing.off --stroke s.csv --hand simulated --report r.json", 1,
                   {"r-felt.csv", "not a regular file"});
    expect_refused(place, "sculpt --workpiece ball:0.1 --resolution 16 --pictures shots", 1,
                   {"after.png", "not a regular file"});
    EXPECT_FALSE(std::filesystem::exists(place / "shots" / "before.png"));
}

TEST(Command, VersionListsTheVulkanDevicesOrSaysWhyNot) {
    Workplace place;
    const auto outcome = place.run(kBurin + " --version");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output.rfind("burin ", 0), 0u);
    EXPECT_NE(outcome.output.find("Vulkan"), std::string::npos);
}

}  // namespace burin::app

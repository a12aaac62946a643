// SPDX-License-Identifier: MIT
// burin bench as its user meets it: JSON on standard output, files where asked, one clear line when it cannot.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/json.hpp"
#include "bench/peers/peers.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::bench {
namespace {

const std::string kBurin = kBurinCommand;

void expect_refused(const Workplace& place, const std::string& arguments, int status,
                    const std::vector<std::string>& parts) {
    const auto outcome = place.run(kBurin + " bench " + arguments);
    EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    for (const std::string& part : parts) {
        EXPECT_NE(outcome.output.find(part), std::string::npos) << "expected '" << part << "' in: " << outcome.output;
    }
    EXPECT_EQ(place.files(), 0u) << arguments;
}

}  // namespace

TEST(BenchCommand, WritesJsonToStandardOutputAndTheCarvedMesh) {
    const Workplace place;
    const auto outcome = place.run(
        kBurin + " bench stroke --resolution 24 --updates 5 --threads 1 --engine cpu --json - --export part.ply");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto report = Json::parse(outcome.output);
    EXPECT_EQ(report["resolution"], 24);
    EXPECT_EQ(report["threads"], 1);
    EXPECT_EQ(report["tool"], "ball");
    EXPECT_EQ(report["updates"], 5);
    EXPECT_EQ(place.files(), 1u);
    EXPECT_TRUE(place.read("part.ply").starts_with("ply\n"));
}

TEST(BenchCommand, RecordsTicksWithoutASessionFileToPackAgain) {
    const Workplace place;
    const auto outcome = place.run(kBurin + " bench record --seconds 1 --folder . --json -");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto report = Json::parse(outcome.output);
    ASSERT_EQ(report["paced"].size(), 2u);
    EXPECT_EQ(report["paced"][0]["pushed"], 1000);
    EXPECT_EQ(report["paced"][0]["lost"], 0);
    EXPECT_FALSE(report.contains("packed_bytes_per_s")) << "how well ticks are packed depends on what the hand did";
    EXPECT_EQ(place.files(), 0u);
}

TEST(BenchCommand, MeasuresDocumentsOfAMeshAndLeavesNoneBehind) {
    const Workplace place;
    place.write("octahedron.obj",
                "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\nf 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\n"
                "f 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
    const auto outcome = place.run(kBurin +
                                   " bench document octahedron.obj --journal-resolution 24 --resolution 32 --updates 60"
                                   " --strokes 7 --runs 2 --folder . --json -");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto report = Json::parse(outcome.output);
    EXPECT_EQ(report["journal"]["changes"], 2) << "after half a second, and at the stroke's end";
    EXPECT_GT(report["journal"]["updates"], 0);
    EXPECT_GT(report["journal"]["unsafe_ms"]["p99"], 0);
    EXPECT_EQ(report["save"]["strokes"], 7);
    EXPECT_GT(report["save"]["changed_bytes"], 0);
    EXPECT_GT(report["save"]["written_bytes"], report["save"]["page_bytes"]);
    EXPECT_EQ(report["open"]["cold"]["open_ms"].size(), 2u);
    EXPECT_GT(report["size"]["document_bytes"], 0);
    EXPECT_EQ(place.files(), 1u);
}

TEST(BenchCommand, PrintsATableOfSweptCuts) {
    const Workplace place;
    const auto outcome = place.run(kBurin + " bench stroke --resolution 24 --updates 5 --tool capsule --json out.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("update_ms_median"), std::string::npos);
    EXPECT_EQ(Json::parse(place.read("out.json"))["tool"], "capsule");
}

TEST(BenchCommand, CarvesSeveralScenesAndPutsThemInOneTable) {
    const Workplace place;
    place.write("octahedron.obj",
                "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\nf 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\n"
                "f 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
    const auto outcome = place.run(kBurin + " bench stroke --resolution 24 --updates 4 --threads 1 --plain --scene " +
                                   "cube turned-cube mesh:octahedron.obj --json out.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 4) << "a title and a row for each scene";
    EXPECT_NE(outcome.output.find("with light"), std::string::npos);
    const auto reports = Json::parse(place.read("out.json"));
    ASSERT_EQ(reports.size(), 3u);
    std::set<std::string> scenes;
    for (const auto& report : reports) {
        scenes.insert(report["scene"].get<std::string>());
        EXPECT_TRUE(report["update_with_undo_ms_median"].is_null());
    }
    EXPECT_EQ(scenes,
              (std::set<std::string>{"stroke-1000 (first 4)", "stroke-1000 (first 4)-turned", "octahedron (first 4)"}));
}

TEST(BenchCommand, ComparesWithOpenVdbOrSaysHow) {
    const Workplace place;
    if (!has_peers()) {
        expect_refused(place, "stroke --resolution 24 --updates 5 --peer openvdb", 1,
                       {"openvdb", "scripts/setup --peers"});
        return;
    }
    const auto outcome = place.run(kBurin + " bench stroke --resolution 24 --updates 5 --peer openvdb --json -");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto report = Json::parse(outcome.output);
    const auto ours = report["update_ms_median"].get<double>();
    const auto theirs = report["openvdb_update_ms_median"].get<double>();
    EXPECT_GT(theirs, 0.0);
    EXPECT_NEAR(report["openvdb_ratio"].get<double>(), theirs / ours, 1e-9 * theirs / ours);
    for (const char* key : {"openvdb_cut_rms_h", "openvdb_edge_rms_h", "openvdb_rim_rms_h", "openvdb_brush_ratio"}) {
        EXPECT_TRUE(report.contains(key)) << key;
    }
    EXPECT_EQ(report["openvdb_threads"], report["threads"]);
}

TEST(BenchCommand, WritesTheComparisonWhereAsked) {
    const Workplace place;
    const auto outcome = place.run(kBurin + " bench pareto --smallest 16 --largest 16 --largest-on-software-vulkan 0" +
                                   " --updates 3 --cgal-updates 1 --csv p.csv --svg p.svg --json p.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("Burin cpu"), std::string::npos);
    EXPECT_NE(place.read("p.csv").find("Burin cpu"), std::string::npos);
    EXPECT_TRUE(place.read("p.svg").starts_with("<svg "));
    EXPECT_FALSE(Json::parse(place.read("p.json"))["rows"].empty());
}

TEST(BenchCommand, SaysWhatIsMissingWhereThereIsNoDeviceToCompare) {
    const Workplace place;
    const std::string without = "VK_DRIVER_FILES=/nowhere VK_ICD_FILENAMES=/nowhere ";
    const auto outcome = place.run(without + kBurin + " bench engines --json engines.json");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("; ")) << "a remedy: " << outcome.output;
    const auto record = place.run(without + "BURIN_PROGRAM=" + kBurin + " '" + kBenchRecord + "' gpu --small --into .");
    EXPECT_EQ(record.status, 1) << record.output;
    EXPECT_EQ(place.files(), 0u);
}

// In place of the program: a difference of the engines, no frames, and empty figures of all else.
TEST(BenchCommand, RecordOfAGpuNamesWhatFailedAndKeepsAllElse) {
    const Workplace place;
    place.write("program",
                "#!/bin/sh\nfor file; do :; done\n"
                "case \"$*\" in\n"
                "  *engines*) printf '{\\n  \"device\": \"A Card (X1)\",\\n  \"driver\": \"d\",\\n'\n"
                "    printf '  \"machine\": \"m\"\\n}\\n' ;;\n"
                "  *) echo '{}' ;;\nesac >\"$file\"\n"
                "case \"$*\" in *engines*) exit 1 ;; *frame*) rm \"$file\"; exit 1 ;; esac\n");
    place.write("burin", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo burin 1.2.3; else sh '" +
                             (place / "program").string() + "' \"$@\"; fi\n");
    const auto outcome = place.run("chmod +x burin && mkdir out && BURIN_PROGRAM=./burin '" +
                                   std::string(kBenchRecord) + "' gpu --small --into out");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("found a difference: \"bench engines")) << outcome.output;
    const Json record = Json::parse(place.read("out/gpu-a-card-x1.json"));
    EXPECT_EQ(record["device"], "A Card (X1)");
    EXPECT_EQ(record["program"], "burin 1.2.3");
    EXPECT_EQ(record["engines"]["machine"], "m");
    EXPECT_TRUE(record["frame"].is_null());
    EXPECT_EQ(record["failed"].size(), 2u);
    EXPECT_EQ(record["strokes"].size(), 30u);
}

TEST(BenchCommand, RecordOfAGpuSaysWhatItCannotDo) {
    const Workplace place;
    const std::string script = " '" + std::string(kBenchRecord) + "' gpu ";
    const auto expect = [&](const std::string& command, int status, const std::string& part) {
        const auto outcome = place.run(command);
        EXPECT_EQ(outcome.status, status) << outcome.output;
        EXPECT_TRUE(outcome.output.contains(part)) << outcome.output;
    };
    expect("BURIN_PROGRAM=/nowhere/burin" + script + "--small", 1, "/nowhere/burin: is no program");
    expect("BURIN_PROGRAM=" + kBurin + script + "--into nowhere", 2, "--into nowhere");
    expect("BURIN_PROGRAM=" + kBurin + script + "--large", 2, "--large");
    EXPECT_EQ(place.files(), 0u);
}

TEST(BenchCommand, RefusesWhatItCannotDo) {
    const Workplace place;
    expect_refused(place, "stroke --resolution 8", 2, {"--resolution", "burin bench stroke --help"});
    expect_refused(place, "stroke --engine auto", 2, {"--engine"});
    expect_refused(place, "stroke --tool spoon", 2, {"--tool"});
    expect_refused(place, "stroke --peer blender", 2, {"--peer"});
    expect_refused(place, "stroke --updates 0", 2, {"--updates"});
    expect_refused(place, "stroke --tool capsule --peer openvdb", 1, {"openvdb", "--tool"});
    expect_refused(place, "stroke --tool cone --peer openvdb", 1, {"openvdb", "--tool"});
    expect_refused(place, "stroke --swept --peer openvdb", 1, {"openvdb", "--swept"});
    expect_refused(place, "engines --operations 0", 2, {"--operations"});
    expect_refused(place, "engines --resolution 8", 2, {"--resolution", "burin bench engines --help"});
    expect_refused(place, "engines --json nowhere/e.json", 1, {"nowhere/e.json", "make the folder"});
    expect_refused(place, "stroke --scene sphere", 1, {"sphere", "turned-cube"});
    expect_refused(place, "stroke --scene mesh:nowhere.obj", 1, {"nowhere.obj"});
    {
        const Workplace with_file;  // its middle lies outside
        with_file.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        const auto outcome = with_file.run(kBurin + " bench stroke --resolution 24 --scene mesh:t.obj");
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.output.find("nowhere to carve"), std::string::npos) << outcome.output;
    }
    expect_refused(place, "stroke --scene cube turned-cube --export part.ply", 1, {"part.ply", "--scene"});
    expect_refused(place, "stroke --scene turned-cube --peer openvdb", 1, {"openvdb", "--scene"});
    expect_refused(place, "stroke --json nowhere/out.json", 1, {"nowhere/out.json", "make the folder"});
    expect_refused(place, "stroke --export part.xyz", 1, {"part.xyz", ".stl"});
    expect_refused(place, "pareto --svg nowhere/p.svg", 1, {"nowhere/p.svg"});
    expect_refused(place, "fly", 2, {"subcommand"});
}

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
// burin bench as its user meets it: JSON on standard output, files where asked, one clear line when it cannot.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/peers/peers.hpp"
#include "tests/app/run_command.hpp"
#include "tests/support/read_json.hpp"

namespace burin::bench {
namespace {

const std::string kBurin = BURIN_COMMAND;

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
    const auto report = read_json(outcome.output);
    EXPECT_EQ(report["resolution"], 24);
    EXPECT_EQ(report["threads"], 1);
    EXPECT_EQ(report["tool"], "ball");
    EXPECT_EQ(report["updates"], 5);
    EXPECT_EQ(place.files(), 1u);
    EXPECT_TRUE(place.read("part.ply").starts_with("ply\n"));
}

TEST(BenchCommand, PrintsATableOfSweptCuts) {
    const Workplace place;
    const auto outcome = place.run(kBurin + " bench stroke --resolution 24 --updates 5 --tool capsule --json out.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("update_ms_median"), std::string::npos);
    EXPECT_EQ(read_json(place.read("out.json"))["tool"], "capsule");
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
    const auto report = read_json(outcome.output);
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
    EXPECT_FALSE(read_json(place.read("p.json"))["rows"].empty());
}

TEST(BenchCommand, RefusesWhatItCannotDo) {
    const Workplace place;
    expect_refused(place, "stroke --resolution 8", 2, {"--resolution", "burin bench --help"});
    expect_refused(place, "stroke --engine auto", 2, {"--engine"});
    expect_refused(place, "stroke --tool cone", 2, {"--tool"});
    expect_refused(place, "stroke --peer blender", 2, {"--peer"});
    expect_refused(place, "stroke --updates 0", 2, {"--updates"});
    expect_refused(place, "stroke --tool capsule --peer openvdb", 1, {"openvdb", "--tool"});
    expect_refused(place, "stroke --json nowhere/out.json", 1, {"nowhere/out.json", "make the folder"});
    expect_refused(place, "stroke --export part.xyz", 1, {"part.xyz", ".stl"});
    expect_refused(place, "pareto --svg nowhere/p.svg", 1, {"nowhere/p.svg"});
    expect_refused(place, "fly", 2, {"subcommand"});
}

}  // namespace burin::bench

// SPDX-License-Identifier: MIT
// The same command gives the same files, whenever and with however many threads it runs.
#include <gtest/gtest.h>

#include <cmath>

#include "base/json.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kBurin = kBurinCommand;

// A wave across the top of a ball of 5 cm, pressed in by 2 mm, with the tool lifted at both ends.
std::string wave() {
    std::string text = kStrokeHeader;
    for (int i = 0; i <= 60; ++i) {
        const double t = i / 60.0, x = -0.02 + 0.04 * t, y = 0.008 * std::sin(12 * t);
        const bool lifted = i == 0 || i == 60;
        const double r = 0.05 + 0.004 + (lifted ? 0.004 : -0.002);
        const double z = std::sqrt(r * r - x * x - y * y);
        text += std::to_string(0.02 * i) + "," + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) +
                ",0,0,0,1," + (lifted ? "0" : "1") + "\n";
    }
    return text;
}

Json without_timing(const std::string& text) {
    Json report = Json::parse(text);
    report["timing"] = nullptr;
    report["engine"]["device"] = nullptr;  // says how many threads there are
    return report;
}

}  // namespace

TEST(Sculpt, SameCommandTwiceAndAnyNumberOfThreadsGiveTheSameFiles) {
    for (const std::string hand : {"rigid", "simulated"}) {
        Workplace place;
        place.write("wave.csv", wave());
        const auto run = [&](const std::string& name, int threads) {
            const auto outcome =
                place.run(kBurin + " sculpt --workpiece ball:0.05 --tool ball:0.004 --stroke wave.csv " +
                          "--resolution 96 --engine cpu --press 1 --grip 600 --hand " + hand + " --threads " +
                          std::to_string(threads) + " --export part.stl --export part.ply --report r.json");
            EXPECT_EQ(outcome.status, 0) << outcome.output;
            for (const std::string file : {"part.stl", "part.ply", "r.json"}) {
                std::filesystem::rename(place / file, place / (name + file));
            }
        };
        run("a_", 1);
        run("b_", 1);
        run("c_", 2);
        run("d_", 5);
        ASSERT_GT(place.read("a_part.stl").size(), 100'000u);
        for (const std::string other : {"b_", "c_", "d_"}) {
            EXPECT_TRUE(place.read("a_part.stl") == place.read(other + "part.stl")) << hand << " " << other;
            EXPECT_TRUE(place.read("a_part.ply") == place.read(other + "part.ply")) << hand << " " << other;
            EXPECT_EQ(without_timing(place.read("a_r.json")), without_timing(place.read(other + "r.json"))) << hand;
        }
        const auto report = without_timing(place.read("a_r.json"));
        EXPECT_GT(report["carving"]["volume_removed_m3"].get<double>(), 1e-7);
        if (hand == "simulated") {
            EXPECT_GT(report["feel"]["ticks_in_contact"].get<int>(), 100);
            EXPECT_GT(report["feel"]["force_max_N"].get<double>(), 0.05);
            EXPECT_LE(report["feel"]["force_max_N"].get<double>(), 3.3);
        }
    }
}

TEST(Sculpt, ASurfaceThatIsOnlyTouchedPushesBackAndStaysWhole) {
    Workplace place;
    std::string press = kStrokeHeader;  // the hand wants the tool 5 mm inside, without the button
    press += "0,0,0,0.064,0,0,0,1,0\n1,0,0,0.049,0,0,0,1,0\n2,0,0,0.049,0,0,0,1,0\n";
    place.write("press.csv", press);
    const auto outcome = place.run(kBurin +
                                   " sculpt --workpiece ball:0.05 --tool ball:0.004 --stroke press.csv --resolution 96 "
                                   "--hand simulated --report r.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto report = without_timing(place.read("r.json"));
    EXPECT_EQ(report["carving"]["volume_removed_m3"].get<double>(), 0.0);
    // The grip is a spring of 200 N/m whose end is held 5 mm inside; the wall is 600 N/m. At rest the spring's force
    // less friction (0.26 N) stands against the wall: at least (200 * 0.005 - 0.26) * 600 / 800 N, at most 0.26 N more
    // than without.
    const double force = report["feel"]["force_max_N"].get<double>();
    EXPECT_GT(force, 0.55);
    EXPECT_LT(force, 1.6);
}

// Two strokes, both taken back: the exported workpiece is the one that nobody touched, byte for byte.
TEST(Sculpt, UndoneStrokesLeaveNoTrace) {
    Workplace place;
    std::string text = kStrokeHeader;
    for (int i = 0; i < 40; ++i) {
        const bool between = i == 20;  // the tool is lifted here, which ends the first stroke
        text += std::to_string(0.02 * i) + "," + std::to_string(-0.02 + 0.001 * i) + ",0,0.05,0,0,0,1," +
                (between ? "0" : "1") + "\n";
    }
    place.write("two.csv", text);
    for (const std::string engine : {"cpu", "vulkan"}) {
        const std::string common = kBurin + " sculpt --workpiece ball:0.05 --resolution 48 --engine " + engine;
        const auto touched = place.run(common + " --tool ball:0.004 --stroke two.csv --export touched.ply");
        if (engine == "vulkan" && touched.status != 0) continue;  // no Vulkan device that can carve
        ASSERT_EQ(touched.status, 0) << touched.output;
        ASSERT_EQ(place.run(common + " --export untouched.ply").status, 0);
        const auto undone =
            place.run(common + " --tool ball:0.004 --stroke two.csv --undo 2 --export undone.ply --report r.json");
        ASSERT_EQ(undone.status, 0) << undone.output;
        EXPECT_EQ(Json::parse(place.read("r.json"))["undo"]["strokes_undone"], 2);
        EXPECT_TRUE(place.read("undone.ply") == place.read("untouched.ply")) << engine;
        EXPECT_FALSE(place.read("undone.ply") == place.read("touched.ply")) << engine;
        const auto more = place.run(common + " --tool ball:0.004 --stroke two.csv --undo 9 --export undone.ply");
        EXPECT_EQ(more.status, 0);
        EXPECT_NE(more.output.find("2 strokes could be undone, not 9"), std::string::npos) << more.output;
    }
}

}  // namespace burin::app

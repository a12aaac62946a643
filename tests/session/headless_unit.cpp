// SPDX-License-Identifier: MIT
// Sessions that nobody sees and that ask for no picture: they run where there is no Vulkan driver at all, and end as
// they do where there is one and their frames are drawn.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// A loader that finds no driver: so does a machine without one.
const std::string kNoDriver = "VK_DRIVER_FILES=/nonexistent.json VK_ICD_FILENAMES=/nonexistent.json ";

std::string asset(const std::string& name) {
    std::ifstream in(std::string(kSessionsFolder) + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
std::string without_pictures(const std::string& script) {
    return std::regex_replace(script, std::regex("[^\n]*command (screenshot|take-screenshot)[^\n]*\n"), "");
}

class Headless : public testing::Test {
protected:
    // Runs a command offscreen and returns its output.
    std::string run(const std::string& environment, const std::string& command) {
        const auto done = place.run(environment + kBurinCommand + " " + command);
        EXPECT_EQ(done.status, 0) << done.output;
        return done.output;
    }
    Workplace place;
};

TEST_F(Headless, CarvesTheSameWithoutADriver) {
    place.write("none.txt", without_pictures(asset("first-carve.txt")));
    place.write("some.txt", asset("first-carve.txt"));
    const std::string sculpt = "sculpt --workpiece ball:0.1 --resolution 48 --width 320 --height 180 --offscreen ";
    run(kNoDriver, sculpt + "--input none.txt --outputs none");
    const auto seen = place.run(kBurinCommand + (" " + sculpt) + "--input some.txt --outputs some");
    if (seen.status != 0 && seen.output.contains("Vulkan"))
        GTEST_SKIP() << "no Vulkan driver draws the pictures of the session to compare with";
    ASSERT_EQ(seen.status, 0) << seen.output;
    ASSERT_FALSE(place.read("some/10-turned.png").empty());
    ASSERT_FALSE(place.read("none/first-carve.stl").empty());
    EXPECT_TRUE(place.read("none/first-carve.stl") == place.read("some/first-carve.stl"));
}

TEST_F(Headless, ExploresAWorldHoldsItWithAGloveAndPlaysAnExercise) {
    for (const std::string& name :
         {std::string("garden.txt"), std::string("hand-pinch.txt"), std::string("rehab-ball.txt")})
        place.write(name, without_pictures(asset(name)));
    const std::string worlds = std::string(kSessionsFolder) + "/../worlds/";
    run(kNoDriver, "world " + worlds + "garden.toml --input garden.txt --offscreen --outputs g");
    run(kNoDriver, "hand " + worlds + "hand.toml --input hand-pinch.txt --offscreen --outputs h");
    run(kNoDriver, "rehab ball --input rehab-ball.txt --offscreen --outputs r");
}

TEST_F(Headless, IsRecordedInRealTimeAndReplayedWithoutADriver) {
    place.write("s.txt", "burin-input 1 short\n0.1 command force on\n0.2 command radius 0.004\n0.5 command quit\n");
    const std::string sculpt =
        "sculpt --workpiece ball:0.1 --resolution 16 --input s.txt --offscreen --record r.session";
    run(kNoDriver, sculpt);
    const std::string replayed = run(kNoDriver, "sculpt --input r.session --offscreen");
    EXPECT_NE(replayed.find("equal to the bit"), std::string::npos) << replayed;
}

// What is noted for a journal is no order that a replay, which keeps none, has to give again.
TEST_F(Headless, IsReplayedToTheBitThoughItKeptAJournal) {
    place.write("w.txt",
                "burin-input 1 short\n0.1 mouse 640 360\n0.2 command object stone stiffness 341\n"
                "0.9 command object stone stiffness 400\n1.0 command save-as a.burin\n1.2 command undo\n"
                "1.8 mouse 600 300\n1.9 command quit\n");
    run(kNoDriver, "world garden --input w.txt --offscreen --outputs o --record w.session --journal j");
    EXPECT_TRUE(run(kNoDriver, "replay w.session").contains("equal to the bit"));
    place.write(
        "s.txt",
        "burin-input 1 short\n0.1 command object stone stiffness 341\n0.9 button press left\n1.0 button release left\n"
        "1.8 command object stone stiffness 500\n2.5 command quit\n");
    run(kNoDriver,
        "world garden --workpiece ball:0.05 --resolution 16 --input s.txt --offscreen --outputs o2 "
        "--record s.session --journal j");
    EXPECT_TRUE(run(kNoDriver, "replay s.session").contains("equal to the bit"));
}

TEST_F(Headless, SaysWhatOfAScriptFollowsItsEnd) {
    place.write("s.txt", "burin-input 1 short\n0.1 command quit\n0.2 command export late.stl\n");
    const std::string ended =
        run(kNoDriver, "sculpt --workpiece ball:0.1 --resolution 16 --input s.txt --offscreen --outputs o");
    EXPECT_TRUE(ended.contains("command export of 0.20 s")) << ended;
}

// What a replay is asked for and cannot give is told beside what came of its ticks.
TEST_F(Headless, SaysWhatCameOfTheTicksWhereAnObjectOfTheRecordingIsMissing) {
    place.write("m.txt",
                "burin-input 1 short\n0.1 mouse 640 360\n0.3 command object nope stiffness 341\n0.5 command quit\n");
    const std::string world = kNoDriver + kBurinCommand + " world garden --offscreen --outputs o ";
    static_cast<void>(place.run(world + "--input m.txt --record m.session"));
    const auto replayed = place.run(world + "--input m.session");
    EXPECT_EQ(replayed.status, 1) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("ticks were compared, none differs")) << replayed.output;
}

TEST_F(Headless, SaysBeforeItBeginsThatAPictureNeedsADriver) {
    place.write("s.txt", "burin-input 1 short\n0.1 command screenshot a.png\n0.2 command quit\n");
    const auto refused =
        place.run(kNoDriver + kBurinCommand + " sculpt --workpiece ball:0.1 --resolution 16 --input s.txt --offscreen");
    EXPECT_EQ(refused.status, 1) << refused.output;
    EXPECT_NE(refused.output.find("Vulkan"), std::string::npos) << refused.output;
}

}  // namespace
}  // namespace burin::session

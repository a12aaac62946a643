// SPDX-License-Identifier: MIT
// A live session by the command line: recorded into a session file, done again, drawn, and given back as a text log.
#include <gtest/gtest.h>

#include <filesystem>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kLiveBurin = kBurinCommand;

bool tells(const Workplace::Outcome& outcome, const std::string& text) {
    return outcome.output.find(text) != std::string::npos;
}

}  // namespace

TEST(LiveRecording, IsDoneAgainDrawnAndGivenBackAsText) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    // Carves into the ball, exports and takes a picture: what a replay that compares leaves out.
    at.write("s.txt", R"(burin-input 1 test
0.02 mouse 320 180
0.05 scroll 0 15
0.1 button press left
0.12 scroll 0 10
0.3 mouse 350 190
0.35 button release left
0.36 command screenshot carved.png
0.4 command export part.stl
0.9 close
)");
    const std::string carve =
        "--workpiece ball:0.1 --resolution 32 --tool ball:0.012 --width 320 --height 240 "
        "--input s.txt --offscreen --record a.session";
    const auto recorded = at.run(kLiveBurin + " sculpt " + carve);
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(tells(recorded, "ticks recorded, acknowledged up to tick ")) << recorded.output;
    EXPECT_TRUE(tells(recorded, ", 0 lost")) << recorded.output;
    EXPECT_TRUE(tells(at.run(kLiveBurin + " sculpt " + carve), "never overwrites"));

    const auto again = at.run(kLiveBurin + " replay a.session --pictures seen --every 0.5");
    EXPECT_EQ(again.status, 0) << again.output;
    EXPECT_TRUE(tells(again, "equal to the bit")) << again.output;
    std::size_t pictures = 0;
    for (const auto& file : std::filesystem::directory_iterator(at / "seen"))
        pictures += file.path().filename().string().starts_with("000") ? 1u : 0u;
    EXPECT_GE(pictures, 1u) << "the first frame's, and more where frames come as often";
    EXPECT_TRUE(std::filesystem::exists(at / "seen/carved.png"));
    EXPECT_FALSE(std::filesystem::exists(at / "seen/part.stl"));

    const auto other = at.run(kLiveBurin + " replay a.session --set tool=ball:0.0121");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(tells(other, "equal ticks: tick ")) << other.output;
    EXPECT_TRUE(tells(at.run(kLiveBurin + " replay a.session --set tol=1"), "no option")) << "a setting that is none";

    ASSERT_EQ(at.run(kLiveBurin + " convert a.session --to log a.log").status, 0);
    const auto by_text = at.run(kLiveBurin + " sculpt --input a.log --offscreen --outputs text");
    EXPECT_EQ(by_text.status, 0) << by_text.output;
    const auto by_file = at.run(kLiveBurin + " sculpt --input a.session --offscreen --outputs file");
    EXPECT_EQ(by_file.status, 0) << by_file.output;
    EXPECT_TRUE(tells(by_file, "equal to the bit")) << by_file.output;
    EXPECT_EQ(at.read("text/carved.png"), at.read("file/carved.png"));
    EXPECT_EQ(at.read("text/part.stl"), at.read("file/part.stl"));
}

}  // namespace burin::app

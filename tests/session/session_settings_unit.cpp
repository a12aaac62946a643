// SPDX-License-Identifier: MIT
// The first line of a recording: what an option takes there is what it takes on the command line.
#include "session/state/session_settings.hpp"

#include <gtest/gtest.h>

namespace burin::session {
namespace {

std::string refusal_of(const std::string& settings) {
    const auto read = options_as_recorded("burin sculpt " + settings, SculptOptions{});
    return read ? "" : read.error().line();
}

}  // namespace

TEST(SettingsOfARecording, BeyondTheBoundsOfTheCommandLineAreRefusedByThem) {
    for (const auto& [settings, said] : std::vector<std::pair<std::string, std::string>>{
             {"--width 9", "--width 9 is not from 64 to 8192"},
             {"--height 8193", "--height 8193 is not from 64 to 8192"},
             {"--resolution 2049", "--resolution 2049 is not from 16 to 2048"},
             {"--undo-memory 0", "--undo-memory 0 is not from 1 to 1048576"},
             {"--sweep-tolerance nan", "--sweep-tolerance nan is not from 0.001 to 1000"},
             {"--smooth-strength 1.5", "--smooth-strength 1.5 is not from 0 to 1"},
             {"--samples 3", "--samples 3 is not one of 0, 1, 4"},
             {"--width 99999999999999999999", "--width 99999999999999999999 is no value of that option"},
             {"--resolution", "--resolution is no value of that option"},
             {"--close-holes no", "--close-holes no is no value of that option"},
             {"--flavour sweet", "--flavour is no option that a session knows"}}) {
        EXPECT_NE(refusal_of(settings).find(said), std::string::npos) << settings << ": " << refusal_of(settings);
    }
    EXPECT_EQ(refusal_of("--width 64 --height 8192 --samples 4 --resolution 16 --close-holes"), "");
}

TEST(SettingsOfARecording, AnOptionIsFoundWhateverElseIsOnTheLine) {
    const std::string line = "burin sculpt --workpiece \"a --device.stl\" --close-holes --device simulated-wand:w.toml";
    EXPECT_EQ(*option_on(line, "--device"), "simulated-wand:w.toml");
    EXPECT_EQ(*option_on(line, "--close-holes"), "");
    EXPECT_EQ(*option_on(line, "--points"), "");
    EXPECT_EQ(*option_on("somebody's own --device x", "--device"), "");
}

}  // namespace burin::session

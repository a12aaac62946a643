// SPDX-License-Identifier: MIT
// A scripted user works a whole session through, with and without a window; the validation layer listens.
#include <gtest/gtest.h>

#include <set>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"
#include "tests/window/xvfb.hpp"

namespace burin::session {
namespace {

// Presses the tool into the ball's front and draws it to the side, between two exports; takes it back; does it again.
// The hand comes to where the mouse was up to half a second later, since the script tells so few places; what follows
// the stroke waits for that.
const std::string kScript = R"(burin-input 1 test
0.05 mouse 160 90
0.1 scroll 0 15
0.4 command screenshot before.png
0.45 command export before.stl
0.5 button press left
0.55 scroll 0 8
0.7 mouse 165 92
0.8 mouse 175 95
0.9 mouse 185 98
1.1 command screenshot carving.png
1.15 button release left
1.2 scroll 0 -14
1.8 command export carved.stl
1.85 key press z ctrl
1.9 key release z ctrl
1.95 command export undone.stl
2 key press y ctrl
2.05 key release y ctrl
2.1 command export redone.stl
2.15 command operation paint
2.2 command stereo-mode anaglyph_red_cyan
2.25 command screenshot anaglyph.png
2.3 key press m
2.32 key release m
2.35 command screenshot next.png
2.4 command stereo-mode side_by_side
2.45 command screenshot wide.png
2.5 button press middle
2.55 mouse 250 98
2.6 button release middle
2.65 command screenshot turned.png
2.7 command quit
9 command screenshot never.png
)";

std::string sculpt(const std::string& more) {
    return std::string("BURIN_VULKAN_VALIDATION=1 ") + kBurinCommand +
           " sculpt --workpiece ball:0.1 --resolution 32 --tool ball:0.012 --width 320 --height 180 " + more;
}

class Session : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
    // Runs the script; its pictures and meshes go into the folder.
    Workplace::Outcome play(const std::string& folder, const std::string& more, const std::string& script = kScript) {
        place.write("script.txt", script);
        const auto outcome = place.run("mkdir " + folder + " && cd " + folder + " && " +
                                       sculpt("--input ../script.txt --outputs . " + more));
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(outcome.output.find("Vulkan validation"), std::string::npos) << outcome.output;
        return outcome;
    }
    Workplace place;
};

}  // namespace

TEST_F(Session, CarvesUndoesShowsAndExportsAsItIsTold) {
    play("a", "--offscreen");
    const std::string before = place.read("a/before.stl"), carved = place.read("a/carved.stl");
    ASSERT_GT(before.size(), 1000u);
    EXPECT_NE(carved, before);
    EXPECT_EQ(place.read("a/undone.stl"), before);
    EXPECT_EQ(place.read("a/redone.stl"), carved);
    EXPECT_NE(place.read("a/before.png"), place.read("a/carving.png"));
    EXPECT_NE(place.read("a/anaglyph.png"), place.read("a/next.png"));
    EXPECT_NE(place.read("a/wide.png"), place.read("a/turned.png"));
    EXPECT_TRUE(place.read("a/never.png").empty()) << "after quitting nothing happens";
}

TEST_F(Session, ShowsTheSameFramesEachTimeAndInAWindowTheSameAsWithout) {
    play("a", "--offscreen");
    play("b", "--offscreen --threads 1");
    const bool has_display = !window::Xvfb::running().name().empty();
    if (has_display) play("c", "");
    for (const std::string name :
         {"before.png", "carving.png", "anaglyph.png", "next.png", "wide.png", "turned.png", "carved.stl"}) {
        const std::string first = place.read("a/" + name);
        ASSERT_FALSE(first.empty()) << name;
        EXPECT_TRUE(first == place.read("b/" + name)) << name;
        if (!has_display) continue;
        EXPECT_TRUE(first == place.read("c/" + name)) << name;
    }
    if (!has_display) GTEST_SKIP() << "Xvfb is not installed or does not start: the window was left out";
}

// In a cave: a head that a tracker follows, loses and finds again; carving; a mode that this surface has not.
const std::string kCaveScript = R"(burin-input 1 test
0.02 head 0 1.6 1.5 0 0 0 1
0.04 head 0.004 1.6 1.5 0 0 0 1
0.06 head 0.008 1.6 1.5 0 0 0 1
0.1 command screenshot first.png
0.11 head 0.01 1.6 1.5 0 0 0 1
0.15 button press left
0.16 scroll 0 25
0.3 mouse 100 100
0.4 mouse 140 100
0.5 button release left
0.7 command screenshot lost.png
0.75 head 0.01 1.6 1.5 0 0 0 1
0.77 head 0.3 1.6 1.5 0 0 0 1
0.8 command stereo-mode two_layers
0.85 wand 0 0 1.2 1 0 0 0 1
0.86 wand-button 0 press 0
0.9 wand 0 0.3 1.2 1 0 0 0 1
0.92 wand-button 0 release 0
0.95 command screenshot moved.png
1 command quit
)";

TEST_F(Session, ShowsEachScreenOfAWallToATrackedHead) {
    const std::string wall =
        std::string("--wall ") + kWallsFolder + "/cave.toml --windowed --stereo side_by_side_half ";
    const auto outcome = play("a", wall + "--offscreen", kCaveScript);
    for (const char* said : {"head tracker: no sample", "the tracker sees the head again", "m/s"})
        EXPECT_NE(outcome.output.find(said), std::string::npos) << said << " in " << outcome.output;
    const auto picture = [&](const std::string& step, const std::string& screen) {
        return place.read("a/" + step + "-" + screen + ".png");
    };
    for (const char* step : {"first", "lost", "moved"}) {
        std::set<std::string> screens;
        for (const char* screen : {"left", "front", "right", "floor"}) {
            EXPECT_FALSE(picture(step, screen).empty()) << step << screen;
            screens.insert(picture(step, screen));
        }
        EXPECT_EQ(screens.size(), 4u) << "each screen shows something else, " << step;
    }
    EXPECT_FALSE(picture("first", "front") == picture("lost", "front")) << "the head glides, the tool is elsewhere";
    EXPECT_FALSE(picture("lost", "front") == picture("moved", "front")) << "a wand has carried the scene";
    if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed: the windows were left out";
    const auto in_windows = play("b", wall, kCaveScript);
    EXPECT_NE(in_windows.output.find("layer)"), std::string::npos)
        << "this display has no quad buffer: " << in_windows.output;
    for (const char* screen : {"left", "front", "right", "floor"}) {
        for (const char* step : {"first", "lost"}) {
            const std::string name = std::string(step) + "-" + screen + ".png";
            EXPECT_TRUE(place.read("a/" + name) == place.read("b/" + name)) << name;
        }
    }
}

TEST_F(Session, ShowsEachEyeInItsTurnOrInAWindowOfItsOwn) {
    if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
    const std::string script = R"(burin-input 1 test
0.1 command stereo-mode two_windows
0.3 command screenshot windows.png
0.4 command stereo-mode frame_sequential
0.6 command screenshot turns.png
0.7 command stereo-mode side_by_side
0.8 command screenshot side.png
0.9 command quit
)";
    play("a", "", script);
    const std::string windows = place.read("a/windows.png");
    ASSERT_FALSE(windows.empty());
    EXPECT_TRUE(windows == place.read("a/turns.png"));
    EXPECT_FALSE(place.read("a/side.png").empty());
}

TEST_F(Session, RefusesAWallThatCannotBe) {
    place.write("bent.toml",
                "name = \"bent\"\nunits = \"m\"\n[[screen]]\nname = \"front\"\nlower_left = [0, 0, 0]\n"
                "lower_right = [1, 0, 0]\nupper_left = [2, 0, 0]\n");
    const auto outcome = place.run(sculpt("--wall bent.toml --live"));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("front"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("line"), std::string::npos) << outcome.output;
}

TEST_F(Session, SaysWhatIsWrongAndGoesOn) {
    const auto outcome = play("a", "--offscreen", R"(burin-input 1 test
0.1 command undo
0.2 command redo
0.3 key press s ctrl
0.7 command screenshot end.png
0.8 command quit
)");
    for (const char* said : {"no stroke to undo", "no stroke to redo", "saved ball.burin"})
        EXPECT_NE(outcome.output.find(said), std::string::npos) << said << " in " << outcome.output;
    EXPECT_FALSE(place.read("a/end.png").empty());
}

TEST_F(Session, WithoutADisplaySaysWhatToDo) {
    const auto outcome = place.run("env -u DISPLAY -u WAYLAND_DISPLAY " + sculpt("--live"));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("DISPLAY"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("--offscreen"), std::string::npos) << outcome.output;
}

TEST_F(Session, OffscreenWithoutInputIsRefused) {
    const auto outcome = place.run(sculpt("--offscreen"));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("--input"), std::string::npos) << outcome.output;
}

}  // namespace burin::session

// SPDX-License-Identifier: MIT
// A whole session whose graphics device or window surface is lost while somebody carves goes on as if nothing had
// happened.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <string>

#include "gpu/core.hpp"
#include "tests/desk/played_session.hpp"
#include "tests/renderer/output/output_pictures.hpp"
#include "tests/support/places.hpp"
#include "tests/window/xvfb.hpp"

namespace burin::session {
namespace {

class SessionLoss : public PlayedSession {
protected:
    // What the engine says of its losses stands in the lower half of a picture.
    void expect_same_above_messages(const std::string& one, const std::string& other) {
        const Image first = renderer::read_png(place / one), second = renderer::read_png(place / other);
        ASSERT_EQ(first.size, second.size);
        const std::size_t half = first.rgba.size() / 2;
        ASSERT_GT(half, 0u);
        EXPECT_TRUE(std::ranges::equal(std::span(first.rgba).first(half), std::span(second.rgba).first(half)))
            << other << " is another one";
    }
};

DeskOptions desk(bool offscreen) {
    DeskOptions shown;
    shown.offscreen = offscreen;
    shown.width = 720;
    shown.height = 360;
    return shown;
}

DeskOptions cave(bool offscreen) {
    DeskOptions shown = desk(offscreen);
    shown.wall = std::string(kWallsFolder) + "/cave.toml";
    shown.stereo = "side_by_side_half";
    shown.windowed = true;
    shown.width = 240;
    shown.height = 160;
    return shown;
}

// At the first picture, while carving (twice, one right after the other), in the frame of carving.png, which has to be
// drawn again, and while the tool is taken away.
const std::set<int> kFrames{0, 20, 24, 25, 32, 50};

Mishap device_lost_at(const std::set<int>& frames) {
    return [left = frames](int frame, Presenter& stage) mutable {
        if (left.erase(frame) > 0) stage.device().core()->lose_at_next_submit = true;
    };
}

Mishap device_lost() { return device_lost_at(kFrames); }

Mishap surface_lost() {
    return [left = kFrames](int frame, Presenter& stage) mutable {
        if (left.erase(frame) > 0) stage.device().core()->lose_surface_at_next_acquire = true;
    };
}

const std::vector<std::string> kDeskFiles{"before.png", "carving.png", "end.png", "carved.stl"};

}  // namespace

TEST_F(SessionLoss, OfTheDeviceLosesNothingThatWasCarved) {
    ASSERT_TRUE(play("a", desk(true)).outcome);
    EXPECT_FALSE(place.read("a/before.png") == place.read("a/end.png")) << "nothing was carved";
    const Played played = play("b", desk(true), device_lost());
    ASSERT_TRUE(played.outcome) << played.outcome.error().line();
    EXPECT_EQ(played.recoveries, static_cast<int>(kFrames.size()));
    EXPECT_NE(played.said.find("the graphics device was lost"), std::string::npos) << played.said;
    expect_same("a", "b", kDeskFiles);
}

// The engine is on another lane of the device that draws; the processor carves until there is a new one.
TEST_F(SessionLoss, OfTheDeviceThatCarvesTooTakesBothToTheNewOne) {
    engine = compute::EngineChoice::cpu;
    ASSERT_TRUE(play("a", desk(true)).outcome);
    engine = compute::EngineChoice::vulkan;
    const Played sound = play("b", desk(true));
    ASSERT_TRUE(sound.outcome) << sound.outcome.error().line();
    EXPECT_EQ(sound.engine, "vulkan");
    expect_same("a", "b", kDeskFiles);
    const Played twice = play("c", desk(true), device_lost_at({20, 25}));
    ASSERT_TRUE(twice.outcome) << twice.outcome.error().line();
    EXPECT_EQ(twice.recoveries, 2);
    EXPECT_EQ(twice.engine, "vulkan") << twice.said;
    expect_same("a", "c", {"before.png", "carved.stl"});
    expect_same_above_messages("a/end.png", "c/end.png");
    const Played often = play("d", desk(true), device_lost_at({18, 20, 22, 24, 26, 28}));
    ASSERT_TRUE(often.outcome) << often.outcome.error().line();
    EXPECT_GT(often.recoveries, 3);
    EXPECT_EQ(often.engine, "cpu") << "after three losses the processor stays: " << often.said;
    expect_same("a", "d", {"before.png", "carved.stl"});
    expect_same_above_messages("a/end.png", "d/end.png");
}

TEST_F(SessionLoss, InAWindowGoesOnInTheSameWindow) {
    if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
    ASSERT_TRUE(play("a", desk(true)).outcome);
    const Played device = play("b", desk(false), device_lost());
    ASSERT_TRUE(device.outcome) << device.outcome.error().line();
    EXPECT_EQ(device.recoveries, static_cast<int>(kFrames.size()));
    expect_same("a", "b", kDeskFiles);
    const Played surface = play("c", desk(false), surface_lost());
    ASSERT_TRUE(surface.outcome) << surface.outcome.error().line();
    EXPECT_EQ(surface.recoveries, 0) << "a surface is made anew without a new device";
    expect_same("a", "c", kDeskFiles);
}

TEST_F(SessionLoss, BeforeAWallTakesEveryScreenAndThePanelThatStandsThereUpAgain) {
    std::vector<std::string> names{"carved.stl"};
    for (const char* step : {"before", "carving", "end"})
        for (const char* screen : {"left", "front", "right", "floor"})
            names.push_back(std::string(step) + "-" + screen + ".png");
    ASSERT_TRUE(play("a", cave(true)).outcome);
    const Played played = play("b", cave(true), device_lost());
    ASSERT_TRUE(played.outcome) << played.outcome.error().line();
    EXPECT_EQ(played.recoveries, static_cast<int>(kFrames.size()));
    expect_same("a", "b", names);
    if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
    for (const auto& [folder, mishap] : {std::pair{"c", device_lost()}, std::pair{"d", surface_lost()}}) {
        const Played in_windows = play(folder, cave(false), mishap);
        ASSERT_TRUE(in_windows.outcome) << in_windows.outcome.error().line();
        expect_same("a", folder, names);
    }
}

// A hand that goes on carving is measured as before.
TEST_F(SessionLoss, OfAllSizeForAWhileIsNoLossOfWhatIsDoneMeanwhile) {
    for (const DeskOptions& shown : {desk(true), cave(true)}) {
        const bool stands = !shown.wall.empty();
        const std::string before = stands ? "c" : "a", after = stands ? "d" : "b";
        ASSERT_TRUE(play(before, shown).outcome);
        const Played played = play(after, shown, {}, {20, 21, 22, 23, 24, 25, 26});
        ASSERT_TRUE(played.outcome) << played.outcome.error().line();
        expect_same(before, after, {"carved.stl", stands ? "end-front.png" : "end.png"});
    }
}

TEST_F(SessionLoss, OverAndOverEndsWithAReason) {
    const Played played = play("a", desk(true), [](int frame, Presenter& stage) {
        if (frame >= 20) stage.device().core()->lose_at_next_submit = true;
    });
    ASSERT_FALSE(played.outcome);
    EXPECT_NE(played.outcome.error().line().find("without a picture in between"), std::string::npos)
        << played.outcome.error().line();
}

}  // namespace burin::session

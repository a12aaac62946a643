// SPDX-License-Identifier: MIT
// Sessions on displays that are driven directly, which no machine of the tests has. In their place stands a window's
// surface, or for stereo images in memory: the session knows of no window, and opens, draws, presents, waits and
// recovers as on the display itself.
#include <gtest/gtest.h>

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "desk/present/direct_output.hpp"
#include "desk/present/session_waker.hpp"
#include "desk/run/session.hpp"
#include "gpu/core.hpp"
#include "gpu/direct_display.hpp"
#include "picture/png.hpp"
#include "tests/desk/fake_display.hpp"
#include "tests/desk/played_session.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/places.hpp"
#include "tests/window/xvfb.hpp"
#include "wall/wall_file.hpp"
#include "window/window.hpp"

namespace burin::session {
namespace {

class Displays {
public:
    DirectDriver driver() {
        return {stereo ? gpu::direct_display_extensions() : window::required_extensions().value(),
                [this](gpu::Device& device, const gpu::DisplayChoice& choice) { return open(device, choice); }};
    }
    std::vector<gpu::DisplayChoice> asked;
    std::set<std::string> unplugged;
    std::optional<FakeDisplay> stereo;  // in the place of windows

private:
    Result<gpu::DisplaySurface> open(gpu::Device& device, const gpu::DisplayChoice& choice) {
        asked.push_back(choice);
        if (unplugged.contains(choice.display)) return fail("direct display", "no display", "plug one in");
        const gpu::DisplayMode mode{choice.width, choice.height, 75.0, choice.stereo != DisplayStereo::none};
        if (stereo)
            return gpu::DisplaySurface{stereo->take(device, {choice.width, choice.height}), choice.display, mode};
        auto window = windows_.find(choice.display);
        if (window == windows_.end()) {
            auto made = window::Window::create({.title = choice.display,
                                                .width = static_cast<int>(choice.width),
                                                .height = static_cast<int>(choice.height),
                                                .decorated = false});
            if (!made) return std::unexpected(made.error());
            window = windows_.emplace(choice.display, std::move(*made)).first;
        }
        auto surface = window->second.create_surface(device);
        if (!surface) return std::unexpected(surface.error());
        return gpu::DisplaySurface{std::move(*surface), choice.display, mode};
    }
    std::map<std::string, window::Window> windows_;
};

class DirectSession : public PlayedSession {
protected:
    void SetUp() override {
        PlayedSession::SetUp();
        if (IsSkipped()) return;
        if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
        setenv("DISPLAY", window::Xvfb::running().name().c_str(), 1);
    }

    // The power wall, small, and driven directly.
    DeskOptions wall(DisplayStereo stereo, bool offscreen) {
        wall::WallSetup setup = *wall::read_wall(std::string(kWallsFolder) + "/powerwall.toml");
        setup.screens[0].pixels = {240, 180};
        setup.screens[0].output = "projector";
        setup.screens[0].direct = stereo;
        setup.screens[0].mode = stereo == DisplayStereo::none ? "side_by_side_half" : "two_layers";
        place.write("wall.toml", wall::wall_text(setup));
        DeskOptions live;
        live.wall = (place / "wall.toml").string();
        live.offscreen = offscreen;
        return live;
    }
    SessionSetup sculpt(const DeskOptions& live) {
        SessionSetup options = carving_setup();
        options.carve.workpiece = {"ball:0.1", 32, false};
        options.hands.tool.shape = "ball:0.012";
        options.desk = live;
        return options;
    }

    Displays displays;
};

const std::vector<std::string> kFiles{"before.png", "carving.png", "end.png", "carved.stl"};

}  // namespace

TEST_F(DirectSession, ShowsWhatItShowsOffScreenAndCarvesTheSame) {
    ASSERT_TRUE(play("a", wall(DisplayStereo::none, true)).outcome);
    const Played played = play("b", wall(DisplayStereo::none, false), {}, {}, displays.driver());
    ASSERT_TRUE(played.outcome) << played.outcome.error().line();
    EXPECT_GT(played.presented, 10u);
    ASSERT_EQ(displays.asked.size(), 1u);
    EXPECT_EQ(displays.asked[0].display, "projector");
    EXPECT_EQ(displays.asked[0].width, 240u);
    EXPECT_EQ(displays.asked[0].refresh_Hz, 120.0);
    expect_same("a", "b", kFiles);
}

TEST_F(DirectSession, GoesOnAfterTheSurfaceOrTheDeviceWasLost) {
    const std::set<int> frames{0, 20, 24, 25, 50};
    ASSERT_TRUE(play("a", wall(DisplayStereo::none, true)).outcome);
    const Mishap surface = [left = frames](int frame, Presenter& stage) mutable {
        if (left.erase(frame) > 0) stage.device().core()->lose_surface_at_next_acquire = true;
    };
    const Mishap device = [left = frames](int frame, Presenter& stage) mutable {
        if (left.erase(frame) > 0) stage.device().core()->lose_at_next_submit = true;
    };
    for (const auto& [folder, mishap, recoveries] :
         {std::tuple{"b", surface, 0}, std::tuple{"c", device, static_cast<int>(frames.size())}}) {
        displays.asked.clear();
        const Played played = play(folder, wall(DisplayStereo::none, false), mishap, {}, displays.driver());
        ASSERT_TRUE(played.outcome) << played.outcome.error().line();
        EXPECT_EQ(played.recoveries, recoveries);
        EXPECT_EQ(displays.asked.size(), 1 + frames.size());
        expect_same("a", folder, kFiles);
    }
}

TEST_F(DirectSession, CarvesOnWhileTheDisplayIsGone) {
    ASSERT_TRUE(play("a", wall(DisplayStereo::none, true)).outcome);
    for (const auto& [folder, with_device] : {std::pair{"b", false}, {"c", true}}) {
        displays.unplugged.clear();
        const Mishap unplugged = [this, with_device](int frame, Presenter& stage) {
            if (frame != 25 || !std::exchange(displays.unplugged, {"projector"}).empty()) return;
            gpu::Core& core = *stage.device().core();
            (with_device ? core.lose_at_next_submit : core.lose_surface_at_next_acquire) = true;
        };
        const Played played = play(folder, wall(DisplayStereo::none, false), unplugged, {}, displays.driver());
        ASSERT_TRUE(played.outcome) << played.outcome.error().line();
        EXPECT_EQ(played.recoveries, with_device ? 1 : 0);
        EXPECT_EQ(displays.unplugged.size(), 1u);
        expect_same("a", folder, {"carved.stl"});
    }
}

TEST_F(DirectSession, FindsADisplayThatIsThereAgain) {
    gpu::DeviceOptions with;
    with.validation = true;
    with.optional_instance_extensions = displays.driver().extensions;
    auto device = gpu::Device::create(with);
    ASSERT_TRUE(device) << device.error().line();
    DirectOutput output({.display = "projector", .width = 64, .height = 48}, displays.driver());
    ASSERT_TRUE(output.open_images(*device, 1));
    EXPECT_EQ(output.refresh_Hz(), 75.0) << "the mode's own";
    displays.unplugged = {"projector"};
    ASSERT_TRUE(output.reopen_images(*device, 1));
    EXPECT_EQ(output.size(), ImageSize{}) << "nobody would see a picture";
    EXPECT_EQ(output.acquire().answer, gpu::FrameAnswer::minimised);
    EXPECT_FALSE(output.was_shown(1) || output.vblank_count());
    ASSERT_EQ(output.take_messages().size(), 1u);
    displays.unplugged.clear();
    static_cast<void>(output.needs_showing());
    for (int i = 0; i < 1000 && output.layers() == 0; ++i) {
        output.look_after(*device);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(output.layers(), 1u);
    EXPECT_EQ(output.size(), (ImageSize{64, 48}));
    EXPECT_TRUE(output.needs_showing());
    EXPECT_EQ(output.take_messages().size(), 1u);
    EXPECT_LE(displays.asked.size(), 60u) << "it is not asked each time";
}

TEST_F(DirectSession, GivesAStereoDisplayBothEyesPicturesFromTheStart) {
    displays.stereo.emplace(2);
    std::optional<Image> left, right;
    const Mishap look = [&](int, Presenter&) {  // right after the last photograph
        if (left || !std::filesystem::exists(place / "b/end.png")) return;
        left = displays.stereo->shown(0);
        right = displays.stereo->shown(1);
    };
    ASSERT_TRUE(play("a", wall(DisplayStereo::hdmi_3d, true)).outcome);
    const Played played = play("b", wall(DisplayStereo::hdmi_3d, false), look, {}, displays.driver());
    ASSERT_TRUE(played.outcome) << played.outcome.error().line();
    ASSERT_EQ(displays.asked.size(), 1u) << "a change of a projector's mode takes seconds";
    EXPECT_EQ(displays.asked[0].stereo, DisplayStereo::hdmi_3d);
    EXPECT_EQ(displays.asked[0].refresh_Hz, 60.0);
    expect_same("a", "b", kFiles);
    ASSERT_TRUE(left && right);
    EXPECT_FALSE(left->rgba == right->rgba);
    const auto both = picture::encode_png(side_by_side({*left, *right}));
    ASSERT_TRUE(both);
    const std::string png(reinterpret_cast<const char*>(both->data()), both->size());
    EXPECT_TRUE(png == place.read("b/end.png")) << "the display has what was photographed, left eye first";
}

TEST_F(DirectSession, KeepsStereoAfterTheSurfaceOrTheDeviceWasLost) {
    displays.stereo.emplace(2);
    ASSERT_TRUE(play("a", wall(DisplayStereo::inband_displayport, true)).outcome);
    const Mishap both = [lost = false](int frame, Presenter& stage) mutable {
        if (frame == 20) stage.device().core()->lose_surface_at_next_acquire = true;
        if (frame == 40 && !std::exchange(lost, true)) stage.device().core()->lose_at_next_submit = true;
    };
    const Played played = play("b", wall(DisplayStereo::inband_displayport, false), both, {}, displays.driver());
    ASSERT_TRUE(played.outcome) << played.outcome.error().line();
    EXPECT_EQ(played.recoveries, 1);
    ASSERT_EQ(displays.asked.size(), 3u);
    for (const gpu::DisplayChoice& choice : displays.asked) EXPECT_EQ(choice.stereo, DisplayStereo::inband_displayport);
    expect_same("a", "b", kFiles);
}

TEST_F(DirectSession, AsksForStereoOnlyWhileItShowsTwoLayers) {
    displays.stereo.emplace(2);
    DeskOptions live = wall(DisplayStereo::onboard_din, false);
    live.stereo = "anaglyph_red_cyan";
    ASSERT_TRUE(play("a", live, {}, {}, displays.driver()).outcome);
    ASSERT_EQ(displays.asked.size(), 2u);
    EXPECT_EQ(displays.asked[0].stereo, DisplayStereo::onboard_din);
    EXPECT_EQ(displays.asked[1].stereo, DisplayStereo::none);
}

TEST_F(DirectSession, SaysAtOnceWhatTheDisplayCannotDo) {
    const Played one_layer = play("a", wall(DisplayStereo::hdmi_3d, false), {}, {}, displays.driver());
    ASSERT_FALSE(one_layer.outcome);
    displays.unplugged = {"projector"};
    const Played none = play("b", wall(DisplayStereo::hdmi_3d, false), {}, {}, displays.driver());
    ASSERT_FALSE(none.outcome);
    for (const auto& [played, part] : {std::pair{&one_layer, "(1 layer)"}, std::pair{&none, "no display"}}) {
        const std::string line = played->outcome.error().line();
        for (const char* expected : {"screen front, ", part, "--windowed", "--offscreen"})
            EXPECT_NE(line.find(expected), std::string::npos) << expected << " in: " << line;
    }
}

TEST_F(DirectSession, RefusesAWindowForTheRightEyeAndGoesOn) {
    DeskOptions live = wall(DisplayStereo::none, false);
    live.stereo = "two_windows";
    const Played played = play("a", live, {}, {}, displays.driver());
    ASSERT_TRUE(played.outcome) << played.outcome.error().line();
    EXPECT_NE(played.said.find("the right eye has no window"), std::string::npos) << played.said;
}

TEST_F(DirectSession, StandsBesideWindows) {
    wall::WallSetup setup = *wall::read_wall(std::string(kWallsFolder) + "/cave.toml");
    std::erase_if(setup.screens, [](const wall::WallScreen& s) { return s.name != "front" && s.name != "floor"; });
    ASSERT_EQ(setup.screens.size(), 2u);
    for (wall::WallScreen& screen : setup.screens) {
        screen.pixels = {200, 200};
        screen.mode = "mono";
        screen.output = "0";
        if (screen.name == "front") screen.direct = DisplayStereo::none;
    }
    place.write("wall.toml", wall::wall_text(setup));
    DeskOptions live;
    live.wall = (place / "wall.toml").string();
    const Played played = play("a", live, {}, {}, displays.driver());
    ASSERT_TRUE(played.outcome) << played.outcome.error().line();
    EXPECT_GT(played.presented, 10u);
    EXPECT_FALSE(place.read("a/end-front.png").empty());
    EXPECT_FALSE(place.read("a/end-floor.png").empty());
    const Result<SessionWall> room = session_wall(live);
    ASSERT_TRUE(room) << room.error().line();
    auto stage = Presenter::open(live, *room, displays.driver());
    ASSERT_TRUE(stage) << stage.error().line();
    EXPECT_TRUE(stage->has_windows()) << "which wait for keys";
}

TEST_F(DirectSession, WaitsUntilItIsWokenWithoutAnyWindow) {
    SessionWaker waker;
    std::jthread other([&] { waker.wake(); });
    EXPECT_TRUE(waker.wait(600.0));
    EXPECT_FALSE(waker.wait(0.0)) << "once for each time";
    waker.wake();
    EXPECT_TRUE(waker.wait(600.0)) << "also when that came before";

    const DeskOptions live = wall(DisplayStereo::none, false);
    const Result<SessionWall> room = session_wall(live);
    ASSERT_TRUE(room);
    auto stage = Presenter::open(live, *room, displays.driver());
    ASSERT_TRUE(stage) << stage.error().line();
    EXPECT_FALSE(stage->has_windows());
    EXPECT_EQ(stage->refresh_Hz(), 75.0);
    stage->wake();
    EXPECT_TRUE(stage->inputs(600.0).empty());
}

TEST_F(DirectSession, RunsInRealTimeUntilTheScriptQuits) {
    DeskOptions live = wall(DisplayStereo::none, false);
    live.screenshots = (place / "").string();
    const Result<SessionWall> room = session_wall(live);
    ASSERT_TRUE(room);
    auto log = parse_input_log(
        "burin-input 1 test\n0.05 wand 0 0 1 1 0 0 0 1\n0.1 command screenshot a.png\n0.4 command quit\n", "script");
    ASSERT_TRUE(log) << log.error().line();
    const auto record =
        run_in_real_time(sculpt(live), *room, InputSource::play(std::move(*log)), {.driver = displays.driver()});
    ASSERT_TRUE(record) << record.error().line();
    EXPECT_FALSE(place.read("a.png").empty());
    EXPECT_EQ(displays.asked.size(), 1u);
}

TEST_F(DirectSession, EndsAtASignalAndFinishesItsRecording) {
    const DeskOptions live = wall(DisplayStereo::none, false);
    const Result<SessionWall> room = session_wall(live);
    ASSERT_TRUE(room);
    auto writer = InputLogWriter::create((place / "live.log").string(), "settings");
    ASSERT_TRUE(writer) << writer.error().line();
    std::jthread killer([](const std::stop_token& over) {
        struct sigaction now{};
        do {  // once somebody listens
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            sigaction(SIGTERM, nullptr, &now);
        } while (now.sa_handler == SIG_DFL && !over.stop_requested());
        if (now.sa_handler != SIG_DFL) kill(getpid(), SIGTERM);
    });
    const auto record =
        run_in_real_time(sculpt(live), *room, InputSource::live(std::move(*writer)), {.driver = displays.driver()});
    ASSERT_TRUE(record) << record.error().line();
    const auto log = read_input_log((place / "live.log").string());
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_FALSE(log->torn_line) << *log->torn_line;
    struct sigaction after{};
    sigaction(SIGTERM, nullptr, &after);
    EXPECT_EQ(after.sa_handler, SIG_DFL) << "as it was before";
}

// As a user meets it: this machine's own displays.
TEST_F(DirectSession, ByTheCommandNamesTheScreenAndTheWaysOut) {
    auto device = gpu::Device::create({.optional_instance_extensions = gpu::direct_display_extensions()});
    ASSERT_TRUE(device) << device.error().line();
    if (gpu::list_displays(*device)) GTEST_SKIP() << "this machine has a display that would be taken";
    static_cast<void>(wall(DisplayStereo::hdmi_3d, false));
    place.write("script.txt", "burin-input 1 test\n0.1 command screenshot a.png\n0.2 command quit\n");
    const std::string burin = std::string("env -u DISPLAY BURIN_VULKAN_VALIDATION=1 ") + kBurinCommand +
                              " sculpt --workpiece ball:0.1 --resolution 16 --tool ball:0.01 --wall wall.toml ";
    const auto shown = place.run(burin + "--input script.txt");
    EXPECT_EQ(shown.status, 1) << shown.output;
    for (const char* part : {"screen front, direct display: no display", "plug one in", "--windowed", "--offscreen"})
        EXPECT_NE(shown.output.find(part), std::string::npos) << part << " in: " << shown.output;
    const auto alone = place.run(burin);
    EXPECT_EQ(alone.status, 1) << alone.output;
    EXPECT_NE(alone.output.find("--tracker"), std::string::npos) << alone.output;
    const auto offscreen = place.run(burin + "--input script.txt --offscreen");
    EXPECT_EQ(offscreen.status, 0) << offscreen.output;
    EXPECT_FALSE(place.read("script-outputs/a.png").empty());
}

}  // namespace burin::session

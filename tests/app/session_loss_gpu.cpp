// SPDX-License-Identifier: MIT
// A whole session whose graphics device or window surface is lost while somebody carves goes on as if nothing had happened.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "app/session/live_session.hpp"
#include "app/session/session_stage.hpp"
#include "gpu/core.hpp"
#include "tests/app/run_command.hpp"
#include "tests/window/xvfb.hpp"

namespace burin {
namespace {

constexpr Nanoseconds kUpdatePeriod_ns = 12'000'000;

// Carves from 0.3 to 0.8 s, with the panel open; photographs before, meanwhile and at the end. What is refused is said on the panel, where
// it takes the place of what was said of a loss: else the pictures would differ by that.
const std::string kScript = R"(burin-input 1 test
0.02 mouse 160 180
0.04 scroll 0 15
0.1 command radius -1
0.2 command screenshot before.png
0.3 button press left
0.32 scroll 0 8
0.4 mouse 166 182
0.45 command radius -1
0.5 mouse 176 186
0.52 command screenshot carving.png
0.6 mouse 190 190
0.8 button release left
0.82 scroll 0 -14
0.86 command radius -1
0.9 command screenshot end.png
0.92 command export carved.stl
1 command quit
)";

// What may happen before each attempt to draw a frame.
using Mishap = std::function<void(int frame, SessionStage& stage)>;

struct Played {
    int recoveries = 0;
    Result<void> outcome;
    std::string said;
};

class SessionLoss : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
        setenv("BURIN_VULKAN_VALIDATION", "1", 1);
        messages_before_ = gpu::validation_messages();
    }
    void TearDown() override {
        unsetenv("BURIN_VULKAN_VALIDATION");
        EXPECT_EQ(gpu::validation_messages(), messages_before_) << "the validation layer complained";
    }

    // As run_session(), in simulated time. Folders have one letter: their names are on the panel, and lines of one length are broken alike.
    Played play(const std::string& folder, LiveOptions live, const Mishap& mishap = {},
                const std::set<int>& minimised = {}) {
        std::filesystem::create_directory(place / folder);
        live.screenshots = (place / folder).string();
        SculptOptions options;
        options.workpiece = {"ball:0.1", 32, false};
        options.tool.shape = "ball:0.012";
        options.live = live;
        std::string script = kScript;
        script.replace(script.find("carved.stl"), 10, (place / folder).string() + "/carved.stl");
        testing::internal::CaptureStderr();
        Played played;
        played.outcome =
            run(options, InputSource::replay(parse_input_log(script, "script").value()), mishap, minimised, played);
        played.said = testing::internal::GetCapturedStderr();
        return played;
    }

    void expect_same(const std::string& one, const std::string& other, const std::vector<std::string>& names) {
        for (const std::string& name : names) {
            const std::string first = place.read(one + "/" + name);
            ASSERT_FALSE(first.empty()) << name;
            EXPECT_TRUE(first == place.read(other + "/" + name)) << name << " is another one";
        }
    }

    Workplace place;

private:
    std::uint64_t messages_before_ = 0;

    static Result<void> run(const SculptOptions& options, InputSource input, const Mishap& mishap,
                            const std::set<int>& minimised, Played& played) {
        SimulatedClock clock;
        const Result<SessionWall> wall = session_wall(options.live);
        if (!wall) return std::unexpected(wall.error());
        auto session = LiveSession::create(options, *wall, clock);
        if (!session) return std::unexpected(session.error());
        Result<SessionStage> stage = SessionStage::open(options.live, *wall);
        if (!stage) return std::unexpected(stage.error());
        LiveSession& s = **session;
        if (auto news = s.desk().take_news()) s.take(std::move(*news));
        Nanoseconds next_update_ns = kUpdatePeriod_ns;
        for (int i = 0; const auto frame = input.begin_frame(0, 0); ++i) {
            while (clock.now_ns() + s.loop().period_ns() <= frame->time_ns) {
                clock.sleep_until(clock.now_ns() + s.loop().period_ns());
                s.loop().step();
                if (clock.now_ns() < next_update_ns) continue;
                if (const auto updated = s.desk().update(clock.now_ns()); !updated) return updated;
                next_update_ns += kUpdatePeriod_ns;
            }
            stage->look();
            const OutputPlace place = minimised.contains(i) ? OutputPlace{} : stage->place();
            s.step(*frame, place, s.newest_tool(), [&](CarvingOrder order) {
                s.desk().order(order);
                s.desk().finish_export();
            });
            if (auto news = s.desk().take_news()) s.take(std::move(*news));
            if (stage->has_windows()) static_cast<void>(stage->inputs(0.0));
            if (minimised.contains(i)) continue;
            if (const auto drawn = draw(s, *stage, i, frame->display_ns, mishap, played); !drawn) return drawn;
            if (s.state().quit) break;
        }
        return {};
    }

    static Result<void> draw(LiveSession& s, SessionStage& stage, int frame, Nanoseconds display_ns,
                             const Mishap& mishap, Played& played) {
        while (true) {
            if (mishap) mishap(frame, stage);
            const Result<bool> drawn = stage.draw(s, display_ns);
            if (drawn) return {};
            if (const auto recovered = stage.recover(s, drawn.error()); !recovered) return recovered;
            ++played.recoveries;
        }
    }
};

LiveOptions desk(bool offscreen) {
    LiveOptions live;
    live.offscreen = offscreen;
    live.width = 720;
    live.height = 360;
    return live;
}

LiveOptions cave(bool offscreen) {
    LiveOptions live = desk(offscreen);
    live.wall = std::string(BURIN_WALLS) + "/cave.toml";
    live.stereo = "side_by_side_half";
    live.windowed = true;
    live.width = 240;
    live.height = 160;
    return live;
}

// At the first picture, while carving (twice, one right after the other), and while the tool is taken away.
const std::set<int> kFrames{0, 20, 24, 25, 50};

Mishap device_lost() {
    return [left = kFrames](int frame, SessionStage& stage) mutable {
        if (left.erase(frame) > 0) stage.device().core()->lose_at_next_submit = true;
    };
}

Mishap surface_lost() {
    return [left = kFrames](int frame, SessionStage& stage) mutable {
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
    for (const LiveOptions& live : {desk(true), cave(true)}) {
        const bool stands = !live.wall.empty();
        const std::string before = stands ? "c" : "a", after = stands ? "d" : "b";
        ASSERT_TRUE(play(before, live).outcome);
        const Played played = play(after, live, {}, {20, 21, 22, 23, 24, 25, 26});
        ASSERT_TRUE(played.outcome) << played.outcome.error().line();
        expect_same(before, after, {"carved.stl", stands ? "end-front.png" : "end.png"});
    }
}

TEST_F(SessionLoss, OverAndOverEndsWithAReason) {
    const Played played = play("a", desk(true), [](int frame, SessionStage& stage) {
        if (frame >= 20) stage.device().core()->lose_at_next_submit = true;
    });
    ASSERT_FALSE(played.outcome);
    EXPECT_NE(played.outcome.error().line().find("without a picture in between"), std::string::npos)
        << played.outcome.error().line();
}

}  // namespace burin

// SPDX-License-Identifier: MIT
// A scripted session played in this process, so that a test can do to its stage what a driver does on a bad day.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/session/input_source.hpp"
#include "app/session/live_session.hpp"
#include "app/session/session_stage.hpp"
#include "gpu/device.hpp"
#include "tests/app/run_command.hpp"

namespace burin {

inline constexpr Nanoseconds kUpdatePeriod_ns = 12'000'000;

// Carves from 0.3 to 0.8 s, with the panel open; photographs before, meanwhile and at the end. What is refused is said on the panel, where
// it takes the place of what was said of a loss: else the pictures would differ by that.
inline const std::string kScript = R"(burin-input 1 test
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
    std::uint64_t presented = 0;  // of the main screen, since its images were opened at last
};

class PlayedSession : public testing::Test {
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
                const std::set<int>& minimised = {}, const DirectDriver& driver = direct_driver()) {
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
        played.outcome = run(options, InputSource::replay(parse_input_log(script, "script").value()), mishap, minimised,
                             driver, played);
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
                            const std::set<int>& minimised, const DirectDriver& driver, Played& played) {
        SimulatedClock clock;
        const Result<SessionWall> wall = session_wall(options.live);
        if (!wall) return std::unexpected(wall.error());
        auto session = LiveSession::create(options, *wall, clock);
        if (!session) return std::unexpected(session.error());
        Result<SessionStage> stage = SessionStage::open(options.live, *wall, driver);
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
            if (stage->shows()) static_cast<void>(stage->inputs(0.0));
            if (minimised.contains(i)) continue;
            if (const auto drawn = draw(s, *stage, i, frame->display_ns, mishap, played); !drawn) return drawn;
            played.presented = stage->presented();
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

}  // namespace burin

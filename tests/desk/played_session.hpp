// SPDX-License-Identifier: MIT
// A scripted session played in this process, so that a test can do to its presenter what a graphics driver does on a
// bad day.
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

#include "desk/present/presenter.hpp"
#include "desk/run/session_frames.hpp"
#include "gpu/device.hpp"
#include "session/drive/executors.hpp"
#include "tests/desk/validated_desk.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {

// Carves from 0.3 to 0.8 s, with the panel open; photographs before, meanwhile and at the end. What is refused is said
// on the panel, where it takes the place of what was said of a loss: else the pictures would differ by that. A device
// is lost only where there is something to draw; so the panel has another friction to show at 0.83 s, while the hand
// has not set out yet.
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
0.81 command friction 0.31
0.82 scroll 0 -14
0.86 command radius -1
0.9 command screenshot end.png
0.92 command export carved.stl
1 command quit
)";

// What may happen before each attempt to draw a frame.
using Mishap = std::function<void(int frame, Presenter& presenter)>;

struct Played {
    int recoveries = 0;
    Result<void> outcome;
    std::string said;
    std::uint64_t presented = 0;  // of the main screen, since its images were opened at last
    std::string engine;           // that carved at the end
};

// The frames of a script with its mishaps, and with some in which the output is minimised.
class MishapFrames final : public ScriptedFrames {
public:
    MishapFrames(Desk& desk, Presenter& presenter, InputSource input, const Mishap& mishap,
                 const std::set<int>& minimised)
        : ScriptedFrames(desk, presenter, std::move(input)),
          presenter_(presenter),
          mishap_(mishap),
          minimised_(minimised) {}

private:
    [[nodiscard]] std::optional<FrameInput> next_input() override {
        const std::size_t main = desk_.room().wall.main;
        if (minimised_.contains(frame_++)) presenter_.put(main, place_);
        const auto input = ScriptedFrames::next_input();
        place_ = presenter_.place();
        if (minimised_.contains(frame_)) presenter_.put(main, {});
        return input;
    }
    [[nodiscard]] bool wants_picture() override {
        if (minimised_.contains(frame_)) return false;
        if (mishap_) mishap_(frame_, presenter_);
        return true;
    }

    Presenter& presenter_;
    const Mishap& mishap_;
    const std::set<int>& minimised_;
    int frame_ = -1;
    wall::OutputPlace place_;  // of the main screen, when it is not minimised
};

class PlayedSession : public ValidatedDesk {
protected:
    // As run_session(), in simulated time. Folders have one letter: their names are on the panel, and lines of one
    // length are broken alike.
    Played play(const std::string& folder, DeskOptions shown, const Mishap& mishap = {},
                const std::set<int>& minimised = {}, const DirectDriver& driver = direct_driver()) {
        std::filesystem::create_directory(place / folder);
        shown.screenshots = (place / folder).string();
        SessionSetup options = carving_setup();
        options.carve.workpiece = {"ball:0.1", 32, false};
        options.hands.tool.shape = "ball:0.012";
        options.desk = shown;
        options.carve.engine = engine;
        std::string script = kScript;
        script.replace(script.find("carved.stl"), 10, (place / folder).string() + "/carved.stl");
        testing::internal::CaptureStderr();
        Played played;
        played.outcome = run(options, InputSource::replay(parse_input_log(script, "script").value()), mishap, minimised,
                             driver, played);
        played.said = testing::internal::GetCapturedStderr();
        const std::string lost = "the graphics device was lost; starting";
        for (std::size_t at = 0; (at = played.said.find(lost, at)) != std::string::npos; at += lost.size())
            ++played.recoveries;
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
    compute::EngineChoice engine = compute::EngineChoice::automatic;

private:
    static Result<void> run(const SessionSetup& options, InputSource input, const Mishap& mishap,
                            const std::set<int>& minimised, const DirectDriver& driver, Played& played) {
        SimulatedClock clock;
        const Result<SessionWall> wall = session_wall(options.desk);
        if (!wall) return std::unexpected(wall.error());
        Result<Presenter> presenter = Presenter::open(options.desk, *wall, driver);
        if (!presenter) return std::unexpected(presenter.error());
        auto desk = Desk::create(carving_with(*presenter, options), *wall, clock);
        if (!desk) return std::unexpected(desk.error());
        Desk& s = **desk;
        Session& session = s.session();
        MishapFrames frames(s, *presenter, std::move(input), mishap, minimised);
        SteppedExecutor executor(clock, session.loop(), session.channels_of_parts(), session.scene(),
                                 [&](const auto& ended) { static_cast<void>(session.collect(ended)); });
        const Result<void> driven = drive(executor, frames);
        played.presented = presenter->presented();
        played.engine = session.scene_side().engine()->name();
        return driven;
    }
};

}  // namespace burin::session
